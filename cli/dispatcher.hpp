#pragma once

#include <functional>
#include <utility>

#include "cli/command_line.hpp"
#include "cli/environment.hpp"
#include "cli/exit_code.hpp"

namespace sdlc::cli {

/// Selects the command that the arguments name.
class Dispatcher {
 public:
  using Run = std::function<ExitCode(Environment&)>;

  void on(Command command, Run run) {
    // That of a command's own command, such as `farm status`, is called first.
    command.on_chosen([this, run = std::move(run)] {
      if (!chosen_) chosen_ = run;
    });
  }
  const Run& chosen() const noexcept { return chosen_; }

 private:
  Run chosen_;
};

// One function per subcommand, in NAME_command.cpp.
void add_compare_command(Command& program, Dispatcher& dispatcher);
void add_complete_command(Command& program, Dispatcher& dispatcher);
void add_completions_command(Command& program, Dispatcher& dispatcher);
void add_convert_command(Command& program, Dispatcher& dispatcher);
void add_explain_command(Command& program, Dispatcher& dispatcher);
void add_farm_command(Command& program, Dispatcher& dispatcher);
void add_fmt_command(Command& program, Dispatcher& dispatcher);
void add_inspect_command(Command& program, Dispatcher& dispatcher);
void add_lint_command(Command& program, Dispatcher& dispatcher);
void add_lsp_command(Command& program, Dispatcher& dispatcher);
void add_man_command(Command& program, Dispatcher& dispatcher);
void add_measure_command(Command& program, Dispatcher& dispatcher);
void add_merge_command(Command& program, Dispatcher& dispatcher);
void add_new_command(Command& program, Dispatcher& dispatcher);
void add_pack_command(Command& program, Dispatcher& dispatcher);
void add_render_command(Command& program, Dispatcher& dispatcher);
void add_schema_command(Command& program, Dispatcher& dispatcher);
void add_serve_command(Command& program, Dispatcher& dispatcher);

}  // namespace sdlc::cli
