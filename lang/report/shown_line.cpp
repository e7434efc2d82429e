#include "lang/report/shown_line.hpp"

#include <algorithm>

#include "lang/text/display_width.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

constexpr int kTabStop = 4;
constexpr int kMaxLine = 120;
constexpr int kShortenedLine = 100;
constexpr int kContext = 40;  // columns kept before the mark
// Bytes read on each side of the mark: a file may be a single line of 100 MB.
constexpr std::uint32_t kReach = 4096;

}  // namespace

ShownLine::ShownLine(std::string_view line, std::uint32_t around) {
  const auto is_inside_character = [&](std::uint32_t byte) {
    return byte < line.size() && is_continuation(line[byte]);
  };
  std::uint32_t begin = around > kReach ? around - kReach : 0;
  while (begin > 0 && begin < around && is_inside_character(begin)) ++begin;
  const auto size = static_cast<std::uint32_t>(line.size());
  const std::uint32_t end = size - std::min(around, size) > kReach ? around + kReach : size;
  for (std::uint32_t byte = begin; byte < end; byte += decode_utf8(line.substr(byte)).size) {
    append(line, byte);
  }
  const bool is_long = width_ > kMaxLine || begin > 0 || end < size;
  if (is_long) shorten_around(column(around), begin > 0, end < size);
}

void ShownLine::append(std::string_view line, std::uint32_t byte) {
  const DecodedChar c = decode_utf8(line.substr(byte));
  Cell cell{.text = {}, .begin = byte, .column = width_, .width = 1};
  const bool is_tab = c.is_valid && c.code_point == '\t';
  if (is_tab) {
    cell.width = kTabStop - width_ % kTabStop;
    cell.text.assign(static_cast<std::size_t>(cell.width), ' ');
  } else {
    append_printable(c, cell.text);
    const bool is_itself = c.is_valid && !is_unsafe_on_terminal(c.code_point);
    if (is_itself) cell.width = display_width(c.code_point);
  }
  width_ += cell.width;
  cells_.push_back(std::move(cell));
}

int ShownLine::column(std::uint32_t byte) const noexcept {
  const auto after = std::find_if(cells_.begin(), cells_.end(),
                                  [&](const Cell& cell) { return cell.begin >= byte; });
  return after == cells_.end() ? width_ : after->column;
}

int ShownLine::first_column() const noexcept {
  const auto first = std::find_if(cells_.begin(), cells_.end(), [](const Cell& cell) {
    return cell.text.find_first_not_of(' ') != std::string::npos;
  });
  return first == cells_.end() ? 0 : first->column;
}

void ShownLine::shorten_around(int column, bool is_cut_before, bool is_cut_after) {
  const int begin = std::clamp(column - kContext, 0, std::max(0, width_ - kShortenedLine));
  const int end = begin + kShortenedLine;
  is_cut_before |= begin > 0;
  is_cut_after |= width_ > end;

  std::vector<Cell> kept;
  int width = 0;
  const auto keep = [&](Cell cell) {
    cell.column = width;
    width += cell.width;
    kept.push_back(std::move(cell));
  };
  const Cell ellipsis{.text = "…", .begin = 0, .column = 0, .width = 1};
  if (is_cut_before) keep(ellipsis);
  for (Cell& cell : cells_) {
    const bool is_inside = cell.column >= begin && cell.column + cell.width <= end;
    if (is_inside) keep(std::move(cell));
  }
  if (is_cut_after) {
    keep(ellipsis);
    kept.back().begin = kept.size() > 1 ? kept[kept.size() - 2].begin + 1 : 0;
  }
  cells_ = std::move(kept);
  width_ = width;
}

std::string ShownLine::text() const {
  std::string text;
  for (const Cell& cell : cells_) text += cell.text;
  return text;
}

}  // namespace sdlc::lang
