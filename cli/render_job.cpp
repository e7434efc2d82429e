#include "cli/render_job.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/aov_option.hpp"
#include "cli/diagnostics_output.hpp"
#include "cli/film_job.hpp"
#include "cli/film_request.hpp"
#include "cli/frame_selection.hpp"
#include "cli/frame_writer.hpp"
#include "cli/frames.hpp"
#include "cli/kernel_options.hpp"
#include "cli/override_options.hpp"
#include "cli/picture_memory.hpp"
#include "cli/picture_outputs.hpp"
#include "cli/report_failure.hpp"
#include "cli/scene_figures.hpp"
#include "cli/statistics.hpp"
#include "cli/usage_error.hpp"
#include "cli/videos.hpp"
#include "lang/allowances/allowances.hpp"
#include "lang/compile/compile.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "lang/source/sandbox.hpp"
#include "lang/text/display_width.hpp"
#include "render/film/film.hpp"
#include "render/image/atomic_file.hpp"
#include "render/image/codec_loader.hpp"
#include "render/image/image.hpp"
#include "render/math/clock.hpp"
#include "render/parallel/threads.hpp"
#include "render/scene/instances.hpp"
#include "render/session/picture_denoiser.hpp"
#include "render/session/render.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

PictureForm picture_form(const RenderOptions& options, const lang::LoweredScene& lowered) {
  return {.mapping = lowered.output.mapping, .ppm_text = options.ppm_text, .zoom = options.zoom};
}

ProgressStyle progress_style(const RenderOptions& options, const Environment& env) {
  if (options.is_quiet()) return ProgressStyle::None;
  if (options.progress == "openjd") return ProgressStyle::OpenJd;
  if (options.progress == "json") return ProgressStyle::Json;
  if (options.progress == "plain" || !env.err_is_terminal) return ProgressStyle::Plain;
  return ProgressStyle::Line;
}

std::ostream& progress_stream(ProgressStyle style, Environment& env) {
  return style == ProgressStyle::OpenJd ? env.out : env.err;
}

/// The first pass is finished in any case.
constexpr double kMinSecondsToTrace = 1e-3;

/// Traces with progress; Ctrl-C ends it early. Moves the scene away. `film` may be null.
render::RenderResult trace(lang::LoweredScene& lowered, render::Kernel kernel,
                           const RenderOptions& options, const std::vector<Output>& outputs,
                           FilmJob* film, ProgressPart part, RenderStatistics& statistics,
                           RenderRun& run, Environment& env) {
  render::RenderMonitor monitor;
  monitor.on_tracing = [&] {
    // For ten million spheres, freed memory of the compiler and the BVH builder would keep 140 MB
    // resident during tracing.
    release_freed_memory();
    statistics.render_rss_bytes = resident_bytes();  // before the codec allocates its own
    for (const Output& output : outputs) {
      if (output.is_film) continue;
      render::preload_image_codec(
          output.format, lowered.settings.seconds ? render::Preload::Now : render::Preload::Late);
    }
  };
  monitor.seconds_to_finish = [&](const render::Picture& picture) {
    return seconds_to_write(picture, outputs, picture_form(options, lowered),
                            options.aovs.channels());
  };
  const InterruptGuard interrupt(monitor.cancel);
  const Cancellation::Scope outdated(run.outdated, monitor.cancel);
  const render::RenderSettings settings = lowered.settings;
  const render::ToneMapping mapping = lowered.output.mapping;
  if (run.preview != nullptr) {
    run.preview->begin();
    monitor.shows_passes = true;
    monitor.on_pass = [&run, &mapping, width = lowered.settings.window().width](
                          const render::Film& so_far, const auto& /*error*/) {
      run.preview->show(so_far, width, mapping);
    };
  }
  if (film != nullptr) part.samples = film->samples_to_trace();
  const ProgressStyle style = progress_style(options, env);
  const ProgressReporter progress(style, monitor, settings, progress_stream(style, env),
                                  std::move(part));
  render::RenderResult result =
      film != nullptr
          ? film->render(monitor, env)
          : render::render(std::move(kernel), std::move(lowered.scene), lowered.settings, monitor);
  if (run.preview != nullptr && !result.picture.pixels.empty() && !run.outdated.is_requested()) {
    run.preview->show(result.picture, mapping);
  }
  return result;
}

