#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "lang/data/readers.hpp"
#include "lang/data/table_builder.hpp"

namespace sdlc::lang {
namespace {

bool is_blank(std::string_view line) {
  return line.find_first_not_of(" \t") == std::string_view::npos;
}

std::string name_of(char separator) {
  return separator == '\t' ? "a tab" : fmt::format("`{}`", separator);
}

class DelimitedReader {
 public:
  DelimitedReader(const SourceFile& file, char separator, DiagnosticSink& sink)
      : file_(file),
        text_(file.text()),
        separator_(separator),
        sink_(sink),
        table_(file, sink),
        at_(begin_of_text(text_)) {}

  std::shared_ptr<const Table> read() {
    if (!find_header() || !check_separator() || !read_header()) return nullptr;
    const auto lines = static_cast<std::size_t>(std::ranges::count(text_.substr(at_), '\n')) + 1;
    // A row of n cells has at least 2n - 1 bytes and a line end.
    const std::size_t max_rows = (text_.size() - at_) / (2 * table_.column_count()) + 1;
    table_.reserve(std::min(lines, max_rows));
    constexpr std::uint32_t kRowsPerPoll = 1000;
    for (std::uint32_t row = 0; at_ < text_.size() && !table_.has_too_many_errors(); ++row) {
      if (row % kRowsPerPoll == 0) sink_.stop_if_requested();
      read_row();
    }
    return table_.finish();
  }

 private:
  /// Moves to the header: the first line that is neither empty nor a comment, nor `sep=,`, by which
  /// programs for tables name the separator.
  bool find_header() {
    while (at_ < text_.size()) {
      std::uint32_t next = at_;
      const std::string_view line = take_line(text_, next);
      const bool names_separator = line.size() == 5 && line.starts_with("sep=") &&
                                   std::string_view(",;|\t").find(line.back()) != line.npos;
      if (names_separator && line.back() != separator_) {
        report_separator(at_ + 4, line.back());
        return false;
      }
      if (!is_blank(line) && !line.starts_with('#') && !names_separator) return true;
      at_ = next;
    }
    sink_.report(diag::no_header, {&file_, {0, 0}}, "it is empty")
        .help("the first line has the names of the columns");
    return false;
  }

  /// Reports a header without the format's separator, but with as many others as the first row.
  bool check_separator() {
    std::uint32_t next = at_;
    const std::string_view header = take_line(text_, next), row = take_line(text_, next);
    if (header.find(separator_) != std::string_view::npos || header.starts_with('"')) return true;
    for (const char other : {';', '\t', ',', '|'}) {
      const auto count = std::ranges::count(header, other);
      if (count == 0 || count != std::ranges::count(row, other)) continue;
      report_separator(at_ + static_cast<std::uint32_t>(header.find(other)), other);
      return false;
    }
    return true;
  }

  void report_separator(std::uint32_t at, char other) {
    auto report = sink_.report(diag::wrong_separator, {&file_, {at, at + 1}}, name_of(other),
                               name_of(separator_));
    report.help(fmt::format("save the file with {} between cells{}", name_of(separator_),
                            other == ';' ? ", and numbers with a decimal point" : ""));
    if (other == '\t') report.help("a file with tabs has the extension `.tsv`");
    if (other == ',') report.help("a file with commas has the extension `.csv`");
  }

  bool read_header() {
    const std::uint32_t begin = at_;
    bool are_numbers = true;
    std::size_t cells = 0;
    do {
      const Cell name = take_cell();
      are_numbers = are_numbers && !name.is_quoted && read_number(name.text).has_value();
      if (++cells <= TableBuilder::kMaxColumns) table_.add_column(name);
    } while (take_separator());
    const Span where{begin, end_of_row_};
    if (are_numbers) {
      sink_.report(diag::no_header, {&file_, where}, "all cells of its first line are numbers")
          .help(fmt::format("write the names of the columns before this line, such as `x{}y`",
                            separator_ == '\t' ? std::string_view("\t") : ","));
    }
    if (cells > TableBuilder::kMaxColumns) {
      table_.report_columns(where, cells);
    }
    return !are_numbers && cells <= TableBuilder::kMaxColumns && !is_broken_;
  }

  void read_row() {
    std::uint32_t next = at_;
    const std::uint32_t begin = at_;
    if (text_[at_] == '\n' || text_[at_] == ' ' || text_[at_] == '\r' || text_[at_] == '\t') {
      const std::string_view line = take_line(text_, next);
      const bool has_cells = table_.column_count() > 1 && line.find(separator_) < line.size();
      if (is_blank(line) && !has_cells) return skip_blank(next);
    }
    report_blank_line();
    is_broken_ = false;
    do {
      const Cell cell = take_cell();
      std::exchange(is_cell_broken_, false) ? table_.skip_cell() : table_.add(cell);
    } while (take_separator());
    table_.end_row({begin, end_of_row_}, is_broken_);
  }

