#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sdlc::cli {

inline constexpr std::size_t kSeriesStyles = 8;

/// The outline of a series' mark around the origin, as the data of an SVG path.
std::string mark_outline(std::size_t style, double radius);

/// The dashes of a series' line, as SVG's stroke-dasharray has them.
std::string_view dashes(std::size_t style);

}  // namespace sdlc::cli
