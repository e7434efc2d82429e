#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/accuracy_report.hpp"
#include "cli/aov_option.hpp"
#include "cli/command_line.hpp"
#include "cli/dispatcher.hpp"
#include "cli/exit_code.hpp"
#include "cli/frames.hpp"
#include "cli/interrupt.hpp"
#include "cli/kernel_options.hpp"
#include "cli/numbers/format_numbers.hpp"
#include "cli/outputs.hpp"
#include "cli/override_options.hpp"
#include "cli/progress.hpp"
#include "cli/report_failure.hpp"
#include "cli/scene_figures.hpp"
#include "cli/scene_options.hpp"
#include "cli/statistics.hpp"
#include "cli/usage_error.hpp"
#include "cli/version.hpp"
#include "cli/video.hpp"
#include "cli/whole_number.hpp"
#include "lang/allowances/allowances.hpp"
#include "lang/compile/compile.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "lang/source/sandbox.hpp"
#include "lang/text/display_width.hpp"
#include "render/film/aov.hpp"
#include "render/film/film.hpp"
#include "render/image/atomic_file.hpp"
#include "render/image/image.hpp"
#include "render/image/io_error.hpp"
#include "render/math/clock.hpp"
#include "render/parallel/threads.hpp"
#include "render/scene/instances.hpp"
#include "render/session/picture_denoiser.hpp"
#include "render/session/render.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kProgressWords{"auto", "plain", "json", "none"};

struct RenderOptions {
  std::vector<std::string> files;
  SceneOptions scene;  ///< of the file that is being rendered
  std::vector<std::string> outputs;
  lang::Overrides overrides;
  render::KernelRequest kernel;
  render::Aovs aovs;
  std::optional<std::vector<FrameRange>> frames;
  std::string progress = "auto";
  std::string stats;
  bool ppm_text = false;
  bool keeps_existing = false;  // --no-clobber
  bool skips_existing = false;
  bool fails_fast = false;
  int crf = 18;  // VideoSettings::crf
  bool quiet = false;
};

/// Rejects a picture that does not fit into memory, before it is allocated.
void check_memory(const render::RenderSettings& settings, const render::Aovs& aovs) {
  const auto pixels =
      static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
  // The picture, its 32-bit copy, the encoded file, and the error estimates.
  std::size_t pixel_bytes =
      sizeof(render::LinearRgb) + 2 * 3 * sizeof(float) + sizeof(render::PixelSpread);
  if (settings.has_goal() || settings.is_denoised) {  // the film; a goal may need few samples
    pixel_bytes +=
        render::Film::bytes_per_pixel(render::kMinReplicatedSamples, channels_of(settings));
  }
  if (settings.is_denoised) pixel_bytes += render::PictureDenoiser::kBytesPerPixel;
  const std::size_t bytes = pixels * pixel_bytes + aov_bytes(aovs, pixels);
  if (bytes > physical_memory_bytes()) throw std::bad_alloc();
}

render::WriteOptions write_options(const Output& output, const RenderOptions& options,
                                   const lang::LoweredScene& lowered,
                                   const render::RenderResult& result) {
  std::optional<render::ToneMapping> mapping;
  if (!describe(output.format).is_linear) mapping = lowered.output.mapping;
  return {.format = output.format,
          .mapping = lowered.output.mapping,
          .ppm_text = options.ppm_text,
          .metadata = {.software = fmt::format("sdlc {}", kVersion),
                       .entries = picture_metadata(lowered.settings, result, mapping)}};
}

void write_to_stdout(const render::Picture& picture, const render::WriteOptions& options,
                     Environment& env) {
  const auto bytes = render::encode_picture(picture, options, "standard output");
  env.out.write(reinterpret_cast<const char*>(bytes.data()),
                static_cast<std::streamsize>(bytes.size()));
  if (!env.out.flush()) throw render::IoError("write", "standard output", "the write failed");
}

constexpr std::string_view kStandardOutput = "standard output";

/// The written files, and the status.
struct Written {
  std::vector<std::string> names;  ///< as printed
  ExitCode code = ExitCode::Success;
};

/// Runs `write`; an I/O failure is reported, and does not prevent other outputs.
template <typename Write>
void try_to_write(ExitCode& code, Environment& env, Write write) {
  try {
    write();
  } catch (const render::IoError& error) {
    env.err << fmt::format("error: {}\n", lang::printable(error.what()));
    env.out.clear();  // it has been reported
    code = ExitCode::Usage;
  }
}