/// The pictures of one scene: one, or one for each frame.
class RenderJob {
 public:
  RenderJob(const RenderOptions& options, RenderRun& run, Environment& env)
      : options_(options), run_(run), env_(env) {}

  ExitCode run() {
    source_ = read_scene(options_.scene, env_);
    read_seconds_ = render::seconds_since(start_);
    compiler_.emplace(*source_, program_options(options_.scene, env_), sink_);
    choose_frames();
    is_lost_ = sink_.has_errors();  // they do not depend on the frame
    for (std::size_t i = 0; i < frames_.size() && !run_.ends(); ++i) {
      const ExitCode of_frame = render_or_skip(i);
      if (of_frame == ExitCode::Interrupted) {
        code_ = graver(code_, of_frame);
        break;
      }
      note_frame(i, of_frame);
      finish_frames(max_pending_);
      if (ends_early()) break;
    }
    finish_frames(0);
    if (run_.outdated.is_requested()) return ExitCode::Interrupted;
    std::ranges::sort(failed_);
    report_frames();
    code_ = graver(code_, videos_.finish(finished_ == frames_.size(), options_.is_quiet(), env_));
    return run_.interrupted.load() ? report_interrupted() : code_;
  }

 private:
  void note_frame(std::size_t index, ExitCode code) {
    code_ = graver(code_, code);
    if (code == ExitCode::Success) return;
    failed_.push_back(frames_[index].value_or(0));
    // The messages before do not say it; the last line names all.
    constexpr std::size_t kMaxNamed = 3;
    if (frames_.size() > 1 && failed_.size() <= kMaxNamed)
      env_.err << fmt::format("error: frame {} failed\n", failed_.back());
  }

  /// Whether a frame has failed, and no later one is rendered.
  bool ends_early() const { return !failed_.empty() && (options_.fails_fast || is_lost_); }

  /// Waits until at most `max` frames are pending, in their order.
  void finish_frames(std::size_t max) {
    while (pending_.size() > max) {
      auto [frame, of_frame] = take_frame();
      if (of_frame == ExitCode::Interrupted) continue;
      const ExitCode of_videos = add_to_videos(frame, nullptr);
      frame.is_written = frame.is_written && of_videos == ExitCode::Success;
      const ExitCode code = graver(of_frame, of_videos);
      note_frame(frame.index, code);
      code_ = graver(code_, note_written(frame));
      if (code != ExitCode::Success && ends_early()) pending_.cancel();
    }
  }

  std::pair<RenderedFrame, ExitCode> take_frame() {
    {
      const render::RenderMonitor monitor;
      const ProgressStyle style = progress_style(options_, env_);
      const ProgressReporter progress(style, monitor, {}, progress_stream(style, env_),
                                      progress_part(pending_.first()));
      while (!pending_.wait(std::chrono::milliseconds(50))) {
        if (run_.ends()) pending_.cancel();
      }
    }
    return pending_.take();
  }

  ExitCode note_written(const RenderedFrame& frame) {
    if (frame.is_written) ++finished_;
    return frame.result.camera_samples > 0 ? add_statistics(frame.statistics, frame.result)
                                           : ExitCode::Success;
  }

  /// Appends a line to --stats.
  ExitCode add_statistics(const RenderStatistics& statistics, const render::RenderResult& result) {
    ExitCode code = ExitCode::Success;
    if (options_.stats.empty()) return code;
    run_.stats += to_json(statistics, result) + "\n";
    run_.is_stats_file_behind = true;
    // All of it each time: for films of thousands of short frames, once a second.
    if (render::seconds_since(run_.stats_written) > 1) {
      try_to_write(code, env_, [&] { write_stats_so_far(options_, run_, env_); });
    }
    return code;
  }

