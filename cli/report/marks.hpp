#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sdlc::cli {

inline constexpr std::size_t kSeriesStyles = 8;

/// The outline of a series' mark around the origin, as SVG path data.
std::string mark_outline(std::size_t style, double radius);

/// The dashes of a series' line, as an SVG stroke-dasharray.
std::string_view dashes(std::size_t style);

}  // namespace sdlc::cli
