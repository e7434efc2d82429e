#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The unit in which the columns of a position are counted.
enum class PositionEncoding : std::uint8_t {
  Utf8,   ///< bytes
  Utf16,  ///< UTF-16 code units: the default of the Language Server Protocol
  Utf32,  ///< code points: what SourceFile::position() counts
};

/// The position of a byte offset; line and column count from 1. An offset inside a code point has
/// the column of that code point (Utf16, Utf32). Offsets past the end are at the end.
Position position_of(const SourceFile& file, std::uint32_t offset, PositionEncoding encoding);

/// The byte offset of a position. A line past the last one is at the end of the text, a column past
/// the end of its line before the line end, and the second unit of a UTF-16 pair at the beginning
/// of its code point. Columns of Utf8 are exact, also inside a code point.
std::uint32_t offset_of(const SourceFile& file, Position position, PositionEncoding encoding);

/// The number of columns that a part of a line takes.
std::uint32_t count_columns(std::string_view part, PositionEncoding encoding) noexcept;

/// The byte offset of a column, from 1, in one line, with the same rules.
std::size_t offset_in_line(std::string_view line, std::uint32_t column, PositionEncoding encoding);

/// Positions of many offsets of one text. In contrast to position_of(), it remains fast in very
/// long lines, such as that of a config without line ends: it keeps columns at regular distances.
class PositionMap {
 public:
  /// `file` must outlive the map.
  PositionMap(const SourceFile& file, PositionEncoding encoding)
      : file_(file), encoding_(encoding) {}

  /// The same as position_of().
  Position at(std::uint32_t offset);

 private:
  std::uint32_t units_before(std::uint32_t begin, std::uint32_t offset);

  const SourceFile& file_;
  PositionEncoding encoding_;
  std::uint32_t line_begin_ = 0;      // of the line that `units_` is about
  std::vector<std::uint32_t> units_;  // before every kStep-th byte of it
};

}  // namespace sdlc::lang
