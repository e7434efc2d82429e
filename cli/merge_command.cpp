#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
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
#include "cli/film_result.hpp"
#include "cli/frames.hpp"
#include "cli/outputs.hpp"
#include "cli/picture_outputs.hpp"
#include "cli/report_failure.hpp"
#include "cli/statistics.hpp"
#include "cli/usage_error.hpp"
#include "cli/whole_number.hpp"
#include "lang/text/display_width.hpp"
#include "render/film/film_file.hpp"
#include "render/session/render_film.hpp"

namespace sdlc::cli {
namespace {

struct MergeOptions {
  std::vector<std::string> films;
  std::vector<std::string> outputs;
  std::optional<std::uint32_t> expected;  // shards
  render::Aovs aovs;
  std::string stats;
  bool ppm_text = false;
  bool keeps_existing = false;
  bool quiet = false;
};

/// What all pictures of a merge share.
struct MergeRun {
  OutputSet outputs;
  std::string stats;
};

/// Joins the films of one picture.
class MergeJob {
 public:
  MergeJob(const MergeOptions& options, std::vector<std::string> films, std::optional<int> frame,
           MergeRun& run, Environment& env)
      : options_(options), films_(std::move(films)), frame_(frame), run_(run), env_(env) {}

  ExitCode run() {
    ExitCode code = ExitCode::Success;
    for (const std::string& name : films_) {
      code = graver(code, report_failure(env_, [&] { return add(name); }));
    }
    if (code != ExitCode::Success) return code;
    if (options_.expected && *options_.expected != film_->record.shards) {
      env_.err << fmt::format("error: the films are shards of {}, not of {}\n",
                              film_->record.shards, *options_.expected);
      return ExitCode::Findings;
    }
    return write();
  }

 private:
  ExitCode add(const std::string& name) {
    render::StoredFilm film = render::read_film_file(name);
    for (const std::uint32_t shard : film.shards) {
      const auto [earlier, is_new] = of_shard_.try_emplace(shard, name);
      if (is_new) continue;
      throw render::FilmError(render::FilmError::Reason::Doubled, name,
                              fmt::format("it has shard {}, as `{}` has", shard, earlier->second));
    }
    if (film.shards.empty()) unfinished_.push_back(lang::printable(name));
    if (film_) {
      add_film(*film_, film, name);
    } else {
      film_ = std::move(film);
    }
    return ExitCode::Success;
  }

  ExitCode write() {
    const render::RenderSettings settings = settings_of(*film_);
    const std::vector<Output> outputs = plan(settings);
    check_aovs(options_.aovs, outputs, settings);
    check_channels();
    const std::vector<std::uint32_t> missing = missing_shards(*film_);
    const bool is_whole = missing.empty();
    ExitCode code = ExitCode::Success;
    Written written = write_pictures(outputs, settings, is_whole);
    shards_ = film_->record.shards;
    if (is_whole) make_whole();
    for (const Output& output : outputs) {
      if (!output.is_film || (options_.expected && !is_whole)) continue;
      try_to_write(written.code, env_, [&] {
        write_film_file(output.path, *film_);
        written.films.push_back(lang::printable(output.path.string()));
      });
    }
    if (!is_whole && (options_.expected || !written.names.empty())) {
      report_missing(missing, written);
      code = ExitCode::TryAgain;
    } else {
      conclude(settings, missing, written);
    }
    return graver(code, written.code);
  }

  /// Makes the film that of a render without shards.
  void make_whole() {
    film_->record.shards = 1;
    film_->record.cut = {};
    film_->shards = {1};
  }

  std::vector<Output> plan(const render::RenderSettings& settings) {
    OutputRequest request{.pictures = options_.outputs,
                          .of_scene = {},
                          .input = film_->record.scene,
                          .keeps_existing = options_.keeps_existing,
                          .width = settings.window().width,
                          .height = settings.window().height};
    request.frame = frame_;
    request.all_frames = {frame_};
    request.inputs = options_.films;
    request.earlier = &run_.outputs;
    if (run_.stats.empty()) request.stats = options_.stats;
    return plan_outputs(request);
  }

  void check_channels() const {
    if (!options_.aovs.has_features() || film_->origin.has_first_hits) return;
    throw UsageError(
        "--aov: the films have no normal, depth and albedo; render them with the same --aov");
  }

  Written write_pictures(const std::vector<Output>& outputs, const render::RenderSettings& settings,
                         bool is_whole) {
    if (std::ranges::all_of(outputs, &Output::is_film) && options_.stats.empty()) return {};
    render::RenderResult result = film_result(*film_);
    result.is_complete = result.is_complete && is_whole;
    if (!result.is_complete) result.error.reset();
    if (film_->record.is_denoised) {
      env_.err << "warning: the picture is not denoised: that takes the scene\n";
    }
    const PictureForm form{
        .mapping = {.tone = film_->record.tone, .exposure = film_->record.exposure},
        .ppm_text = options_.ppm_text};
    const std::vector<render::Layer> layers =
        picture_layers(options_.aovs, settings, result, env_.err);
    Written written = cli::write_pictures(outputs, form, settings, result, layers, env_);
    if (result.is_complete && !options_.stats.empty()) {
      run_.stats += to_json(statistics(settings), result) + "\n";
      try_to_write(written.code, env_, [&] { write_stats(options_.stats, run_.stats, env_); });
    }
    if (result.is_complete && !written.names.empty()) {
      for (const std::string& warning : accuracy_warnings(settings, result)) {
        env_.err << "warning: " << warning << "\n";
      }
    }
    description_ = fmt::format("{}{}", describe_samples(result), describe_error(result));
    return written;
  }