/// Writes every picture.
Written write_pictures(const std::vector<Output>& outputs, const RenderOptions& options,
                       const lang::LoweredScene& lowered, const render::RenderResult& result,
                       std::span<const render::Layer> layers, Environment& env) {
  Written written;
  for (const Output& output : outputs) {
    render::WriteOptions write = write_options(output, options, lowered, result);
    write.layers = layers;
    fs::path path = output.path;
    try_to_write(written.code, env, [&] {
      if (output.is_stdout) {
        write_to_stdout(result.picture, write, env);
      } else {
        if (!result.is_complete) path = partial_name(path);
        std::optional<render::ParentFolders> folders;
        if (output.may_make_folders) folders.emplace(path);
        render::write_picture(path, result.picture, write);
      }
      written.names.push_back(lang::printable(path.string()));
    });
  }
  return written;
}

ProgressStyle progress_style(const RenderOptions& options, const Environment& env) {
  if (options.quiet || options.progress == "none") return ProgressStyle::None;
  if (options.progress == "json") return ProgressStyle::Json;
  if (options.progress == "plain" || !env.err_is_terminal) return ProgressStyle::Plain;
  return ProgressStyle::Line;
}

void write_stats(const std::string& path, const std::string& lines, Environment& env) {
  if (path == kStandardStream) {
    env.out << lines << std::flush;
  } else {
    render::write_file_atomically(path, std::as_bytes(std::span(lines)));
  }
}

/// The first pass is finished in any case.
constexpr double kMinSecondsToTrace = 1e-3;

/// Every `step`-th row.
render::Picture rows_of(const render::Picture& picture, int step) {
  render::Picture rows(picture.width, (picture.height + step - 1) / step);
  for (int y = 0; y < rows.height; ++y) {
    for (int x = 0; x < rows.width; ++x) rows.at(x, y) = picture.at(x, step * y);
  }
  return rows;
}

/// The seconds to encode a picture with as many layers as were requested, which do not exist yet.
double seconds_to_encode(const render::Picture& picture, const Output& output,
                         const RenderOptions& options, const render::ToneMapping& mapping) {
  std::vector<render::Layer> layers(options.aovs.channels());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    layers[i].name = std::to_string(i);
    for (const render::LinearRgb& pixel : picture.pixels) {
      layers[i].values.push_back(render::to_float(pixel.g));
    }
  }
  const auto start = render::Clock::now();
  render::encode_picture(picture, {.format = output.format,
                                   .mapping = mapping,
                                   .ppm_text = options.ppm_text,
                                   .layers = layers});
  return render::seconds_since(start);
}

/// The seconds to write the picture, as measured with some of its rows: other programs may take
/// most of the processor.
double seconds_to_write(const render::Picture& picture, const std::vector<Output>& outputs,
                        const RenderOptions& options, const render::ToneMapping& mapping) {
  constexpr int kStep = 16;
  constexpr double kSecondsPerFile = 0.02;
  const render::Picture rows = rows_of(picture, kStep), row = rows_of(picture, picture.height);
  double seconds = kSecondsPerFile * static_cast<double>(outputs.size());
  try {
    for (const Output& output : outputs) {
      seconds_to_encode(row, output, options, mapping);  // waits for the codec
      seconds += kStep * seconds_to_encode(rows, output, options, mapping);
    }
  } catch (const render::IoError&) {  // writing will report it
  }
  return seconds;
}

/// Traces with progress; Ctrl-C ends it early. Moves the scene away.
render::RenderResult trace(lang::LoweredScene& lowered, render::Kernel kernel,
                           const RenderOptions& options, const std::vector<Output>& outputs,
                           ProgressPart part, RenderStatistics& statistics, Environment& env) {
  render::RenderMonitor monitor;
  monitor.on_tracing = [&] {
    // For ten million spheres, freed memory of the compiler and the BVH builder would keep 140 MB
    // resident during tracing.
    release_freed_memory();
    statistics.render_rss_bytes = resident_bytes();  // before the codec allocates its own
    render::preload_image_codec(lowered.settings.seconds ? render::Preload::Now
                                                         : render::Preload::Late);
  };
  monitor.seconds_to_finish = [&](const render::Picture& picture) {
    return seconds_to_write(picture, outputs, options, lowered.output.mapping);
  };
  const InterruptGuard interrupt(monitor.cancel);
  const ProgressReporter progress(progress_style(options, env), monitor, lowered.settings, env.err,
                                  std::move(part));
  return render::render(std::move(kernel), std::move(lowered.scene), lowered.settings, monitor);
}

