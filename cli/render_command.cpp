#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/amounts.hpp"
#include "cli/aov_option.hpp"
#include "cli/command_line.hpp"
#include "cli/dispatcher.hpp"
#include "cli/frames_option.hpp"
#include "cli/kernel_options.hpp"
#include "cli/override_options.hpp"
#include "cli/picture_outputs.hpp"
#include "cli/render_job.hpp"
#include "cli/render_options.hpp"
#include "cli/render_watch.hpp"
#include "cli/report_failure.hpp"
#include "cli/scene_options.hpp"
#include "cli/terminal/preview.hpp"
#include "cli/terminal/status_line.hpp"
#include "cli/usage_error.hpp"
#include "cli/whole_number.hpp"
#include "lang/text/display_width.hpp"

namespace sdlc::cli {
namespace {

constexpr std::array<std::string_view, 5> kProgressWords{"auto", "plain", "json", "openjd", "none"};

/// Refuses what cannot be meant for several scenes.
void check_several(const RenderOptions& options) {
  for (const std::string& output : options.outputs) {
    if (has_name_mark(output)) continue;
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
  const auto render_file = [&](const std::string& file) {
    options.scene.file = file;
    if (is_film_name(options.scene.file)) {
      const std::string film = lang::printable(options.scene.file);
      throw UsageError(fmt::format(
          "`{0}` is a film, not a scene; its picture: sdlc merge {0} -o NAME.png", film));
    }
    enter_pack(options.scene, env);
    return render_scene(options, run, env);
  };
  if (run.files == 1) {
    return render_file(options.files.front());
  }
  ExitCode code = ExitCode::Success;
  std::vector<std::string> failed;
  for (const std::string& file : options.files) {
    const ExitCode of_file = report_failure(env, [&] { return render_file(file); });
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

/// Renders, and reports a failure to a worker of Open Job Description, which reads standard output.
ExitCode render_for_openjd(RenderOptions& options, RenderRun& run, Environment& env) {
  if (options.stats == kStandardStream || std::ranges::count(options.outputs, kStandardStream)) {
    throw UsageError(
        "--progress openjd writes to standard output; write pictures and statistics to files");
  }
  const ExitCode code = report_failure(env, [&] { return render_files(options, run, env); });
  if (code == ExitCode::Success) {
    env.out << "openjd_progress: 100" << std::endl;
  } else {
    env.out << fmt::format("openjd_fail: sdlc ended with status {}; standard error has the reason",
                           static_cast<int>(code))
            << std::endl;
  }
  return code;
}

ExitCode render_once(RenderOptions& options, RenderRun& run, StatusLine& line, Environment& env) {
  run.files = options.files.size();
  run.schedule->line = &line;
  ExitCode code = options.progress == "openjd" ? render_for_openjd(options, run, env)
                                               : render_files(options, run, env);
  if (options.stats == kStandardStream && !run.stats.empty()) {
    try_to_write(code, env, [&] { write_stats(options.stats, run.stats, env); });
  } else if (run.is_stats_file_behind) {
    try_to_write(code, env, [&] { write_stats_so_far(options, run, env); });
  }
  return code;
}

ExitCode run_render(RenderOptions& options, Environment& given_env) {
  if (options.files.size() > 1) check_several(options);
  check_formats(options.outputs);
  StatusLine line(given_env.err);
  Environment env = given_env.with_err(line);
  std::optional<Preview> preview;
  if (options.has_preview) {
    const char* const terminal = std::getenv("TERM");
    if (!env.err_is_terminal || (terminal != nullptr && std::string_view(terminal) == "dumb")) {
      throw UsageError("--preview: standard error is no terminal that can show a picture");
    }
    preview.emplace(line);
  }
  if (options.watches) {
    return render_and_watch(options, line, env,
                            [&](RenderOptions& round, RenderRun& run, Environment& of_round) {
                              run.preview = preview ? &*preview : nullptr;
                              return render_once(round, run, line, of_round);
                            });
  }
  RenderRun run;
  run.preview = preview ? &*preview : nullptr;
  return render_once(options, run, line, env);
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
  add_crop_option(command, options->crop);
  add_whole_number(
      command, "--zoom", {.lowest = 1, .highest = 1000},
      [options](std::uint64_t zoom) { options->zoom = static_cast<int>(zoom); },
      "Write each pixel as N x N pixels");
  add_shard_options(command, options->shard, options->shard_by);
  const Option checkpoint =
      command
          .add_text(
              "--checkpoint",
              [options](const std::string& text) {
                options->checkpoint_seconds = parse_duration("--checkpoint", text);
              },
              "Keep the samples in a film file every T, such as `60s`: in -o NAME.film, otherwise "
              "beside the picture until it is finished. A video keeps its finished frames, too")
          .type_name("T");
  const Option resume = command.add_flag(
      "--resume", options->resumes,
      "Go on from what --checkpoint has kept, if it is there, to the same bytes as in one go");
  add_whole_number(
      command, "--crf", {.highest = 51},
      [options](std::uint64_t crf) { options->crf = static_cast<int>(crf); },
      "Quality of mp4, mkv and webm: the constant rate factor, 0 is the best, and not for all "
      "players (18)");
  command.add_flag("--ppm-text", options->ppm_text, "Write PPM as decimal numbers");
  const Option no_clobber = command.add_flag("--no-clobber,!--overwrite", options->keeps_existing,
                                             "Refuse to replace files");
  const Option skip = command
                          .add_flag("--skip-existing", options->skips_existing,
                                    "Render only pictures whose files are not there")
                          .excludes(no_clobber);
  command.add_flag("--preview", options->has_preview,
                   "Show the picture in the terminal while it is rendered");
  command
      .add_flag("--watch", options->watches,
                "Render again whenever the scene, or a file that it reads, changes")
      .excludes(checkpoint)
      .excludes(resume)
      .excludes(no_clobber)
      .excludes(skip);
  command.add_flag("--fail-fast", options->fails_fast,
                   "End at the first scene or frame that fails; default: render the others");
  command
      .add_text("--progress", options->progress,
                "Format of the progress on standard error; openjd: messages of Open Job "
                "Description on standard output")
      .one_of(kProgressWords);
  command.add_text(
      "--stats", options->stats,
      "Write statistics to this file, as JSON, a line for each picture; `-`: standard output");
  command.add_flag("--quiet", options->quiet, "Only diagnostics on standard error");
  add_frames_option(command, options->frames);
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
      "  sdlc render ball.scene --crop 40%,40%,20%,20% --zoom 8 -o detail.png\n"
      "  sdlc render scenes/*.scene -o out/{name}.png --skip-existing\n"
      "  sdlc render ball.scene --width 480 --samples 16 --preview --watch\n"
      "  sdlc render ball.scene --samples 65536 --checkpoint 60s --resume\n"
      "  sdlc render ball.scene --samples 4096 --shard 2/8 -o part2.film\n"
      "\n"
      "#### in an output's name is replaced by the frame number, {name} by the scene's name "
      "without\n"
      "folder and extension. mp4 webm mkv apng, and gif and webp without ####, hold all frames; "
      "all but\ngif need ffmpeg.\n"
      "A .film holds the samples, for --resume and `sdlc merge`.\n"
      "png jpg tiff webp ppm gif hold 8-bit codes after the scene's tone curve; exr and hdr hold "
      "linear\n"
      "radiance. --width or --height alone keeps the aspect, both together set a new one. Ctrl-C "
      "saves the\n"
      "partial picture as NAME.partial.EXT, or lets a finished picture be written; a second one "
      "ends at once.");
  dispatcher.on(command, [options](Environment& env) { return run_render(*options, env); });
}

}  // namespace sdlc::cli
