#include "cli/frames_option.hpp"

#include <fmt/format.h>

#include "lang/text/display_width.hpp"

namespace sdlc::cli {

void add_frames_option(Command& command, std::optional<std::vector<FrameRange>>& frames) {
  command
      .add_text(
          "--frames",
          [&frames](const std::string& text) {
            frames = parse_frames(text);
            if (frames) return;
            throw ArgumentError(
                "--frames",
                fmt::format("takes A, A-B or A-BxS, separated by commas, with whole numbers, A at "
                            "most B, not `{}`",
                            lang::printable(text)));
          },
          "The frames to render, every S-th from A to B; default: those of the scene's animation")
      .type_name("A-B[xS][,...]");
}

}  // namespace sdlc::cli
