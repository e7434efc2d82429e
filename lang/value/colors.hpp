#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "render/math/color.hpp"

namespace sdlc::lang {

/// A named color of CSS Color 4, 6.1, and its sRGB-encoded value 0xRRGGBB.
struct NamedColor {
  std::string_view name;
  std::uint32_t encoded;
};

/// All 148, sorted by name.
std::span<const NamedColor> named_colors() noexcept;
/// The decoded colour, or nullopt.
std::optional<render::LinearRgb> find_named_color(std::string_view name) noexcept;

/// The linear value, 0 to 1, of an sRGB-encoded one, 0 to 255 with fractions (IEC 61966-2-1). Made
/// of power() of elementary.hpp, so the bits are the same on every machine.
double decode_srgb(double encoded_255) noexcept;

/// Precondition: `text` is `#rgb` or `#rrggbb`.
render::LinearRgb decode_hex_color(std::string_view text) noexcept;

/// CSS Color 4, 7.1, then decoded. `hue` in degrees, of any size; saturation and lightness from 0
/// to 1.
render::LinearRgb decode_hsl(double hue, double saturation, double lightness) noexcept;

/// The colour of a black body at `kelvin`, 1667 to 25000, scaled to a largest component of 1 and
/// clipped at 0. Chromaticity by the cubic splines of Kim et al. (US patent 7024034, 2006), then
/// CIE XYZ to linear sRGB.
render::LinearRgb color_of_temperature(double kelvin) noexcept;

}  // namespace sdlc::lang
