#include "lang/object/table.hpp"

#include <algorithm>
#include <utility>

#include "lang/source/limits.hpp"

namespace sdlc::lang {

Table::Table(std::string file, std::vector<Column> columns, std::size_t rows)
    : file_(std::move(file)),
      columns_(std::move(columns)),
      rows_(rows),
      is_uniform_(std::ranges::all_of(
          columns_,
          [&](const Column& column) { return column.has_numbers() == columns_[0].has_numbers(); })),
      weight_(rows * (1 + columns_.size())) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Column& column = columns_[i];
    if (!column.name.empty()) by_name_.emplace(column.name, i);
    const auto* strings = std::get_if<StringColumn>(&column.cells);
    if (strings != nullptr) weight_ += strings->text_bytes() / work::kBytes;
  }
}

std::optional<std::size_t> Table::find(std::string_view name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string_view> Table::names() const {
  std::vector<std::string_view> names;
  for (const Column& column : columns_) {
    if (!column.name.empty()) names.push_back(column.name);
  }
  return names;
}

Value Table::cell(std::size_t row, std::size_t column) const {
  const auto& cells = columns_[column].cells;
  if (const auto* numbers = std::get_if<std::vector<double>>(&cells)) {
    return Scalar{(*numbers)[row]};
  }
  return std::string(std::get<StringColumn>(cells)[row]);
}

std::uint64_t Table::weight_of_row(std::size_t row) const noexcept {
  std::uint64_t weight = columns_.size();
  for (const Column& column : columns_) {
    const auto* strings = std::get_if<StringColumn>(&column.cells);
    if (strings != nullptr) weight += (*strings)[row].size() / work::kBytes;
  }
  return weight;
}

std::size_t Table::bytes() const noexcept {
  std::size_t bytes = sizeof *this;
  for (const Column& column : columns_) {
    const auto* numbers = std::get_if<std::vector<double>>(&column.cells);
    bytes += sizeof column + (numbers != nullptr ? numbers->capacity() * sizeof(double)
                                                 : std::get<StringColumn>(column.cells).bytes());
  }
  return bytes;
}

}  // namespace sdlc::lang
