#pragma once

#include <string>
#include <string_view>

#include "lang/text/utf8.hpp"

/// How text looks on a terminal.
namespace sdlc::lang {

/// Columns that a terminal gives to the code point: 0 for combining marks and joiners, 2 for
/// ideographs and emoji, else 1. Tabs and controls count as 1; what they are shown as is up to the
/// caller.
int display_width(char32_t code_point) noexcept;

/// Whether printing the code point could move the cursor, change colours or reorder the line:
/// controls, line and paragraph separators, and marks of writing direction.
bool is_unsafe_on_terminal(char32_t code_point) noexcept;

/// Appends the character as it may be printed: unsafe ones as a one-column picture, such as U+241B
/// for escape, and bytes that are not UTF-8 as U+FFFD.
void append_printable(DecodedChar c, std::string& out);
/// The whole text so; line ends count as unsafe.
std::string printable(std::string_view text);

/// "`×` (U+00D7)"; of a character that cannot be seen, "U+00A0".
std::string describe_character(char32_t code_point);

/// The text, or its beginning and `…` where it is too long to stand inside a sentence.
std::string abbreviated(std::string_view text);

}  // namespace sdlc::lang
