#include "lang/data/table_builder.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "lang/text/ascii.hpp"
#include "lang/value/literals.hpp"

namespace sdlc::lang {
namespace {

constexpr std::string_view kCommentHelp =
    "lines that begin with `#` are comments only before the header";

std::string count_of(std::size_t count, std::string_view what) {
  return count == 1 ? fmt::format("1 {}", what) : fmt::format("{} {}s", count, what);
}

/// The cell in a message.
std::string shown(std::string_view text) {
  constexpr std::size_t kMaxBytes = 40;
  return text.size() <= kMaxBytes ? fmt::format("`{}`", text) : "this cell";
}

bool is_decimal_comma(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return false;
  std::string with_point(text);
  with_point[comma] = '.';
  return read_number(with_point).has_value();
}

}  // namespace

std::optional<double> read_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const std::string_view digits = text.substr(text.starts_with('-') ? 1 : 0);
  // from_chars would also read `inf` and `nan`.
  if (digits.empty() || (!is_ascii_digit(digits[0]) && digits[0] != '.')) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc()) return value;
  const double size = parse_decimal(digits).value_or(std::numeric_limits<double>::infinity());
  return text.starts_with('-') ? -size : size;
}

void TableBuilder::add_column(const Cell& name, Type type) {
  const auto [first, is_new] = names_.try_emplace(std::string(name.text), name.where);
  if (!is_new && !name.text.empty()) {
    sink_.report(diag::duplicate, location(name.where), "column", name.text)
        .label(location(first->second), "first named here");
  }
  Column column{.name = std::string(name.text), .cells = StringColumn()};
  if (type == Type::Numbers) column.cells = std::vector<double>();
  columns_.push_back(std::move(column));
  types_.push_back({.type = type, .decided_by = {}});
}

void TableBuilder::reserve(std::size_t rows) { expected_rows_ = rows; }

void TableBuilder::decide_type(std::size_t column, const Cell& cell) {
  const bool is_number = !cell.is_quoted && read_number(cell.text).has_value();
  types_[column] = {.type = is_number ? Type::Numbers : Type::Strings, .decided_by = cell.where};
  if (!is_number) return;
  std::vector<double> numbers;
  numbers.reserve(expected_rows_);
  columns_[column].cells = std::move(numbers);
}

void TableBuilder::add(const Cell& cell) {
  const std::size_t column = cell_++;
  if (column >= columns_.size()) {
    if (column == columns_.size()) first_extra_ = cell.where;
    return;
  }
  if (types_[column].type == Type::Unknown) decide_type(column, cell);
  if (types_[column].type == Type::Numbers) return add_number(column, cell);
  add_string(column, cell);
}

void TableBuilder::add_string(std::size_t column, const Cell& cell) {
  auto& cells = std::get<StringColumn>(columns_[column].cells);
  ColumnType& type = types_[column];
  if (!cells.is_empty() && !type.has_other_strings) {
    const bool is_number = !cell.is_quoted && read_number(cell.text).has_value();
    if (is_number) ++type.numbers;
    type.has_other_strings = !is_number && cell.text != cells[0];
  }
  cells.add(cell.text);
}

void TableBuilder::check_first_cells() {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const ColumnType& type = types_[i];
    const Span cell = type.decided_by;
    const bool is_suspicious = type.type == Type::Strings && !type.has_other_strings &&
                               type.numbers > 0 &&
                               !file_.text().substr(cell.begin).starts_with('"');
    if (!is_suspicious) continue;
    sink_.report(diag::strings_by_one_cell, location(cell), name_of(i))
        .help("write a number here, or the text in quotes if the column has strings");
  }
}

void TableBuilder::add_number(std::size_t column, const Cell& cell) {
  const std::optional<double> number = cell.is_quoted ? std::nullopt : read_number(cell.text);
  if (!number) return report_wrong_cell(column, cell);
  if (*number > std::numeric_limits<double>::max() ||
      *number < std::numeric_limits<double>::lowest()) {
    sink_.report(diag::number_too_large, location(cell.where),
                 cell.text.size() <= 40 ? cell.text : "this number");
  }
  std::get<std::vector<double>>(columns_[column].cells).push_back(*number);
}

void TableBuilder::report_wrong_cell(std::size_t column, const Cell& cell) {
  const std::string found = cell.text.empty() ? "this cell is empty"
                            : cell.is_quoted  ? "this cell is in quotes"
                                              : fmt::format("{} is not a number", shown(cell.text));
  auto report = sink_.report(diag::wrong_cell, location(cell.where), name_of(column), found);
  if (types_[column].decided_by.size() > 0) {
    report.label(location(types_[column].decided_by),
                 fmt::format("column `{}` has numbers because of this cell", name_of(column)));
  }
  const std::string lower = lower_case(cell.text);
  if (lower.find("nan") != std::string::npos || lower.find("inf") != std::string::npos) {
    report.help("numbers are finite: leave out the row");
  } else if (column == 0 && cell.text.starts_with('#')) {
    report.help(std::string(kCommentHelp));
  } else if (cell.is_quoted && read_number(cell.text)) {
    report.help("a number is written without quotes")
        .unsafe_fix(location(cell.where), std::string(cell.text));
  } else if (is_decimal_comma(cell.text)) {
    report.help("a number has a decimal point: `1.5`");
  } else if (types_[column].decided_by.size() > 0) {
    report.help("a column whose first cell is in quotes has strings");
  }
}

std::string TableBuilder::name_of(std::size_t column) const {
  const std::string& name = columns_[column].name;
  return name.empty() ? fmt::format("[{}]", column) : name;
}

DiagnosticBuilder TableBuilder::report_cell_count(Span where, std::size_t cells) {
  return sink_.report(diag::wrong_cell_count, location(where),
                      cells == 0 ? "no cells" : count_of(cells, "cell"),
                      "the file has " + count_of(columns_.size(), "column"));
}

void TableBuilder::report_columns(Span where, std::size_t cells) {
  sink_.report(diag::wrong_cell_count, location(where), count_of(cells, "cell"),
               fmt::format("the limit is {} columns", kMaxColumns));
}

void TableBuilder::end_row(Span row, bool is_broken) {
  const std::size_t cells = std::exchange(cell_, 0);
  ++rows_;
  if (is_broken || cells == columns_.size()) return;
  if (cells > columns_.size()) {
    report_cell_count(first_extra_, cells);
    return;
  }
  auto report = report_cell_count(row, cells);
  if (file_.text().substr(row.begin).starts_with('#')) {
    report.help(std::string(kCommentHelp));
  } else {
    report.help(fmt::format("the cell of column `{}` is missing", name_of(cells)));
  }
}

std::shared_ptr<const Table> TableBuilder::finish() {
  if (error_count() > 0) return nullptr;
  check_first_cells();
  for (Column& column : columns_) {
    std::visit([](auto& cells) { cells.shrink_to_fit(); }, column.cells);
  }
  return std::make_shared<const Table>(file_.name(), std::move(columns_), rows_);
}

}  // namespace sdlc::lang
