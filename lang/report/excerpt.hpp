#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The ANSI codes of each part of a message; all empty without colour.
struct Palette {
  std::string_view error, warning, gutter, label, help, bold, reset;
};

Palette make_palette(bool has_color) noexcept;

/// A run of the text to be underlined, with what is said of it; the primary one is what is wrong.
struct Mark {
  Location where;
  std::string message;
  bool is_primary = false;
};

/// The source lines that the marks touch, underlined, with line numbers in a gutter of
/// `gutter_width` columns. All marks are of one file. Nothing of the source that could steer a
/// terminal gets out; lines longer than a screen are shortened around their first mark.
std::string render_excerpt(std::span<const Mark> marks, int gutter_width,
                           std::string_view primary_color, const Palette& palette);

}  // namespace sdlc::lang
