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

}  // namespace

std::uint32_t count_columns(std::string_view part, PositionEncoding encoding) noexcept {
  std::uint32_t columns = 0;
  for (const char c : part) columns += units_of(c, encoding);
  return columns;
}

Position position_of(const SourceFile& file, std::uint32_t offset, PositionEncoding encoding) {
  const std::string_view text = file.text();
  offset = std::min(offset, static_cast<std::uint32_t>(text.size()));
  const std::uint32_t line = file.position(offset).line;
  const std::uint32_t begin = file.line_begin(line);
  if (encoding != PositionEncoding::Utf8) {
    while (offset > begin && offset < text.size() && is_continuation(text[offset])) --offset;
  }
  const std::uint32_t columns = count_columns(text.substr(begin, offset - begin), encoding);
  return {.line = line, .column = 1 + columns};
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

}  // namespace sdlc::lang