/// Prints the final line and returns the status of the command.
ExitCode conclude(const RenderOptions& options, const render::RenderSettings& settings,
                  const render::RenderResult& result, const Written& written, Environment& env) {
  // The scene is at fault, with a warning about it (W501).
  const bool is_too_bright = result.kernel.bounds[render::PrecisionClause::Radiance].share > 1;
  if (result.nonfinite_samples > 0) {
    env.err << fmt::format("error: {} samples are not finite and were left out{}\n",
                           result.nonfinite_samples,
                           is_too_bright ? ": colors or intensities are beyond the precision" : "");
  }
  if (!result.is_complete) {
    const std::string of =
        settings.has_goal()
            ? ""
            : fmt::format(" of {}", format_count(static_cast<double>(total_samples(settings))));
    const std::string saved =
        written.names.empty()
            ? "nothing was saved"
            : fmt::format("the partial picture was {} {}",
                          written.names.front() == kStandardOutput ? "written to" : "saved as",
                          fmt::join(written.names, ", "));
    env.err << fmt::format("interrupted after {}{} samples; {}\n",
                           format_count(static_cast<double>(result.camera_samples)), of, saved);
    return graver(ExitCode::Interrupted, written.code);
  }
  for (const std::string& warning : accuracy_warnings(settings, result)) {
    env.err << "warning: " << warning << "\n";
  }
  if (const int wanted = render::wanted_threads(settings.threads); result.threads < wanted) {
    env.err << fmt::format("warning: {} of {} threads could be started\n", result.threads, wanted);
  }
  const bool is_quiet = options.quiet || options.progress == "none";
  if (!is_quiet && !written.names.empty()) {
    env.err << fmt::format(
        "{}: {} x {} pixels, {}, {} ({} samples/s){}{}\n", fmt::join(written.names, ", "),
        settings.width, settings.height, describe_samples(result),
        format_seconds(result.render_seconds),
        format_count(static_cast<double>(result.camera_samples) / result.render_seconds),
        describe_error(result), describe_light_choice(result.kernel));
  }
  const ExitCode of_samples = result.nonfinite_samples == 0 ? ExitCode::Success
                              : is_too_bright               ? ExitCode::Findings
                                                            : ExitCode::Defect;
  return graver(of_samples, written.code);
}

