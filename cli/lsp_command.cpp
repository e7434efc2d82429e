#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "cli/command_line.hpp"
#include "cli/dispatcher.hpp"
#include "cli/scene_options.hpp"
#include "cli/version.hpp"
#include "lsp/log.hpp"
#include "lsp/server.hpp"
#include "lsp/settings.hpp"

namespace sdlc::cli {
namespace {

struct LspOptions {
  lsp::ServerOptions server;
  std::string log;
};

ExitCode run_lsp(const LspOptions& options, Environment& env) {
  lsp::Log log = options.log.empty() ? lsp::Log() : lsp::Log(options.log);
  lsp::Server server(std::cin, env.out, log, options.server);
  return server.run() ? ExitCode::Success : ExitCode::Findings;
}

}  // namespace

void add_lsp_command(Command& program, Dispatcher& dispatcher) {
  auto options = std::make_shared<LspOptions>();
  options->server.version = kVersion;
  Command command = program.add_command("lsp", "Language server for editors, on standard streams");
  command.add_flag("--stdio", "Has no effect: the server always uses the standard streams");
  command.add_text("--log", options->log, "Append to this file what the server does")
      .type_name("FILE");
  command.add_flag("--sandbox", options->server.is_sandboxed,
                   "Scenes read no files outside their folder");
  add_limit_option(command, options->server.limits);
  command.add_flag("--quiet", "Has no effect here");
  command.footer(
      "Examples:\n"
      "  sdlc lsp                       as an editor starts it; docs/editors.md has the settings\n"
      "  sdlc lsp --log /tmp/sdlc.log   also writes a log; the setting trace.server adds messages\n"
      "\n"
      "Exit status: 0 after `shutdown` and `exit`, 1 if the client ends otherwise.");
  dispatcher.on(command, [options](Environment& env) { return run_lsp(*options, env); });
}

}  // namespace sdlc::cli
