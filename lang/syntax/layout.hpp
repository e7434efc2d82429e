#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "lang/text/bracket_repair.hpp"

namespace sdlc::lang {

/// The tokens of a scene, comments left out, with what their neighbours tell of each.
std::vector<LayoutToken> scan_layout(std::string_view text);

/// Adds to the faults of the brackets those between them: commas and colons that are missing, and
/// points of two.
void find_missing_marks(std::span<const LayoutToken> tokens, BracketRepair& repair);

}  // namespace sdlc::lang
