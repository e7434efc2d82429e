#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sdlc::lang {

/// A source line for a terminal, with tabs expanded and unsafe characters replaced, and the column
/// of each byte.
class ShownLine {
 public:
  /// A long line is shortened to the part around the byte `around`.
  ShownLine(std::string_view line, std::uint32_t around);

  /// The width in columns.
  int width() const noexcept { return width_; }
  /// The column of the byte, counted from 0, or of the nearest byte shown.
  int column(std::uint32_t byte) const noexcept;
  /// The first column with a character that is not a space.
  int first_column() const noexcept;

  std::string text() const;

 private:
  struct Cell {
    std::string text;
    std::uint32_t begin = 0;  ///< byte in the line
    int column = 0;
    int width = 0;
  };

  void append(std::string_view line, std::uint32_t byte);
  void shorten_around(int column, bool is_cut_before, bool is_cut_after);

  std::vector<Cell> cells_;
  int width_ = 0;
};

}  // namespace sdlc::lang
