#pragma once

#include <optional>
#include <vector>

#include "cli/command_line.hpp"
#include "cli/frames.hpp"

namespace sdlc::cli {

/// Adds --frames.
void add_frames_option(Command& command, std::optional<std::vector<FrameRange>>& frames);

}  // namespace sdlc::cli
