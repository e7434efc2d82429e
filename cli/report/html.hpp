#pragma once

#include <string>
#include <string_view>

/// The few pieces that the page is made of. It is XML too: every element is closed, so that a
/// test can hold tags against each other.
namespace sdlc::cli {

/// Text from outside, for element content and attribute values: what means something in HTML is
/// written as an entity, control characters become pictures of themselves, what is not UTF-8
/// U+FFFD.
std::string escaped(std::string_view text);

/// RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

/// A table that scrolls by itself where the page is too narrow. Cells are HTML.
class HtmlTable {
 public:
  /// `columns` are headings, divided by `|`; those that begin with `#` are over numbers, which are
  /// flush right.
  HtmlTable(std::string_view caption, std::string_view columns);

  /// A heading over the rows that follow.
  void group(std::string_view html);

  /// One row: cells are added from left to right, the first is its heading.
  HtmlTable& row();
  HtmlTable& cell(std::string_view html);
  /// A figure and, small below it, what is said of it.
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
