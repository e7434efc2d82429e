#include "lang/report/excerpt.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "lang/report/shown_line.hpp"
#include "lang/text/display_width.hpp"

namespace sdlc::lang {
namespace {

/// The part of a mark on one line, in bytes of it.
struct LineMark {
  std::uint32_t begin, end;
  bool begins_at_text = false;  ///< at the first character that is not a space, not at `begin`
  std::string message;
  bool is_primary;
};

/// A LineMark in columns.
struct Underline {
  int begin, end;
  std::string message;
  bool is_primary;
};

std::uint32_t line_size(const SourceFile& file, std::uint32_t line) {
  return static_cast<std::uint32_t>(file.line(line).size());
}

/// Splits the marks by line. A mark over several lines appears on its first and its last line, with
/// its message on the last.
std::map<std::uint32_t, std::vector<LineMark>> split_by_line(std::span<const Mark> marks) {
  std::map<std::uint32_t, std::vector<LineMark>> lines;
  for (const Mark& mark : marks) {
    const SourceFile& file = *mark.where.file;
    const Span span = mark.where.span;
    const std::uint32_t first = file.position(span.begin).line;
    const std::uint32_t last = span.size() == 0 ? first : file.position(span.end - 1).line;
    const std::uint32_t begin = span.begin - file.line_begin(first);
    if (first == last) {
      lines[first].push_back({.begin = begin,
                              .end = span.end - file.line_begin(first),
                              .message = mark.message,
                              .is_primary = mark.is_primary});
      continue;
    }
    lines[first].push_back({.begin = begin,
                            .end = line_size(file, first),
                            .message = {},
                            .is_primary = mark.is_primary});
    lines[last].push_back({.begin = 0,
                           .end = span.end - file.line_begin(last),
                           .begins_at_text = true,
                           .message = mark.message,
                           .is_primary = mark.is_primary});
  }
  return lines;
}

Underline underline(const LineMark& mark, const ShownLine& line) {
  int begin = mark.begins_at_text ? line.first_column() : line.column(mark.begin);
  const int end = line.column(mark.end);
  // A combining character has no column of its own: underline its base.
  const bool is_invisible = mark.end > mark.begin && end == begin;
  if (is_invisible) begin = std::max(0, begin - 1);
  return {.begin = begin,
          .end = std::max(end, begin + 1),
          .message = printable(mark.message),
          .is_primary = mark.is_primary};
}

/// A row of text, written from left to right at given columns.
class Row {
 public:
  Row(std::string_view primary_color, const Palette& palette)
      : primary_color_(primary_color), palette_(palette) {}

  void put(int column, std::string_view text, bool is_primary, int width) {
    if (column < column_) return;  // the column is taken
    text_.append(static_cast<std::size_t>(column - column_), ' ');
    text_ +=
        fmt::format("{}{}{}", is_primary ? primary_color_ : palette_.label, text, palette_.reset);
    column_ = column + width;
  }
  const std::string& text() const noexcept { return text_; }

 private:
  std::string_view primary_color_;
  const Palette& palette_;
  std::string text_;
  int column_ = 0;
};

/// A row of carets and dashes, and a message after them. The primary underline covers others.
std::string marker_row(const std::vector<Underline>& underlines, std::string_view message,
                       bool message_is_primary, std::string_view primary_color,
                       const Palette& palette) {
  int end = 0;
  for (const Underline& mark : underlines) end = std::max(end, mark.end);
  std::string marks(static_cast<std::size_t>(end), ' ');
  for (const bool primary : {false, true}) {
    for (const Underline& mark : underlines) {
      if (mark.is_primary != primary) continue;
      const auto begin = marks.begin() + mark.begin;
      std::fill(begin, marks.begin() + mark.end, primary ? '^' : '-');
    }
  }

  Row row(primary_color, palette);
  for (std::size_t i = 0; i < marks.size();) {
    const std::size_t run = std::min(marks.find_first_not_of(marks[i], i), marks.size()) - i;
    if (marks[i] != ' ') {
      row.put(static_cast<int>(i), std::string_view(marks).substr(i, run), marks[i] == '^',
              static_cast<int>(run));
    }
    i += run;
  }
  if (!message.empty()) row.put(end + 1, message, message_is_primary, 0);
  return row.text();
}

/// The rows below a line: the underlines, with the rightmost message after them, then the other
/// messages from right to left, each at its column.
std::vector<std::string> rows_below(std::vector<Underline> underlines,
                                    std::string_view primary_color, const Palette& palette) {
  std::stable_sort(underlines.begin(), underlines.end(),
                   [](const Underline& a, const Underline& b) { return a.begin < b.begin; });
  std::vector<const Underline*> labelled;
  for (const Underline& mark : underlines) {
    if (!mark.message.empty()) labelled.push_back(&mark);
  }

  const Underline& rightmost = underlines.back();
  if (!rightmost.message.empty()) labelled.pop_back();
  std::vector<std::string> rows{
      marker_row(underlines, rightmost.message, rightmost.is_primary, primary_color, palette)};
  for (; !labelled.empty(); labelled.pop_back()) {
    Row row(primary_color, palette);
    for (const Underline* mark : labelled) {
      const bool is_last = mark == labelled.back();
      row.put(mark->begin, is_last ? std::string_view(mark->message) : "|", mark->is_primary, 1);
    }
    rows.push_back(row.text());
  }
  return rows;
}

}  // namespace

Palette make_palette(bool has_color) noexcept {
  if (!has_color) return {};
  return {.error = "\x1b[1;31m",
          .warning = "\x1b[1;33m",
          .gutter = "\x1b[1;34m",
          .label = "\x1b[1;34m",
          .help = "\x1b[1;36m",
          .bold = "\x1b[1m",
          .reset = "\x1b[0m"};
}

std::string render_excerpt(std::span<const Mark> marks, int gutter_width,
                           std::string_view primary_color, const Palette& palette) {
  const auto gutter = [&](std::string_view number) {
    return fmt::format("{}{:>{}} |{}", palette.gutter, number, gutter_width, palette.reset);
  };
  std::string text = gutter("") + "\n";
  std::uint32_t line_before = 0;
  for (const auto& [number, line_marks] : split_by_line(marks)) {
    const bool is_gap = line_before != 0 && number > line_before + 1;
    if (is_gap) text += fmt::format("{}...{}\n", palette.gutter, palette.reset);
    line_before = number;

    const auto pointed_at = std::find_if(line_marks.begin(), line_marks.end(),
                                         [](const LineMark& mark) { return mark.is_primary; });
    const LineMark& anchor = pointed_at == line_marks.end() ? line_marks.front() : *pointed_at;
    const ShownLine line(marks.front().where.file->line(number), anchor.begin);
    std::vector<Underline> underlines;
    for (const LineMark& mark : line_marks) underlines.push_back(underline(mark, line));

    const std::string shown = line.text();
    text += gutter(fmt::format("{}", number)) + (shown.empty() ? "" : " ") + shown + "\n";
    for (const std::string& row : rows_below(std::move(underlines), primary_color, palette)) {
      text += gutter("") + " " + row + "\n";
    }
  }
  return text;
}

}  // namespace sdlc::lang
