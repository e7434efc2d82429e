#include "cli/program.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/dispatcher.hpp"
#include "cli/usage_error.hpp"
#include "cli/version.hpp"
#include "cli/words.hpp"
#include "lang/text/display_width.hpp"
#include "render/image/io_error.hpp"
#include "render/kernel/backend.hpp"
#include "render/parallel/threads.hpp"

namespace sdlc::cli {
namespace {

std::string version_text() {
  const bool has_vectors = !render::available_vectors().empty();
  const std::string_view in_use = has_vectors ? render::best_backend().name : kInstructionSet;
  const auto names = render::vector_backends() | std::views::transform(&render::Backend::name);
  return fmt::format("sdlc {} ({})\nbuilt for {} with {}, in use {}\n", kVersion, kCommit,
                     kInstructionSet, fmt::join(names, ", "), in_use);
}

/// The names of all flags of a command, with their dashes.
std::vector<std::string> flags_of(const CLI::App& app) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
    for (const std::string& name : option->get_snames()) flags.push_back("-" + name);
  }
  return flags;
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return names;
}

/// The message for arguments that do not parse.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error,
                        std::span<const std::string> arguments) {
  const auto all_commands = app.get_subcommands([](const CLI::App*) { return true; });
  const bool has_command = !app.get_subcommands().empty();
  const CLI::App& command = has_command ? *app.get_subcommands().front() : app;
  const auto suggestion = [](const std::string& name, const std::vector<std::string>& candidates) {
    const std::vector<std::string_view> views(candidates.begin(), candidates.end());
    return did_you_mean(name, views);
  };

  if (!has_command && !arguments.empty() && !arguments[0].starts_with('-')) {
    return fmt::format("unknown command `{}`{}", arguments[0],
                       suggestion(arguments[0], names_of(all_commands)));
  }
  for (const std::string& extra : app.remaining(true)) {
    if (!extra.starts_with('-') || extra == "-")
      return fmt::format("unexpected argument `{}`", extra);
    const std::string flag = extra.substr(0, extra.find('='));
    const std::vector<std::string> known = flags_of(command);
    if (has_command && std::find(known.begin(), known.end(), flag) != known.end()) {
      return fmt::format("`{}` belongs after `{}`", flag, command.get_name());
    }
    return fmt::format("unknown flag `{}`{}", flag, suggestion(flag, known));
  }
  return error.what();
}

ExitCode parse_and_run(std::span<const std::string> arguments, Environment& env) {
  CLI::App app("Compiles scene descriptions and renders them.", "sdlc");
  app.footer(
      "Examples:\n"
      "  sdlc render ball.scene                  renders to ball.png\n"
      "  sdlc render old.json -o old.exr         a JSON config, to linear radiance\n"
      "  sdlc lint scenes/                       checks without rendering\n"
      "  sdlc fmt scenes/                        formats them\n"
      "  sdlc convert old.json                   a JSON config as a scene, or a scene as a config\n"
      "  sdlc inspect ball.scene                 size, memory and precision of a scene\n"
      "  sdlc measure ball.scene                 error against render time\n"
      "  sdlc compare new.exr reference.exr      difference between two pictures\n"
      "  sdlc explain E104                       explains a message\n"
      "  sdlc render --help                      help for one command\n"
      "\n"
      "Exit status: 0 done, 1 the scene has errors or findings, 2 wrong usage or a file cannot be "
      "read or written,\n"
      "3 a bug in sdlc, 130 interrupted.");
  bool wants_version = false;
  app.add_flag("--version", wants_version, "Print version, commit and instruction sets");
  app.require_subcommand(0, 1);
  Dispatcher dispatcher;
  add_render_command(app, dispatcher);
  add_inspect_command(app, dispatcher);
  add_lint_command(app, dispatcher);
  add_fmt_command(app, dispatcher);
  add_convert_command(app, dispatcher);
  add_measure_command(app, dispatcher);
  add_compare_command(app, dispatcher);
  add_explain_command(app, dispatcher);
  add_schema_command(app, dispatcher);

  try {
    // CLI11 takes its arguments in reverse order.
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForHelp&) {
    const bool has_command = !app.get_subcommands().empty();
    env.out << (has_command ? app.get_subcommands().front()->help() : app.help());
    return ExitCode::Success;
  } catch (const CLI::ParseError& error) {
    env.err << fmt::format("error: {}\n", usage_error(app, error, arguments))
            << "See `sdlc --help` and `sdlc COMMAND --help`.\n";
    return ExitCode::Usage;
  }
  if (wants_version) {
    env.out << version_text();
    return ExitCode::Success;
  }
  if (!dispatcher.chosen()) {
    env.err << app.help();
    return ExitCode::Usage;
  }
  const render::ThreadLimit threads;
  return dispatcher.chosen()(env);
}

}  // namespace

ExitCode run_program(std::span<const std::string> arguments, Environment& env) {
  env.arguments = arguments;
  try {
    const ExitCode code = parse_and_run(arguments, env);
    if (!env.out.flush()) throw render::IoError("write", "standard output", "the write failed");
    return code;
  } catch (const UsageError& error) {
    env.err << fmt::format("error: {}\n", error.what());
    return ExitCode::Usage;
  } catch (const render::IoError& error) {
    env.err << fmt::format("error: {}\n", lang::printable(error.what()));
    return ExitCode::Usage;
  } catch (const std::filesystem::filesystem_error& error) {
    env.err << fmt::format("error: {}\n", lang::printable(error.what()));
    return ExitCode::Usage;
  } catch (const std::bad_alloc&) {
    env.err << "error: not enough memory for this scene and picture\n";
    return ExitCode::Usage;
  } catch (const std::exception& error) {
    if (render::is_thread_shortage(error)) throw;
    env.err << fmt::format("error: a defect in sdlc: {}\n", error.what());
    return ExitCode::Defect;
  }
}

}  // namespace sdlc::cli