  ExitCode render_or_skip(std::size_t i) {
    const bool is_last = i + 1 == frames_.size();
    if (options_.skips_existing && videos_.empty() && !options_.outputs.empty() &&
        are_written(output_request("", frames_[i]))) {
      ++skipped_;
      return ExitCode::Success;
    }
    // What makes the first frame fail before it is traced would make all fail.
    if (!has_planned_) return render_frame(i, is_last);
    return report_failure(env_, [&] { return render_frame(i, is_last); });
  }

  /// Reports frames that were skipped or failed.
  void report_frames() const {
    if (skipped_ > 0 && !options_.quiet) {
      env_.err << (frames_.size() == 1 ? fmt::format("the picture of `{}` is there already\n",
                                                     lang::printable(options_.scene.name()))
                                       : fmt::format("{} of {} frames were there already\n",
                                                     skipped_, frames_.size()));
    }
    if (!failed_.empty() && frames_.size() > 1) {
      env_.err << fmt::format("error: {} of {} frames failed: {}\n", failed_.size(), frames_.size(),
                              describe_frames(failed_));
    }
  }

  /// Reports an interruption between pictures. One within a picture has been reported.
  ExitCode report_interrupted() {
    if (code_ == ExitCode::Interrupted) return code_;
    env_.err << "interrupted; ";
    if (frames_.size() == 1) {
      env_.err << fmt::format("the picture was {}\n", finished_ > 0 ? "finished" : "not rendered");
    } else {
      env_.err << fmt::format("{} of {} frames were finished\n", finished_, frames_.size());
    }
    return graver(ExitCode::Interrupted, code_);
  }

  void choose_frames() {
    const std::optional<lang::Animation> animation = compiler_->animation();
    if (!animation && options_.frames && !sink_.has_errors()) {
      throw UsageError("--frames: the scene has no `animation`, so all frames are the same");
    }
    FrameSelection selection = select_frames(options_, animation, env_.err);
    frames_ = std::move(selection.frames);
    is_shard_of_frames_ = selection.is_shard;
    choose_videos(selection.frames_per_second);
    if (frames_.size() == 1) return;
    for (const std::string& output : pictures_) {
      if (has_frame_mark(output)) continue;
      throw UsageError(fmt::format("{} frames cannot all be written to `{}`; put {} in its name",
                                   frames_.size(), lang::printable(output), kFrameMark));
    }
  }

  /// Divides the outputs into videos of all frames and pictures of one.
  void choose_videos(double frames_per_second) {
    pictures_ = options_.outputs;
    std::vector<std::string> names = Videos::take_from(pictures_, frames_.size());
    if (!names.empty() && !frames_.front() && !sink_.has_errors()) {
      throw UsageError(fmt::format("`{}` is a video, but the scene has no `animation`",
                                   lang::printable(names.front())));
    }
    if (!names.empty() && options_.shard) {
      throw UsageError(fmt::format(
          "--shard: `{}` is a video of all frames, and a shard has not all: use -o NAME.{}.{}",
          lang::printable(names.front()), kFrameMark, is_part() ? "film" : "png"));
    }
    for (std::string& name : names) name = name_of_scene(name, options_.scene.given_name());
    const bool has_videos = !names.empty();
    videos_ = Videos(names, {.numbers = numbers_of_frames(), .per_second = frames_per_second},
                     options_, run_.interrupted, env_);
    if (has_videos && videos_.empty() && pictures_.empty()) frames_.clear();  // nothing to render
    videos_.check(InputSet(options_.files), run_.outputs, options_.keeps_existing);
  }

  std::vector<int> numbers_of_frames() const {
    std::vector<int> numbers;
    for (const std::optional<int> frame : frames_) numbers.push_back(frame.value_or(0));
    return numbers;
  }

  /// Adds a frame that an earlier render has kept to the videos. Returns false if it has to be
  /// rendered. Throws as Videos::add_kept().
  bool take_kept_frame(std::optional<int> frame, const FilmJob& film) {
    if (videos_.empty()) return false;
    if (!pictures_.empty() && !are_written(output_request("", frame))) return false;
    if (!videos_.add_kept(*frame, film.film(), env_)) return false;
    ++finished_;
    return true;
  }

