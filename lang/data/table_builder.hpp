#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/table.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

struct Cell {
  std::string_view text;  ///< without quotes
  Span where;
  bool is_quoted = false;
};

/// The number that a cell without quotes spells: `12`, `-1.5`, `+.5`, `6.02e23`. nullopt if it is
/// none; infinite if it is beyond the largest number.
std::optional<double> read_number(std::string_view text);

/// Collects the cells of a data file, row by row, and checks them.
class TableBuilder {
 public:
  static constexpr std::size_t kMaxColumns = 10'000;

  TableBuilder(const SourceFile& file, DiagnosticSink& sink)
      : file_(file), sink_(sink), earlier_errors_(sink.error_count()) {}

  enum class Type : std::uint8_t {
    Unknown,  ///< that of the cell in the first row
    Numbers,
    Strings
  };
  void add_column(const Cell& name, Type type = Type::Unknown);
  std::size_t column_count() const noexcept { return columns_.size(); }
  /// Allocates memory for so many rows.
  void reserve(std::size_t rows);

  /// Adds the next cell of the current row.
  void add(const Cell& cell);
  /// Counts a cell that is wrong, which has been reported.
  void skip_cell() { ++cell_; }
  /// Ends the row. A wrong number of cells is reported unless another mistake explains it.
  void end_row(Span row, bool is_broken = false);

  DiagnosticBuilder report_cell_count(Span where, std::size_t cells);
  /// Reports a header with more than kMaxColumns cells.
  void report_columns(Span where, std::size_t cells);
  /// Whether reading goes on: further mistakes would not be shown.
  bool has_too_many_errors() const { return error_count() > kMaxErrors; }
  /// Null if an error has been reported since the construction.
  std::shared_ptr<const Table> finish();

 private:
  static constexpr std::size_t kMaxErrors = 500;

  struct ColumnType {
    Type type;
    Span decided_by;  ///< the cell of the first row
    /// Of strings: numbers in the rows after the first, while there is nothing else.
    std::size_t numbers = 0;
    bool has_other_strings = false;
  };

  std::size_t error_count() const { return sink_.error_count() - earlier_errors_; }
  void decide_type(std::size_t column, const Cell& cell);
  void add_number(std::size_t column, const Cell& cell);
  void add_string(std::size_t column, const Cell& cell);
  /// Warns about columns of strings in which all cells but the first are numbers.
  void check_first_cells();
  void report_wrong_cell(std::size_t column, const Cell& cell);
  std::string name_of(std::size_t column) const;
  Location location(Span where) const noexcept { return {&file_, where}; }

  const SourceFile& file_;
  DiagnosticSink& sink_;
  const std::size_t earlier_errors_;
  std::vector<Column> columns_;
  std::vector<ColumnType> types_;
  std::unordered_map<std::string, Span> names_;
  std::size_t rows_ = 0, cell_ = 0, expected_rows_ = 0;
  Span first_extra_;  // the first cell of the row that has no column
};

}  // namespace sdlc::lang
