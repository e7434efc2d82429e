#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The ANSI codes of the parts of a message; empty without colour.
struct Palette {
  std::string_view error, warning, gutter, label, help, bold, reset;
};

Palette make_palette(bool has_color) noexcept;

/// A span to underline, with its message. The primary mark is the place of the diagnostic.
struct Mark {
  Location where;
  std::string message;
  bool is_primary = false;
};

/// The source lines of the marks, which are in one file, with underlines, and with line numbers in
/// a gutter of `gutter_width` columns. Terminal control characters of the source are replaced. Long
/// lines are shortened around their primary mark.
std::string render_excerpt(std::span<const Mark> marks, int gutter_width,
                           std::string_view primary_color, const Palette& palette);

}  // namespace sdlc::lang
