#pragma once

#include <functional>
#include <utility>

#include <CLI/CLI.hpp>

#include "cli/environment.hpp"
#include "cli/exit_code.hpp"

namespace sdlc::cli {

/// Selects the command that the arguments name.
class Dispatcher {
 public:
  using Command = std::function<ExitCode(Environment&)>;

  void on(CLI::App* app, Command command) {
    app->callback([this, command = std::move(command)] { chosen_ = command; });
  }
  const Command& chosen() const noexcept { return chosen_; }

 private:
  Command chosen_;
};

// One function per subcommand, in NAME_command.cpp.
void add_compare_command(CLI::App& app, Dispatcher& dispatcher);
void add_convert_command(CLI::App& app, Dispatcher& dispatcher);
void add_explain_command(CLI::App& app, Dispatcher& dispatcher);
void add_fmt_command(CLI::App& app, Dispatcher& dispatcher);
void add_inspect_command(CLI::App& app, Dispatcher& dispatcher);
void add_lint_command(CLI::App& app, Dispatcher& dispatcher);
void add_measure_command(CLI::App& app, Dispatcher& dispatcher);
void add_render_command(CLI::App& app, Dispatcher& dispatcher);
void add_schema_command(CLI::App& app, Dispatcher& dispatcher);

}  // namespace sdlc::cli
