#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sdlc::lang {

/// A source line as a terminal shows it: tabs widened, unsafe characters replaced, and each byte's
/// column known.
class ShownLine {
 public:
  /// Of a line too long for a screen only what is around the byte `around` is shown.
  ShownLine(std::string_view line, std::uint32_t around);

  /// Columns of what is shown.
  int width() const noexcept { return width_; }
  /// The column (from 0) at which the byte is shown, or the nearest one that is.
  int column(std::uint32_t byte) const noexcept;
  /// The first column that is not blank.
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
  void shorten_around(int column, bool is_cut_before, bool is_cut_behind);

  std::vector<Cell> cells_;
  int width_ = 0;
};

}  // namespace sdlc::lang