  /// Blank lines are skipped at the end of the file only. A row of a TSV may consist of tabs.
  void skip_blank(std::uint32_t next) {
    if (!first_blank_) first_blank_ = at_;
    at_ = next;
  }

  void report_blank_line() {
    if (!first_blank_) return;
    table_.report_cell_count({*first_blank_, *first_blank_}, 0).help("remove the empty line");
    first_blank_.reset();
  }

  void skip_spaces() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t') &&
           text_[at_] != separator_) {
      ++at_;
    }
  }

  Cell take_cell() {
    skip_spaces();
    if (at_ < text_.size() && text_[at_] == '"') return take_quoted_cell();
    const std::uint32_t begin = at_;
    while (at_ < text_.size() && text_[at_] != separator_ && text_[at_] != '\n') ++at_;
    std::uint32_t end = at_;
    while (end > begin &&
           (text_[end - 1] == ' ' || text_[end - 1] == '\t' || text_[end - 1] == '\r'))
      --end;
    return {.text = text_.substr(begin, end - begin), .where = {begin, end}};
  }

  Cell take_quoted_cell() {
    const std::uint32_t begin = at_;
    std::size_t close = text_.find('"', begin + 1);
    quoted_.clear();
    std::size_t from = begin + 1;
    for (; close != std::string_view::npos && text_.substr(close + 1, 1) == "\"";
         close = text_.find('"', from)) {
      quoted_ += text_.substr(from, close + 1 - from);
      from = close + 2;
    }
    if (close == std::string_view::npos) return unclosed(begin);
    const std::string_view rest = text_.substr(from, close - from);
    const bool is_plain = quoted_.empty();
    if (!is_plain) quoted_ += rest;
    at_ = static_cast<std::uint32_t>(close) + 1;
    const Cell cell{.text = is_plain ? rest : std::string_view(quoted_),
                    .where = {begin, at_},
                    .is_quoted = true};
    skip_spaces();
    const bool is_end = at_ == text_.size() || text_[at_] == separator_ || text_[at_] == '\n' ||
                        text_.substr(at_, 2) == "\r\n";
    if (is_end) return cell;
    // The quote that follows a line end opens another cell.
    if (cell.text.find('\n') != std::string_view::npos) return unclosed(begin);
    report_text_after_quote();
    return cell;
  }

  /// The cell ends with its line, where reading goes on.
  Cell unclosed(std::uint32_t begin) {
    sink_.report(diag::unclosed, {&file_, {begin, begin + 1}}, "\"")
        .help("a quote inside a quoted cell is written twice: `\"\"`");
    is_broken_ = is_cell_broken_ = true;
    std::uint32_t next = begin;
    const std::string_view line = take_line(text_, next);
    at_ = begin + static_cast<std::uint32_t>(line.size());
    return {.text = line, .where = {begin, at_}, .is_quoted = true};
  }

  void report_text_after_quote() {
    const std::uint32_t begin = at_;
    while (at_ < text_.size() && text_[at_] != separator_ && text_[at_] != '\n') ++at_;
    sink_.report(diag::text_after_end, {&file_, {begin, at_}}, "a quoted cell")
        .help("a quote inside a quoted cell is written twice: `\"\"`");
    is_broken_ = is_cell_broken_ = true;
  }

  /// Moves past a separator or a line end: whether it is a separator.
  bool take_separator() {
    end_of_row_ = at_;
    if (at_ == text_.size()) return false;
    if (text_[at_] == separator_) {
      ++at_;
      return true;
    }
    if (text_[at_] == '\r') ++at_;
    if (at_ < text_.size()) ++at_;
    return false;
  }

  const SourceFile& file_;
  std::string_view text_;
  const char separator_;
  DiagnosticSink& sink_;
  TableBuilder table_;
  std::uint32_t at_, end_of_row_ = 0;
  std::optional<std::uint32_t> first_blank_;
  bool is_broken_ = false;       // the current row has an error that may hide cells
  bool is_cell_broken_ = false;  // the last cell has it
  std::string quoted_;           // the text of a quoted cell with quotes in it
};

}  // namespace

std::shared_ptr<const Table> read_delimited(const SourceFile& file, char separator,
                                            DiagnosticSink& sink) {
  return DelimitedReader(file, separator, sink).read();
}

}  // namespace sdlc::lang
