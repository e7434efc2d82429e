#pragma once

#include <string_view>
#include <vector>

#include "lang/text/bracket_repair.hpp"

namespace sdlc::lang {

/// The tokens of a text, comments left out, each known by itself.
std::vector<LayoutToken> scan_tokens(std::string_view text);

}  // namespace sdlc::lang
