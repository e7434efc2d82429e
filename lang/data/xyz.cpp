#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "lang/data/readers.hpp"
#include "lang/data/table_builder.hpp"

namespace sdlc::lang {
namespace {

constexpr std::string_view kSpaces = " \t";

std::string_view trimmed(std::string_view line) {
  const std::size_t first = std::min(line.find_first_not_of(kSpaces), line.size());
  const std::size_t last = line.find_last_not_of(kSpaces);
  return line.substr(first, last == std::string_view::npos ? 0 : last + 1 - first);
}

std::string count_of_atoms(std::uint64_t count) {
  return count == 1 ? "1 atom" : fmt::format("{} atoms", count);
}

class XyzReader {
 public:
  XyzReader(const SourceFile& file, DiagnosticSink& sink)
      : file_(file),
        text_(file.text()),
        sink_(sink),
        table_(file, sink),
        at_(begin_of_text(text_)) {}

  std::shared_ptr<const Table> read() {
    if (!read_count()) return nullptr;
    take_line(text_, at_);  // the comment
    std::size_t end = text_.find_last_not_of(" \t\r\n");
    end = end == std::string_view::npos || end < at_ ? at_ : end + 1;
    std::uint64_t atoms = 0;
    constexpr std::uint64_t kRowsPerPoll = 1000;
    for (; at_ < end && !table_.has_too_many_errors(); ++atoms) {
      if (atoms % kRowsPerPoll == 0) sink_.stop_if_requested();
      if (atoms == count_) return report_rest(end);
      read_atom(atoms == 0);
    }
    if (atoms == 0) add_columns(kNamed);
    if (atoms < count_ && !table_.has_too_many_errors()) report_count(atoms);
    return table_.finish();
  }

 private:
  static constexpr std::size_t kNamed = 4;  // element x y z

  bool read_count() {
    const std::uint32_t begin = at_;
    const std::string_view line = take_line(text_, at_);
    const std::string_view number = trimmed(line);
    const auto first = begin + static_cast<std::uint32_t>(number.data() - line.data());
    where_count_ = number.empty() ? Span{begin, begin}
                                  : Span{first, first + static_cast<std::uint32_t>(number.size())};
    const auto result = std::from_chars(number.data(), number.data() + number.size(), count_);
    if (result.ec == std::errc() && result.ptr == number.data() + number.size()) return true;
    const bool is_empty = text_.find_first_not_of(" \t\r\n", begin) == std::string_view::npos;
    sink_
        .report(diag::no_header, {&file_, where_count_},
                is_empty ? "it is empty" : "its first line is not a number of atoms")
        .help(
            "an XYZ file has the number of atoms, a comment line, and a line `element x y z` per "
            "atom");
    return false;
  }

  void add_columns(std::size_t count) {
    using Type = TableBuilder::Type;
    table_.add_column({.text = "element", .where = {}}, Type::Strings);
    for (const std::string_view axis : {"x", "y", "z"}) {
      table_.add_column({.text = axis, .where = {}}, Type::Numbers);
    }
    for (std::size_t i = kNamed; i < count; ++i) table_.add_column({});
  }

  void read_atom(bool is_first) {
    const std::uint32_t begin = at_;
    const std::string_view line = take_line(text_, at_);
    if (is_first) {
      std::size_t cells = 0;
      for_each_cell(line, begin, [&](const Cell&) { ++cells; });
      add_columns(std::min(cells, TableBuilder::kMaxColumns));
      // No more rows than lines of 8 bytes: the count may be wrong.
      table_.reserve(std::min<std::uint64_t>(count_, (text_.size() - begin) / 8 + 1));
    }
    for_each_cell(line, begin, [&](const Cell& cell) { table_.add(cell); });
    table_.end_row({begin, begin + static_cast<std::uint32_t>(line.size())});
  }

  template <typename Function>
  static void for_each_cell(std::string_view line, std::uint32_t begin, Function function) {
    std::size_t at = line.find_first_not_of(kSpaces);
    while (at != std::string_view::npos) {
      const std::size_t end = std::min(line.find_first_of(kSpaces, at), line.size());
      function(Cell{.text = line.substr(at, end - at),
                    .where = {begin + static_cast<std::uint32_t>(at),
                              begin + static_cast<std::uint32_t>(end)}});
      at = line.find_first_not_of(kSpaces, end);
    }
  }

  DiagnosticBuilder report_count(std::uint64_t atoms) {
    return sink_.report(diag::wrong_atom_count, {&file_, where_count_}, count_of_atoms(count_),
                        atoms > count_ ? "more" : count_of_atoms(atoms));
  }

  std::shared_ptr<const Table> report_rest(std::size_t end) {
    const std::uint32_t begin = at_;
    const std::string_view line = take_line(text_, at_);
    auto report = report_count(count_ + 1);
    report.label({&file_, {begin, begin + static_cast<std::uint32_t>(line.size())}},
                 "the first line after them");
    if (at_ < end && read_number(trimmed(line))) report.help("only one frame can be read");
    return nullptr;
  }

  const SourceFile& file_;
  std::string_view text_;
  DiagnosticSink& sink_;
  TableBuilder table_;
  std::uint32_t at_;
  std::uint64_t count_ = 0;
  Span where_count_;
};

}  // namespace

std::shared_ptr<const Table> read_xyz(const SourceFile& file, DiagnosticSink& sink) {
  return XyzReader(file, sink).read();
}

}  // namespace sdlc::lang