  static render::PictureRecord record_of(const lang::LoweredScene& lowered,
                                         std::optional<int> frame,
                                         const RenderStatistics& statistics,
                                         const FilmRequest& request) {
    render::PictureRecord record;
    record.scene = lang::printable(statistics.scene);
    record.frame = frame;
    record.spheres = statistics.spheres;
    record.instances = statistics.instances;
    record.features = fmt::to_string(fmt::join(statistics.features, " "));
    record.tone = lowered.output.mapping.tone;
    record.exposure = lowered.output.mapping.exposure;
    if (request.shard) {
      record.shards = request.shard->count;
      record.cut = request.cut;
    }
    return record;
  }

  ProgressPart progress_part(std::size_t frame) const {
    const auto frames = static_cast<double>(frames_.size()),
               files = static_cast<double>(run_.files);
    const double before = static_cast<double>(frame) / frames;
    ProgressPart part{.before = (static_cast<double>(run_.files_before) + before) / files,
                      .share = 1 / (frames * files),
                      .schedule = run_.schedule};
    if (run_.files > 1)
      part.label = fmt::format("scene {} of {}", run_.files_before + 1, run_.files);
    if (frames_.size() > 1) {
      part.label += fmt::format("{}frame {} of {}", part.label.empty() ? "" : ", ", frame + 1,
                                frames_.size());
    }
    return part;
  }

  /// A frame's scene, and its kernel.
  struct LoweredFrame {
    lang::LoweredScene lowered;
    render::Kernel kernel;  ///< may be refused
    double choice_seconds = 0;
  };

  /// Compiles the scene at this frame and prints its new diagnostics; nullopt if it has errors.
  std::optional<LoweredFrame> lower(std::optional<int> frame, RenderStatistics& statistics) {
    lang::Overrides overrides = options_.overrides;
    overrides.instancing = instancing_for(options_.kernel, overrides);
    overrides.names_output = !options_.outputs.empty();
    auto lowered = compiler_->lower(overrides, frame);
    lang::CompileTimes times = compiler_->times();
    times.parse_seconds -= std::exchange(parse_seconds_, times.parse_seconds);  // all frames' sum
    const auto choice_start = std::chrono::steady_clock::now();
    render::Kernel kernel;
    if (lowered) kernel = choose_kernel(options_.kernel, overrides, *lowered, *compiler_);
    const double choice_seconds = render::seconds_since(choice_start);
    const bool is_first = !std::exchange(has_compiled_, true);
    if (is_first || !sink_.diagnostics().empty()) {
      print_findings(select_unallowed(sink_), options_.scene.diagnostics, env_.err,
                     env_.err_is_terminal, env_);
    }
    if (!lowered) {
      sink_.clear();
      return std::nullopt;
    }
    check_goals(overrides, *lowered);
    sink_.clear();
    statistics.scene = source_->name();
    statistics.compile = times;
    if (is_first) statistics.compile.parse_seconds += read_seconds_;
    statistics.settings = lowered->settings;
    statistics.spheres = render::count_spheres(lowered->scene);
    statistics.instances = lowered->scene.instances.size();
    statistics.features = required_features(lowered->scene, count_materials(lowered->scene));
    return LoweredFrame{.lowered = *std::move(lowered),
                        .kernel = std::move(kernel),
                        .choice_seconds = choice_seconds};
  }

  OutputRequest output_request(const std::string& of_scene, std::optional<int> frame) const {
    OutputRequest request{.pictures = pictures_,
                          .has_videos = !videos_.empty(),
                          .of_scene = of_scene,
                          .input = options_.scene.given_name(),
                          .keeps_existing = options_.keeps_existing};
    request.frame = frame;
    request.inputs = inputs_;
    if (sandbox_) request.sandbox = &*sandbox_;
    return request;
  }

  /// Decides about the outputs of a frame. The first one checks the names of all.
  std::vector<Output> plan_frame(const lang::LoweredScene& lowered, std::optional<int> frame) {
    OutputRequest request = output_request(lowered.output.output, frame);
    request.width = lowered.settings.window().width * options_.zoom;
    request.height = lowered.settings.window().height * options_.zoom;
    request.earlier = &run_.outputs;
    if (!has_planned_) request.all_frames = frames_;
    // Later the file of earlier pictures exists.
    if (!run_.has_stats_file) request.stats = options_.stats;
    std::vector<Output> outputs = plan_outputs(request);
    has_planned_ = run_.has_stats_file = true;
    return outputs;
  }

