#pragma once

#include <string>
#include <string_view>

namespace sdlc::cli {

/// A page of docs/explain for a terminal: paragraphs of at most 80 columns, indented code, with the
/// name and flags of its opening fence above each block. With colour, headings are bold.
std::string page_text(std::string_view page, bool has_color);

/// The text in bold, if colour is enabled.
std::string heading(std::string_view text, bool has_color);

}  // namespace sdlc::cli
