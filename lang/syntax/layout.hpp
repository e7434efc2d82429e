#pragma once

#include <string_view>
#include <vector>

#include "lang/syntax/foreign_phrases.hpp"
#include "lang/text/bracket_repair.hpp"

namespace sdlc::lang {

struct TokenLayout {
  std::vector<LayoutToken> tokens;
  ForeignPhrases foreign;
};

/// The tokens of a scene, comments left out, with what their neighbours tell of each.
TokenLayout scan_layout(std::string_view text);

}  // namespace sdlc::lang
