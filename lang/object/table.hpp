#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "lang/object/value.hpp"

namespace sdlc::lang {

/// The strings of a column, one after another in one text: 4 bytes per string and its text.
class StringColumn {
 public:
  void add(std::string_view text) {
    text_ += text;
    ends_.push_back(static_cast<std::uint32_t>(text_.size()));
  }
  bool is_empty() const noexcept { return ends_.empty(); }
  std::string_view operator[](std::size_t i) const noexcept {
    const std::size_t begin = i == 0 ? 0 : ends_[i - 1];
    return std::string_view(text_).substr(begin, ends_[i] - begin);
  }
  void shrink_to_fit() {
    text_.shrink_to_fit();
    ends_.shrink_to_fit();
  }
  std::size_t bytes() const noexcept {
    return text_.capacity() + ends_.capacity() * sizeof(std::uint32_t);
  }
  std::size_t text_bytes() const noexcept { return text_.size(); }

 private:
  std::string text_;  // of a file of at most 4 GiB
  std::vector<std::uint32_t> ends_;
};

/// A column of a data file. Its cells are of one type.
struct Column {
  std::string name;  ///< empty: the column has none
  std::variant<std::vector<double>, StringColumn> cells;

  bool has_numbers() const noexcept { return cells.index() == 0; }
};

/// The rows of a data file, by columns: 8 bytes per number. Immutable. It contains no values, whose
/// memory the thread that made them counts: a table may outlive evaluations of several threads.
class Table {
 public:
  /// All columns have `rows` cells; names are unique. `file`: its name, for messages.
  Table(std::string file, std::vector<Column> columns, std::size_t rows);
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  const std::string& file() const noexcept { return file_; }
  const std::vector<Column>& columns() const noexcept { return columns_; }
  std::size_t row_count() const noexcept { return rows_; }
  /// Whether all columns have the same type.
  bool is_uniform() const noexcept { return is_uniform_; }
  /// The index of the column with this name.
  std::optional<std::size_t> find(std::string_view name) const;
  /// The names of the columns that have one.
  std::vector<std::string_view> names() const;
  Value cell(std::size_t row, std::size_t column) const;

  // Steps, as ListValue::weight()
  std::uint64_t weight() const noexcept { return weight_; }
  std::uint64_t weight_of_row(std::size_t row) const noexcept;

  /// Memory of the table.
  std::size_t bytes() const noexcept;

 private:
  std::string file_;
  std::vector<Column> columns_;
  std::size_t rows_;
  bool is_uniform_;
  std::uint64_t weight_;
  std::unordered_map<std::string_view, std::size_t> by_name_;
};

}  // namespace sdlc::lang
