#pragma once

#include <string_view>
#include <vector>

#include "lang/text/bracket_repair.hpp"

namespace sdlc::lang {

/// The tokens of a scene by their role in its layout, without trivia and without comments in the
/// style of other languages. A path, a label with its colon and a sign of another language are one
/// each.
std::vector<LayoutToken> layout_tokens(std::string_view text);

}  // namespace sdlc::lang
