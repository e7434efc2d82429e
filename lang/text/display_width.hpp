#pragma once

#include <string>
#include <string_view>

#include "lang/text/utf8.hpp"

/// Text on a terminal.
namespace sdlc::lang {

/// Terminal columns of the code point: 0 for combining marks and joiners, 2 for ideographs and
/// emoji, else 1. Tabs and controls count as 1; the caller chooses how to show them.
int display_width(char32_t code_point) noexcept;

/// Whether printing the code point could move the cursor, change colours or reorder the line:
/// controls, line and paragraph separators, and marks of writing direction.
bool is_unsafe_on_terminal(char32_t code_point) noexcept;

/// Appends the character in a printable form: unsafe ones as a picture of one column, such as
/// U+241B for escape, and invalid bytes as U+FFFD.
void append_printable(DecodedChar c, std::string& out);
/// The text in a printable form; line ends are unsafe too.
std::string printable(std::string_view text);

/// "`×` (U+00D7)"; "U+00A0" for an invisible character.
std::string describe_character(char32_t code_point);

/// The text, or its beginning and `…` if it is too long for a message.
std::string abbreviated(std::string_view text);

}  // namespace sdlc::lang