/// What the scenes of one command share.
struct RenderRun {
  std::size_t files = 1, files_before = 0;
  OutputSet outputs;
  std::string stats;  ///< of the pictures so far, one per line
  bool has_stats_file = false;
  std::shared_ptr<ProgressSchedule> schedule = std::make_shared<ProgressSchedule>();
  std::atomic<bool> interrupted{false};
  std::optional<InterruptGuard> guard;
};

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
    check_videos();
    // Errors that do not depend on the frame.
    const bool is_broken = sink_.has_errors();
    ExitCode code = ExitCode::Success;
    for (std::size_t i = 0; i < frames_.size() && !run_.interrupted.load(); ++i) {
      const ExitCode of_frame = render_or_skip(i);
      code = graver(code, of_frame);
      if (of_frame == ExitCode::Success) continue;
      if (of_frame == ExitCode::Interrupted) break;
      if (frames_[i]) failed_.push_back(*frames_[i]);
      if (options_.fails_fast || is_broken) break;
    }
    report_frames();
    code = graver(code, finish_videos());
    return run_.interrupted.load() && finished_ > 0 ? report_interrupted(code) : code;
  }

 private:
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

  /// Reports an interruption after a finished picture.
  ExitCode report_interrupted(ExitCode code) {
    if (code == ExitCode::Interrupted)
      return code;  // interrupted within a picture, which has been
                    // reported
    env_.err << fmt::format("interrupted; {}\n", frames_.size() == 1
                                                     ? "the picture was finished"
                                                     : fmt::format("{} of {} frames were finished",
                                                                   finished_, frames_.size()));
    return graver(ExitCode::Interrupted, code);
  }

  void choose_frames() {
    const std::optional<lang::Animation> animation = compiler_->animation();
    if (!animation && options_.frames && !sink_.has_errors()) {
      throw UsageError("--frames: the scene has no `animation`, so all frames are the same");
    }
    if (!animation) {
      frames_ = {std::nullopt};
      choose_videos();
      return;
    }
    const FrameRange all{
        .first = animation->first, .last = animation->last, .step = animation->step};
    for (const int frame : frames_of(options_.frames.value_or(std::vector{all}))) {
      frames_.emplace_back(frame);
    }
    warn_of_frames_outside(*animation);
    choose_videos();
    frames_per_second_ = animation->fps;
    if (frames_.size() == 1) return;
    frames_per_second_ /= *frames_[1] - *frames_[0];
    for (const std::string& output : pictures_) {
      if (has_frame_mark(output)) continue;
      throw UsageError(fmt::format("{} frames cannot all be written to `{}`; put {} in its name",
                                   frames_.size(), lang::printable(output), kFrameMark));
    }
  }

  void warn_of_frames_outside(const lang::Animation& animation) {
    std::vector<int> outside;
    for (const std::optional<int> frame : frames_) {
      if (*frame < animation.first || *frame > animation.last) outside.push_back(*frame);
    }
    if (outside.empty()) return;
    env_.err << fmt::format("warning: --frames: {} {} outside of the animation, {} to {}\n",
                            describe_frames(outside), outside.size() == 1 ? "is" : "are",
                            animation.first, animation.last);
  }

  /// Divides the outputs into videos of all frames and pictures of one.
  void choose_videos() {
    for (const std::string& output : options_.outputs) {
      const std::optional<VideoFormat> format = video_format_of(output);
      const bool is_video =
          format && !has_frame_mark(output) && (is_only_video(*format) || frames_.size() > 1);
      if (!is_video) {
        pictures_.push_back(output);
        continue;
      }
      if (!frames_.front() && !sink_.has_errors()) {
        throw UsageError(fmt::format("`{}` is a video, but the scene has no `animation`",
                                     lang::printable(output)));
      }
      videos_.push_back({.path = name_of_scene(output, options_.scene.given_name()),
                         .format = *format,
                         .writer = nullptr});
    }
  }

  /// Foreseeable failures of videos, before the first frame.
  void check_videos() {
    const InputSet inputs(options_.files);
    for (const Video& video : videos_) {
      check_ffmpeg(video.path);
      inputs.check_not_in(video.path);
      run_.outputs.add(video.path);
      render::check_writable(video.path);
      if (options_.keeps_existing) check_absent(video.path);
    }
  }

  void add_to_videos(const render::Picture& picture, const render::ToneMapping& mapping) {
    if (videos_.empty()) return;
    const std::vector<std::byte> frame =
        render::encode_picture(picture, {.format = render::ImageFormat::Ppm, .mapping = mapping});
    for (Video& video : videos_) {
      if (!video.writer) {
        video.writer =
            std::make_unique<VideoWriter>(video.path, video.format,
                                          VideoSettings{.width = picture.width,
                                                        .height = picture.height,
                                                        .frames_per_second = frames_per_second_,
                                                        .crf = options_.crf});
      }
      video.writer->add(frame);
    }
  }

  /// Puts the videos in their places if they have all frames.
  ExitCode finish_videos() {
    ExitCode code = ExitCode::Success;
    for (Video& video : videos_) {
      if (finished_ == frames_.size()) {
        try_to_write(code, env_, [&] { video.writer->finish(); });
        if (code == ExitCode::Success && !options_.quiet && options_.progress != "none") {
          env_.err << fmt::format("{}: {} frames, {} per second\n", lang::printable(video.path),
                                  frames_.size(), frames_per_second_);
        }
      } else {
        env_.err << fmt::format("error: `{}` was not written, because it has {} of {} frames\n",
                                lang::printable(video.path), finished_, frames_.size());
      }
      video.writer.reset();
    }
    return code;
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
    statistics.compile = compiler_->times();
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
    request.width = lowered.settings.width;
    request.height = lowered.settings.height;
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
    sandbox_.emplace(env_.workspace, lowered.output.output.empty() ? "" : options_.scene.name());
  }

  ExitCode render_frame(std::size_t index, bool is_last) {
    const std::optional<int> frame = frames_[index];
    const auto start = has_compiled_ ? std::chrono::steady_clock::now() : start_;
    RenderStatistics statistics;
    std::optional<LoweredFrame> lowered_frame = lower(frame, statistics);
    if (!lowered_frame) return ExitCode::Findings;
    auto& [lowered, kernel, choice_seconds] = *lowered_frame;
    if (run_.interrupted.load()) return ExitCode::Success;  // between two frames
    find_inputs(lowered);
    if (options_.skips_existing && videos_.empty() &&
        are_written(output_request(lowered.output.output, frame))) {
      ++skipped_;
      return ExitCode::Success;
    }
    if (is_last) {  // free text and tree before tracing
      compiler_.reset();
      source_.reset();
    }

    lowered.settings.keeps_variance = options_.aovs.variance;
    lowered.settings.keeps_first_hits = options_.aovs.has_features();
    const render::RenderSettings settings = lowered.settings;
    const std::vector<Output> outputs = plan_frame(lowered, frame);
    check_aovs(options_.aovs, outputs, settings);
    check_memory(settings, options_.aovs);
    check_not_refused(kernel);

    if (settings.seconds) {
      lowered.settings.seconds =
          std::max(*settings.seconds - render::seconds_since(start), kMinSecondsToTrace);
    }
    // Until here there is nothing to save, and a signal may end the process.
    if (!run_.guard) run_.guard.emplace(run_.interrupted);
    render::RenderResult result = trace(lowered, std::move(kernel), options_, outputs,
                                        progress_part(index), statistics, env_);
    result.build_seconds += choice_seconds;
    if (!result.is_complete) {
      if (result.camera_samples == 0) return conclude(options_, settings, result, {}, env_);
      env_.err << "interrupted; saving the partial picture" << std::endl;
    }
    const std::vector<render::Layer> layers =
        picture_layers(options_.aovs, settings, result, env_.err);
    const auto write_start = std::chrono::steady_clock::now();
    Written written = write_pictures(outputs, options_, lowered, result, layers, env_);
    if (result.is_complete) {
      try_to_write(written.code, env_,
                   [&] { add_to_videos(result.picture, lowered.output.mapping); });
    }
    statistics.write_seconds = render::seconds_since(write_start);
    if (!options_.stats.empty()) {
      run_.stats += to_json(statistics, result) + "\n";
      if (options_.stats != kStandardStream) {
        try_to_write(written.code, env_, [&] { write_stats(options_.stats, run_.stats, env_); });
      }
    }
    if (result.is_complete && written.code == ExitCode::Success) ++finished_;
    return conclude(options_, settings, result, written, env_);
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
  struct Video {
    std::string path;
    VideoFormat format;
    std::unique_ptr<VideoWriter> writer;  // from the first frame on
  };
  std::vector<Video> videos_;
  double frames_per_second_ = 24;
  double read_seconds_ = 0;
  bool has_compiled_ = false;
  bool has_planned_ = false;
  std::vector<std::string> inputs_;
  std::optional<lang::Sandbox> sandbox_;
  std::size_t finished_ = 0, skipped_ = 0;  // frames
  std::vector<int> failed_;
};

