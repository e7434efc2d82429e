#include "cli/program.hpp"

#include <algorithm>
#include <ranges>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/command_line.hpp"
#include "cli/dispatcher.hpp"
#include "cli/report_failure.hpp"
#include "cli/version.hpp"
#include "render/image/io_error.hpp"
#include "render/kernel/backend.hpp"

namespace sdlc::cli {
namespace {

std::string version_text() {
  const bool has_vectors = !render::available_vectors().empty();
  const std::string_view in_use = has_vectors ? render::best_backend().name : kInstructionSet;
  const auto names = render::vector_backends() | std::views::transform(&render::Backend::name);
  return fmt::format("sdlc {} ({})\nbuilt for {} with {}, in use {}\n", kVersion, kCommit,
                     kInstructionSet, fmt::join(names, ", "), in_use);
}

/// `help render` as `render --help`; a command that is unknown as if it were called.
std::vector<std::string> with_help_flag(std::span<const std::string> arguments,
                                        const CommandInfo& program) {
  std::vector<std::string> all(arguments.begin(), arguments.end());
  if (all.empty() || all.front() != "help") return all;
  all.erase(all.begin());
  const bool is_known =
      all.empty() || std::ranges::find(program.commands, all.front(), &CommandInfo::name) !=
                         program.commands.end();
  if (is_known) all.emplace_back("--help");
  return all;
}

ExitCode parse_and_run(std::span<const std::string> arguments, Environment& env) {
  CommandLine command_line("sdlc", "Compiles scene descriptions and renders them.");
  Command program = command_line.program();
  program.footer(
      "Examples:\n"
      "  sdlc new ball                           writes ball.scene, a scene to begin with\n"
      "  sdlc render ball.scene                  renders to ball.png\n"
      "  sdlc serve ball.scene                   shows it in the browser while it is written\n"
      "  sdlc render old.json -o old.exr         a JSON config, to linear radiance\n"
      "  sdlc lint scenes/                       checks without rendering\n"
      "  sdlc fmt scenes/                        formats them\n"
      "  sdlc convert old.json                   a JSON config as a scene, or a scene as a config\n"
      "  sdlc inspect ball.scene                 size, memory and precision of a scene\n"
      "  sdlc measure ball.scene                 error against render time\n"
      "  sdlc compare new.exr reference.exr      difference between two pictures\n"
      "  sdlc pack ball.scene                    a scene with all that it reads, in one file\n"
      "  sdlc merge part*.film -o ball.png       parts from many machines, to one picture\n"
      "  sdlc farm ball.scene --engine slurm -o job\n"
      "                                          job files for many machines\n"
      "  sdlc lsp                                language server for editors\n"
      "  sdlc explain E104                       explains a message\n"
      "  sdlc help render                        help for one command\n"
      "\n"
      "Exit status: 0 done, 1 the scene has errors or findings, 2 wrong usage or a file cannot be "
      "read or written,\n"
      "3 a bug in sdlc, 75 trying again may help (a shard is missing, the disk was full), 130 "
      "interrupted.");
  bool wants_version = false;
  program.add_flag("--version", wants_version, "Print version, commit and instruction sets");
  Dispatcher dispatcher;
  add_new_command(program, dispatcher);
  add_render_command(program, dispatcher);
  add_serve_command(program, dispatcher);
  add_inspect_command(program, dispatcher);
  add_lint_command(program, dispatcher);
  add_fmt_command(program, dispatcher);
  add_convert_command(program, dispatcher);
  add_lsp_command(program, dispatcher);
  add_measure_command(program, dispatcher);
  add_compare_command(program, dispatcher);
  add_merge_command(program, dispatcher);
  add_pack_command(program, dispatcher);
  add_farm_command(program, dispatcher);
  add_explain_command(program, dispatcher);
  add_schema_command(program, dispatcher);
  add_completions_command(program, dispatcher);
  add_man_command(program, dispatcher);
  add_complete_command(program, dispatcher);

  try {
    if (!command_line.parse(with_help_flag(arguments, program.info()))) {
      env.out << command_line.help();
      return ExitCode::Success;
    }
  } catch (const ArgumentError& error) {
    env.err << fmt::format("error: {}\n", error.what())
            << "See `sdlc --help` and `sdlc COMMAND --help`.\n";
    return ExitCode::Usage;
  }
  if (wants_version) {
    env.out << version_text();
    return ExitCode::Success;
  }
  if (!dispatcher.chosen()) {
    env.err << command_line.help();
    return ExitCode::Usage;
  }
  return dispatcher.chosen()(env);
}

}  // namespace

ExitCode run_program(std::span<const std::string> arguments, Environment& env) {
  env.arguments = arguments;
  return report_failure(env, [&] {
    const ExitCode code = parse_and_run(arguments, env);
    if (!env.out.flush()) throw render::IoError("write", "standard output", "the write failed");
    return code;
  });
}

}  // namespace sdlc::cli
