#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "render/math/color.hpp"

namespace sdlc::lang {

/// A name of CSS Color 4, 6.1, with its sRGB-encoded value 0xRRGGBB.
struct NamedColor {
  std::string_view name;
  std::uint32_t encoded;
};

/// All 148, sorted by name.
std::span<const NamedColor> named_colors() noexcept;
std::optional<render::LinearRgb> find_named_color(std::string_view name) noexcept;

/// The linear value of an sRGB-encoded one (IEC 61966-2-1), 0 to 255 each; fractions are allowed.
/// The bits are the same on every machine: power() of elementary.hpp, and a table of it for whole
/// values.
double decode_srgb(double encoded_255) noexcept;

/// `text` is `#rgb` or `#rrggbb`.
render::LinearRgb decode_hex_color(std::string_view text) noexcept;

/// CSS Color 4, 7.1, then decoded: `hue` in degrees, saturation and lightness from 0 to 1.
render::LinearRgb decode_hsl(double hue, double saturation, double lightness) noexcept;

/// The colour of a black body of `kelvin` from 1667 to 25000, its largest component 1 and none
/// below 0: chromaticity by the cubic splines of Kim et al. (US patent 7024034, 2006), then CIE XYZ
/// to linear sRGB.
render::LinearRgb color_of_temperature(double kelvin) noexcept;

}  // namespace sdlc::lang