  RenderStatistics statistics(const render::RenderSettings& settings) const {
    const render::PictureRecord& record = film_->record;
    RenderStatistics statistics;
    statistics.scene = record.scene;
    statistics.settings = settings;
    statistics.spheres = record.spheres;
    statistics.instances = record.instances;
    for (std::size_t begin = 0; begin < record.features.size();) {
      const std::size_t end = std::min(record.features.find(' ', begin), record.features.size());
      statistics.features.push_back(record.features.substr(begin, end - begin));
      begin = end + 1;
    }
    statistics.is_merged = true;
    return statistics;
  }

  void report_missing(const std::vector<std::uint32_t>& missing, const Written& written) const {
    std::vector<int> numbers(missing.begin(), missing.end());
    std::string what =
        shards_ == 1
            ? "the film is not finished"
            : fmt::format("{} of {} shards {} missing or not finished: {}", missing.size(), shards_,
                          missing.size() == 1 ? "is" : "are", describe_frames(numbers));
    if (!unfinished_.empty() && shards_ > 1) {
      what += fmt::format("; not finished: {}", fmt::join(unfinished_, ", "));
    }
    if (!written.names.empty()) {
      what += fmt::format("; the partial picture was saved as {}", fmt::join(written.names, ", "));
    }
    env_.err << fmt::format("error: {}\n", what);
  }

  void conclude(const render::RenderSettings& settings, const std::vector<std::uint32_t>& missing,
                const Written& written) const {
    const std::vector<std::string> names = written.all();
    if (options_.quiet || names.empty()) return;
    env_.err << fmt::format(
        "{}: {} x {} pixels{}{}\n", fmt::join(names, ", "), settings.window().width,
        settings.window().height, description_.empty() ? "" : ", " + description_,
        shards_ == 1 ? "" : fmt::format(", {} of {} shards", shards_ - missing.size(), shards_));
  }

  const MergeOptions& options_;
  std::vector<std::string> films_;
  std::optional<int> frame_;
  MergeRun& run_;
  Environment& env_;
  std::optional<render::StoredFilm> film_;
  std::map<std::uint32_t, std::string> of_shard_;
  std::vector<std::string> unfinished_;
  std::uint32_t shards_ = 1;
  std::string description_;
};

ExitCode run_merge(const MergeOptions& options, Environment& env) {
  check_formats(options.outputs);
  MergeRun run;
  // Films of several frames are pictures of their own.
  std::map<std::optional<int>, std::vector<std::string>> by_frame;
  ExitCode code = ExitCode::Success;
  for (const std::string& name : options.films) {
    code = graver(code, report_failure(env, [&] {
                    by_frame[render::read_film_head(name).record.frame].push_back(name);
                    return ExitCode::Success;
                  }));
  }
  if (code != ExitCode::Success) return code;
  for (const std::string& output : options.outputs) {
    if (by_frame.size() == 1 || has_frame_mark(output)) continue;
    throw UsageError(fmt::format("the films are of {} frames; put {} in the name of `{}`",
                                 by_frame.size(), kFrameMark, lang::printable(output)));
  }
  for (auto& [frame, films] : by_frame) {
    code = graver(code, report_failure(env, [&, frame = frame, &films = films] {
                    return MergeJob(options, std::move(films), frame, run, env).run();
                  }));
  }
  return code;
}

}  // namespace

void add_merge_command(Command& program, Dispatcher& dispatcher) {
  auto options = std::make_shared<MergeOptions>();
  Command command = program.add_command(
      "merge", "Join the films of shards to the picture that one machine would have rendered");
  command.add_texts("FILM", options->films, "The film files, in any order").required();
  command
      .add_repeated("-o,--output", options->outputs,
                    "A picture or film to write, by its extension (may be repeated; `-`: PNG to "
                    "standard output)")
      .required();
  add_whole_number(
      command, "--expect", {.lowest = 1, .highest = render::kMaxShards},
      [options](std::uint64_t n) { options->expected = static_cast<std::uint32_t>(n); },
      "Fail unless all of N shards are there");
  add_aov_option(command, options->aovs);
  command.add_flag("--ppm-text", options->ppm_text, "Write PPM as decimal numbers");
  command.add_flag("--no-clobber,!--overwrite", options->keeps_existing, "Refuse to replace files");
  command.add_text("--stats", options->stats,
                   "Write statistics to this file, as JSON; `-`: standard output");
  command.add_flag("--quiet", options->quiet, "Only errors on standard error");
  command.footer(
      "Examples:\n"
      "  sdlc merge part1.film part2.film part3.film -o picture.exr\n"
      "  sdlc merge part*.film -o picture.png --expect 8\n"
      "  sdlc merge part1.film part2.film -o half.film\n"
      "  sdlc merge part*.film -o frame.####.png\n"
      "\n"
      "If shards are missing, the partial picture is written as NAME.partial.EXT, and the exit "
      "status is 75.\nA film that is damaged, of another picture, or there twice is named, its "
      "picture is not\nwritten, and the exit status is 1. Films of several frames are merged frame "
      "by frame.");
  dispatcher.on(command, [options](Environment& env) { return run_merge(*options, env); });
}

}  // namespace sdlc::cli
