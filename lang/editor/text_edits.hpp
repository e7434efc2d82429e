#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lang/source/source.hpp"

namespace sdlc::lang {

/// A replacement in a text. An editor applies all edits of a list at once: their places are those
/// of the text before.
struct TextEdit {
  Span where;
  std::string text;

  friend bool operator==(const TextEdit&, const TextEdit&) = default;
};

/// Edits that change `from` to exactly `to`, ascending and disjoint: one for each run of spaces
/// where only spaces differ, otherwise one for each changed line or run of lines, reduced to the
/// part that differs. If the changes are spread over thousands of lines, there is one per line. No
/// edit begins or ends inside a code point or between the CR and the LF of a line end, as an editor
/// has no position there. Near-linear time.
std::vector<TextEdit> text_edits(std::string_view from, std::string_view to);

/// The text after the edits, which must be ascending and disjoint.
std::string with_edits(std::string_view text, std::span<const TextEdit> edits);

}  // namespace sdlc::lang
