#include "lang/source/position_encoding.hpp"

#include <algorithm>
#include <string_view>

#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

/// Units that the byte adds to a column. The first byte of a code point counts for the whole code
/// point; four bytes are two units of UTF-16.
std::uint32_t units_of(char c, PositionEncoding encoding) noexcept {
  if (encoding == PositionEncoding::Utf8) return 1;
  if (is_continuation(c)) return 0;
  const bool is_pair = static_cast<unsigned char>(c) >= 0xF0;
  return encoding == PositionEncoding::Utf16 && is_pair ? 2 : 1;
}

/// The offset within the text, and not inside a code point unless columns are bytes.
std::uint32_t whole_offset(std::string_view text, std::uint32_t offset, PositionEncoding encoding) {
  offset = std::min(offset, static_cast<std::uint32_t>(text.size()));
  if (encoding == PositionEncoding::Utf8 || offset == text.size()) return offset;
  while (offset > 0 && is_continuation(text[offset]) && text[offset - 1] != '\n') --offset;
  return offset;
}

std::uint32_t line_of(const SourceFile& file, std::uint32_t offset) {
  std::uint32_t first = 1, after = file.line_count() + 1;
  while (after - first > 1) {
    const std::uint32_t middle = first + (after - first) / 2;
    (file.line_begin(middle) <= offset ? first : after) = middle;
  }
  return first;
}

}  // namespace

std::uint32_t count_columns(std::string_view part, PositionEncoding encoding) noexcept {
  if (encoding == PositionEncoding::Utf8) return static_cast<std::uint32_t>(part.size());
  std::uint32_t columns = 0;
  for (const char c : part) columns += units_of(c, encoding);
  return columns;
}

Position position_of(const SourceFile& file, std::uint32_t offset, PositionEncoding encoding) {
  const std::string_view text = file.text();
  offset = whole_offset(text, offset, encoding);
  const std::uint32_t line = line_of(file, offset);
  const std::uint32_t begin = file.line_begin(line);
  return {.line = line, .column = 1 + count_columns(text.substr(begin, offset - begin), encoding)};
}

std::uint32_t offset_of(const SourceFile& file, Position position, PositionEncoding encoding) {
  if (position.line < 1) return 0;
  if (position.line > file.line_count()) return static_cast<std::uint32_t>(file.text().size());
  const std::size_t at = offset_in_line(file.line(position.line), position.column, encoding);
  return file.line_begin(position.line) + static_cast<std::uint32_t>(at);
}

std::size_t offset_in_line(std::string_view line, std::uint32_t column, PositionEncoding encoding) {
  std::size_t at = 0;
  for (std::uint32_t reached = 1; at < line.size(); ++at) {
    reached += units_of(line[at], encoding);
    if (reached > column) break;
  }
  // Past the continuation bytes of the code point before.
  if (encoding != PositionEncoding::Utf8) {
    while (at < line.size() && is_continuation(line[at])) ++at;
  }
  return at;
}

namespace {

/// Bytes of a line between columns that a PositionMap keeps.
constexpr std::uint32_t kStep = 256;

}  // namespace

Position PositionMap::at(std::uint32_t offset) {
  offset = whole_offset(file_.text(), offset, encoding_);
  const std::uint32_t line = line_of(file_, offset);
  return {.line = line, .column = 1 + units_before(file_.line_begin(line), offset)};
}

/// Units between the beginning of a line and an offset in it.
std::uint32_t PositionMap::units_before(std::uint32_t begin, std::uint32_t offset) {
  const std::string_view text = file_.text();
  const std::uint32_t step = (offset - begin) / kStep;
  if (step == 0) return count_columns(text.substr(begin, offset - begin), encoding_);
  if (begin != line_begin_ || units_.empty()) {
    line_begin_ = begin;
    units_.assign(1, 0);
  }
  while (units_.size() <= step) {
    const auto known = static_cast<std::uint32_t>(units_.size() - 1);
    const std::uint32_t from = begin + known * kStep;
    units_.push_back(units_.back() + count_columns(text.substr(from, kStep), encoding_));
  }
  return units_[step] +
         count_columns(text.substr(begin + step * kStep, offset - begin - step * kStep), encoding_);
}

}  // namespace sdlc::lang
