#include <cstdint>
#include <memory>

#include <fmt/format.h>

#include "cli/command_line.hpp"
#include "cli/dispatcher.hpp"
#include "cli/kernel_options.hpp"
#include "cli/outputs.hpp"
#include "cli/override_options.hpp"
#include "cli/scene_options.hpp"
#include "cli/serve.hpp"
#include "cli/usage_error.hpp"
#include "cli/whole_number.hpp"
#include "lang/text/display_width.hpp"

namespace sdlc::cli {

void add_serve_command(Command& program, Dispatcher& dispatcher) {
  auto options = std::make_shared<ServeOptions>();
  Command command = program.add_command("serve", "Show a scene in the browser while it is written");
  add_scene_options(command, options->scene);
  add_override_options(command, options->overrides);
  add_kernel_options(command, options->kernel);
  add_whole_number(
      command, "--port", {.lowest = 1, .highest = 65535},
      [options](std::uint64_t port) { options->port = static_cast<int>(port); },
      "Listen on this port; default: any that is free");
  command.add_flag("--editor", options->has_editor,
                   "An editor sends unsaved texts on standard input, as docs/serve.md describes");
  command.add_flag("--quiet", "Only errors on standard error");
  command.footer(
      "Examples:\n"
      "  sdlc serve ball.scene\n"
      "  sdlc serve ring.scene --set count=200 --width 480 --port 8080\n"
      "\n"
      "Prints the address of the page, which only this machine can open: it has a secret in it. "
      "From another\nmachine, forward the port: ssh -L 8080:localhost:8080 HOST. Ctrl-C ends. "
      "docs/serve.md explains the page.");
  dispatcher.on(command, [options](Environment& env) {
    if (is_film_name(options->scene.file)) {
      throw UsageError(
          fmt::format("`{}` is a film, not a scene", lang::printable(options->scene.file)));
    }
    enter_pack(options->scene, env);
    return serve(*options, env);
  });
}

}  // namespace sdlc::cli
