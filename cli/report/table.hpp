#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/report/figures.hpp"

namespace sdlc::cli {

/// A cell as HTML, with a small remark.
struct Cell {
  Cell(std::convertible_to<std::string> auto&& html_, std::string small_ = {})
      : html(std::forward<decltype(html_)>(html_)), small(std::move(small_)) {}
  Cell(const Reading& reading) : html(reading.value), small(reading.interval) {}

  std::string html, small;
};

/// A table of a report, for the page and for the terminal.
class Table {
 public:
  /// `headings` are separated by `|`. A `-` in front keeps the column on the page, then a `#` is
  /// for numbers, which are right-aligned there.
  Table(std::string caption, std::string_view headings);

  /// A heading above the following rows; HTML.
  void group(std::string html) { rows_.push_back({.group = std::move(html), .cells = {}}); }
  /// One cell per column; the first is the heading of the row.
  void row(std::vector<Cell> cells) { rows_.push_back({.group = {}, .cells = std::move(cells)}); }

  std::string html() const;
  std::string text() const;

 private:
  struct Column {
    std::string heading;
    bool is_page_only, is_number;
  };
  struct Row {
    std::string group;
    std::vector<Cell> cells;
  };

  std::string caption_;
  std::vector<Column> columns_;
  std::vector<Row> rows_;
};

}  // namespace sdlc::cli