/// Refuses what cannot be meant for several scenes.
void check_several(const RenderOptions& options) {
  for (const std::string& output : options.outputs) {
    if (output.find(kNameMark) != std::string::npos) continue;
    if (output == kStandardStream) {
      throw UsageError(
          fmt::format("{} scenes cannot all be written to standard output", options.files.size()));
    }
    throw UsageError(fmt::format("{} scenes cannot all be written to `{}`; put {} in its name",
                                 options.files.size(), lang::printable(output), kNameMark));
  }
  if (std::ranges::count(options.files, kStandardStream) > 1) {
    throw UsageError("standard input holds only one scene");
  }
}

ExitCode render_files(RenderOptions& options, RenderRun& run, Environment& env) {
  if (run.files == 1) {
    options.scene.file = options.files.front();
    return RenderJob(options, run, env).run();
  }
  check_several(options);
  ExitCode code = ExitCode::Success;
  std::vector<std::string> failed;
  for (const std::string& file : options.files) {
    options.scene.file = file;
    const ExitCode of_file =
        report_failure(env, [&] { return RenderJob(options, run, env).run(); });
    code = graver(code, of_file);
    ++run.files_before;
    if (of_file == ExitCode::Interrupted || run.interrupted.load()) break;
    if (of_file == ExitCode::Success) continue;
    failed.push_back(lang::printable(options.scene.name()));
    if (options.fails_fast) break;
  }
  if (!failed.empty()) {
    env.err << fmt::format("error: {} of {} scenes failed: {}\n", failed.size(), run.files,
                           fmt::join(failed, ", "));
  }
  return code;
}

