#pragma once

#include <span>
#include <string_view>

#include "lang/text/bracket_repair.hpp"

namespace sdlc::lang {

/// Adds to the faults of the brackets those between them: commas and colons that are missing, and
/// points of two.
void find_missing_marks(std::string_view text, std::span<const LayoutToken> tokens,
                        BracketRepair& repair);

}  // namespace sdlc::lang
