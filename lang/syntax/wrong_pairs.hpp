#pragma once

#include <string_view>
#include <vector>

#include "lang/text/bracket_repair.hpp"

namespace sdlc::lang {

/// Finds pairs of brackets of the wrong kind, and makes them those that were meant: braces around
/// arguments, parentheses around a block.
void mark_wrong_pairs(std::string_view text, std::vector<LayoutToken>& tokens);

}  // namespace sdlc::lang
