#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "cli/command_line.hpp"
#include "cli/dispatcher.hpp"

namespace sdlc::cli {

// Of completions.bash, completions.fish and completions.zsh.
extern const std::string_view kCompletionsBash, kCompletionsFish, kCompletionsZsh;

namespace {

constexpr std::array<std::string_view, 3> kShells{"bash", "zsh", "fish"};

}  // namespace

void add_completions_command(Command& program, Dispatcher& dispatcher) {
  auto shell = std::make_shared<std::string>();
  Command command = program.add_command("completions", "Print what completes commands in a shell");
  command.add_text("SHELL", *shell, "Which shell").required().one_of(kShells);
  command.add_flag("--quiet", "Has no effect here");
  command.footer(
      "Examples:\n"
      "  source <(sdlc completions bash)                        for a line of ~/.bashrc\n"
      "  source <(sdlc completions zsh)                         for a line of ~/.zshrc\n"
      "  sdlc completions fish >~/.config/fish/completions/sdlc.fish\n"
      "\n"
      "Completes commands, flags, their values, and what a scene on the command line declares: "
      "cameras and params.");
  dispatcher.on(command, [shell](Environment& env) {
    env.out << (*shell == "bash"  ? kCompletionsBash
                : *shell == "zsh" ? kCompletionsZsh
                                  : kCompletionsFish);
    return ExitCode::Success;
  });
}

}  // namespace sdlc::cli
