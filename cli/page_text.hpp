#pragma once

#include <string>
#include <string_view>

namespace sdlc::cli {

/// A page of docs/explain as it is read on a terminal: paragraphs of at most 80 columns, code
/// indented, each block under the name and the flags that stand behind its opening fence. With
/// colour, headings are bold.
std::string page_text(std::string_view page, bool has_color);

/// The text in bold, if there is colour.
std::string heading(std::string_view text, bool has_color);

}  // namespace sdlc::cli