  /// Called before text and tree are freed.
  void find_inputs(const lang::LoweredScene& lowered) {
    inputs_ = options_.files;
    for (const fs::path& part : compiler_->dependencies()) inputs_.push_back(part.string());
    if (!options_.scene.reading.is_sandboxed) return;
    // The default folder is ours, but the file in it may be a link made by the scene's author.
    sandbox_.emplace(env_.workspace,
                     lowered.output.output.empty() ? "" : options_.scene.disk_file());
  }

  /// Whether the render is a shard of one picture.
  bool is_part() const { return options_.shard && !is_shard_of_frames_; }

  ExitCode render_frame(std::size_t index, bool is_last) {
    const std::optional<int> frame = frames_[index];
    const auto start = has_compiled_ ? std::chrono::steady_clock::now() : start_;
    RenderStatistics statistics;
    std::optional<LoweredFrame> lowered_frame = lower(frame, statistics);
    if (!lowered_frame) return ExitCode::Findings;
    auto& [lowered, kernel, choice_seconds] = *lowered_frame;
    if (run_.ends()) return ExitCode::Success;  // between two frames
    find_inputs(lowered);
    if (options_.skips_existing && videos_.empty() &&
        are_written(output_request(lowered.output.output, frame))) {
      ++skipped_;
      return ExitCode::Success;
    }
    if (is_last) {  // free text and tree before tracing
      compiler_.reset();
      source_.reset();
      if (options_.scene.pack) options_.scene.pack->release();
    }

    if (options_.crop) {
      lowered.settings.crop =
          options_.crop->window(lowered.settings.width, lowered.settings.height);
    }
    lowered.settings.keeps_variance = options_.aovs.variance;
    lowered.settings.keeps_first_hits = options_.aovs.has_features();
    const render::RenderSettings settings = lowered.settings;
    const std::vector<Output> outputs = plan_frame(lowered, frame);
    check_aovs(options_.aovs, outputs, settings);
    if (options_.zoom > 1 && std::ranges::all_of(outputs, &Output::is_film) && videos_.empty()) {
      throw UsageError("--zoom is for pictures, and a film has the samples of each pixel");
    }
    const std::optional<FilmRequest> request =
        choose_films(options_, outputs, settings,
                     {.shard = is_part() ? options_.shard : std::nullopt,
                      .inputs = inputs_,
                      .sandbox = sandbox_ ? &*sandbox_ : nullptr,
                      .checkpoint = videos_.empty() ? fs::path() : videos_.checkpoint(*frame)});
    check_picture_memory(settings, options_.aovs, request.has_value(), options_.zoom);
    check_not_refused(kernel);

    if (settings.seconds) {
      lowered.settings.seconds =
          std::max(*settings.seconds - render::seconds_since(start), kMinSecondsToTrace);
    }
    // Until here there is nothing to save, and a signal may end the process.
    if (!run_.guard) run_.guard.emplace(run_.interrupted);
    std::optional<render::ParentFolders> folders;
    std::optional<FilmJob> film_job;
    if (request) {
      if (request->is_of_video || outputs.front().may_make_folders) {
        folders.emplace(request->checkpoint);
      }
      try {
        film_job.emplace(*request, std::move(kernel), std::move(lowered.scene), lowered.settings,
                         record_of(lowered, frame, statistics, *request), env_);
        if (take_kept_frame(frame, *film_job)) return ExitCode::Success;
      } catch (const render::FilmError&) {
        if (!videos_.empty()) {  // so are the others, and the video cannot be whole
          is_lost_ = true;
          videos_.leave_kept_frames();
        }
        throw;
      }
    }
    FilmJob* const film = film_job ? &*film_job : nullptr;
    RenderedFrame rendered{.index = index,
                           .outputs = outputs,
                           .form = picture_form(options_, lowered),
                           .settings = settings,
                           .statistics = std::move(statistics)};
    if (frames_.size() > 1 && film == nullptr && run_.preview == nullptr &&
        PendingFrames::may_render(settings, lowered.scene, outputs, options_.zoom)) {
      max_pending_ = PendingFrames::max(render::wanted_threads(settings.threads));
      add_pending(std::move(rendered), *std::move(lowered_frame));
      return ExitCode::Success;
    }
    rendered.result = trace(lowered, std::move(kernel), options_, outputs, film,
                            progress_part(index), rendered.statistics, run_, env_);
    if (!rendered.result.is_complete && run_.outdated.is_requested()) return ExitCode::Interrupted;
    rendered.result.build_seconds += choice_seconds;
    if (frames_.size() > 1 && film == nullptr && PendingFrames::may_wait(rendered)) {
      pending_.add(std::move(rendered));
      return ExitCode::Success;
    }
    finish_frames(0);  // videos get the frames in order
    const ExitCode of_pictures = write_frame(options_, rendered, film, env_);
    const ExitCode of_videos = add_to_videos(rendered, film);
    const ExitCode code = graver(of_pictures, of_videos);
    rendered.is_written = rendered.is_written && of_videos == ExitCode::Success;
    return graver(code, note_written(rendered));
  }

