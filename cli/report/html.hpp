#pragma once

#include <string>
#include <string_view>

/// Building blocks of the page. The page is also valid XML: every element is closed, so that a test
/// can check that tags match.
namespace sdlc::cli {

/// Escapes text for element content and attribute values: HTML special characters become entities,
/// control characters become visible symbols, invalid UTF-8 becomes U+FFFD.
std::string escaped(std::string_view text);

/// RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

/// A table that scrolls if the page is too narrow. Cells are HTML.
class HtmlTable {
 public:
  /// `columns` are headings, separated by `|`; those that begin with `#` are for numbers, which are
  /// right-aligned.
  HtmlTable(std::string_view caption, std::string_view columns);

  /// A heading above the following rows.
  void group(std::string_view html);

  /// Starts a row: cells are added from left to right, the first is its heading.
  HtmlTable& row();
  HtmlTable& cell(std::string_view html);
  /// A figure with a small remark below it.
  HtmlTable& cell(std::string_view html, std::string_view small);

  std::string finish() &&;

 private:
  void end_row();
  void end_group();

  std::string out_;
  std::string columns_;  // one character each: '#' for numbers
  std::size_t column_ = 0;
  bool is_in_row_ = false, is_in_group_ = false;
};

}  // namespace sdlc::cli
