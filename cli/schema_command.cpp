#include <memory>

#include "cli/command_line.hpp"
#include "cli/config_schema.hpp"
#include "cli/dispatcher.hpp"
#include "cli/language_tables.hpp"

namespace sdlc::cli {

void add_schema_command(Command& program, Dispatcher& dispatcher) {
  auto is_language = std::make_shared<bool>(false);
  Command command =
      program.add_command("schema", "Print the JSON Schema of configs, or the language's tables");
  command.add_flag("--language", *is_language,
                   "Print the kinds, properties, materials, functions, types, limits, colours and "
                   "diagnostics of the language instead, as JSON");
  // Accepted because all commands have it; without effect here.
  command.add_flag("--quiet", "Has no effect here");
  command.footer(
      "Examples:\n"
      "  sdlc schema > sdlc-config.schema.json\n"
      "  sdlc schema --language | jq '.functions[].signature'\n"
      "\n"
      "The schema is of draft 2020-12. docs/json-config.md explains how to use it in an editor.");
  dispatcher.on(command, [is_language](Environment& env) {
    env.out << (*is_language ? language_tables() : config_schema()).dump(2) << '\n';
    return ExitCode::Success;
  });
}

}  // namespace sdlc::cli