ExitCode run_render(RenderOptions& options, Environment& env) {
  RenderRun run;
  run.files = options.files.size();
  ExitCode code = render_files(options, run, env);
  if (options.stats == kStandardStream && !run.stats.empty()) {
    try_to_write(code, env, [&] { write_stats(options.stats, run.stats, env); });
  }
  return code;
}

}  // namespace

void add_render_command(Command& program, Dispatcher& dispatcher) {
  auto options = std::make_shared<RenderOptions>();
  Command command =
      program.add_command("render", "Render .scene files and .json configs to pictures");
  command.add_texts("FILE", options->files, "The scenes; `-` reads standard input").required();
  add_set_option(command, options->scene.sets);
  add_reading_options(command, options->scene.reading);
  add_diagnostics_options(command, options->scene.diagnostics);
  command.add_repeated(
      "-o,--output", options->outputs,
      "A picture to write, by its extension (may be repeated; `-`: PNG to standard "
      "output). Default: that of the scene, otherwise FILE's stem with .png");
  add_override_options(command, options->overrides);
  add_kernel_options(command, options->kernel);
  add_aov_option(command, options->aovs);
  add_whole_number(
      command, "--crf", {.highest = 51},
      [options](std::uint64_t crf) { options->crf = static_cast<int>(crf); },
      "Quality of mp4, mkv and webm: the constant rate factor, 0 is the best (18)");
  command.add_flag("--ppm-text", options->ppm_text, "Write PPM as decimal numbers");
  const Option no_clobber = command.add_flag("--no-clobber,!--overwrite", options->keeps_existing,
                                             "Refuse to replace files");
  command
      .add_flag("--skip-existing", options->skips_existing,
                "Render only pictures whose files are not there")
      .excludes(no_clobber);
  command.add_flag("--fail-fast", options->fails_fast,
                   "End at the first scene or frame that fails; default: render the others");
  command.add_text("--progress", options->progress, "Format of the progress on standard error")
      .one_of(kProgressWords);
  command.add_text(
      "--stats", options->stats,
      "Write statistics to this file, as JSON, a line for each picture; `-`: standard output");
  command.add_flag("--quiet", options->quiet, "Only diagnostics on standard error");
  command
      .add_text(
          "--frames",
          [options](const std::string& text) {
            options->frames = parse_frames(text);
            if (options->frames) return;
            throw ArgumentError(
                "--frames",
                fmt::format("takes A, A-B or A-BxS, separated by commas, with whole numbers, A at "
                            "most B, not `{}`",
                            lang::printable(text)));
          },
          "The frames to render, every S-th from A to B; default: those of the scene's animation")
      .type_name("A-B[xS][,...]");
  command.footer(
      "Examples:\n"
      "  sdlc render ball.scene\n"
      "  sdlc render ball.scene -o ball.png -o ball.exr --samples 256\n"
      "  sdlc render config.json --width 320 --samples 16 --progress none --stats stats.json\n"
      "  sdlc render ball.scene --error 1%\n"
      "  sdlc render ball.scene --time 10s --samples 4096\n"
      "  sdlc render ball.scene -o ball.exr --aov normal,depth,albedo\n"
      "  cat ball.scene | sdlc render - -o - > ball.png\n"
      "  sdlc render ring.scene --set count=200 --frames 1-24,48 -o ring.####.png\n"
      "  sdlc render ring.scene -o ring.mp4\n"
      "  sdlc render scenes/*.scene -o out/{name}.png --skip-existing\n"
      "\n"
      "#### in an output's name is replaced by the frame number, {name} by the scene's name "
      "without\n"
      "folder and extension. mp4 webm mkv apng, and gif and webp without ####, hold all frames; "
      "they "
      "need\nffmpeg.\n"
      "png jpg tiff webp ppm gif hold 8-bit codes after the scene's tone curve; exr and hdr hold "
      "linear\n"
      "radiance. --width or --height alone keeps the aspect, both together set a new one. Ctrl-C "
      "saves the\n"
      "partial picture as NAME.partial.EXT, or lets a finished picture be written; a second one "
      "ends at once.");
  dispatcher.on(command, [options](Environment& env) { return run_render(*options, env); });
}

}  // namespace sdlc::cli