  /// Renders the frame on one thread, beside others.
  void add_pending(RenderedFrame frame, LoweredFrame lowered_frame) {
    const int threads = render::wanted_threads(frame.settings.threads);
    frame.settings.threads = 1;
    const auto shared = std::make_shared<LoweredFrame>(std::move(lowered_frame));
    pending_.add(
        std::move(frame),
        [shared](RenderedFrame& rendered, render::RenderMonitor& monitor) {
          auto& [lowered, kernel, choice_seconds] = *shared;
          monitor.on_tracing = [&] { rendered.statistics.render_rss_bytes = resident_bytes(); };
          rendered.result = render::render(std::move(kernel), std::move(lowered.scene),
                                           rendered.settings, monitor);
          rendered.result.build_seconds += choice_seconds;
        },
        threads);
  }

  ExitCode add_to_videos(RenderedFrame& frame, const FilmJob* film) {
    ExitCode code = ExitCode::Success;
    if (videos_.empty() || !frame.result.is_complete) return code;
    const auto start = std::chrono::steady_clock::now();
    try_to_write(code, env_, [&] {
      // A frame is kept after its pictures: one that is kept has them.
      const bool is_kept = film != nullptr && frame.is_written;
      videos_.add(*frames_[frame.index], frame.result.picture, frame.form.mapping,
                  is_kept ? &film->film() : nullptr, env_);
    });
    is_lost_ = is_lost_ || (code != ExitCode::Success && pictures_.empty());
    frame.statistics.write_seconds += render::seconds_since(start);
    return code;
  }

  const RenderOptions& options_;
  RenderRun& run_;
  Environment& env_;
  lang::DiagnosticSink sink_;
  std::shared_ptr<const lang::Document> source_;
  std::optional<lang::Compiler> compiler_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<std::optional<int>> frames_;  // nullopt for a scene without an animation
  std::vector<std::string> pictures_;       // the outputs that are not videos
  Videos videos_;
  double read_seconds_ = 0, parse_seconds_ = 0;
  bool has_compiled_ = false;
  bool has_planned_ = false;
  bool is_lost_ = false;  // the rest of the frames is of no use
  bool is_shard_of_frames_ = false;
  std::vector<std::string> inputs_;
  std::optional<lang::Sandbox> sandbox_;
  std::size_t finished_ = 0, skipped_ = 0;  // frames
  PendingFrames pending_{options_, env_};
  std::size_t max_pending_ = PendingFrames::max(1);
  std::vector<int> failed_;
  ExitCode code_ = ExitCode::Success;
};

}  // namespace

void write_stats_so_far(const RenderOptions& options, RenderRun& run, Environment& env) {
  run.stats_written = render::Clock::now();
  if (options.stats == kStandardStream) return;
  write_stats(options.stats, run.stats, env);
  run.is_stats_file_behind = false;
}

ExitCode render_scene(const RenderOptions& options, RenderRun& run, Environment& env) {
  return RenderJob(options, run, env).run();
}

}  // namespace sdlc::cli
