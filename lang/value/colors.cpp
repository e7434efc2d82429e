#include "lang/value/colors.hpp"

#include <algorithm>
#include <array>

#include "lang/math/elementary.hpp"

namespace sdlc::lang {
namespace {

constexpr auto kNamedColors = std::to_array<NamedColor>({
    {"aliceblue", 0xf0f8ff},
    {"antiquewhite", 0xfaebd7},
    {"aqua", 0x00ffff},
    {"aquamarine", 0x7fffd4},
    {"azure", 0xf0ffff},
    {"beige", 0xf5f5dc},
    {"bisque", 0xffe4c4},
    {"black", 0x000000},
    {"blanchedalmond", 0xffebcd},
    {"blue", 0x0000ff},
    {"blueviolet", 0x8a2be2},
    {"brown", 0xa52a2a},
    {"burlywood", 0xdeb887},
    {"cadetblue", 0x5f9ea0},
    {"chartreuse", 0x7fff00},
    {"chocolate", 0xd2691e},
    {"coral", 0xff7f50},
    {"cornflowerblue", 0x6495ed},
    {"cornsilk", 0xfff8dc},
    {"crimson", 0xdc143c},
    {"cyan", 0x00ffff},
    {"darkblue", 0x00008b},
    {"darkcyan", 0x008b8b},
    {"darkgoldenrod", 0xb8860b},
    {"darkgray", 0xa9a9a9},
    {"darkgreen", 0x006400},
    {"darkgrey", 0xa9a9a9},
    {"darkkhaki", 0xbdb76b},
    {"darkmagenta", 0x8b008b},
    {"darkolivegreen", 0x556b2f},
    {"darkorange", 0xff8c00},
    {"darkorchid", 0x9932cc},
    {"darkred", 0x8b0000},
    {"darksalmon", 0xe9967a},
    {"darkseagreen", 0x8fbc8f},
    {"darkslateblue", 0x483d8b},
    {"darkslategray", 0x2f4f4f},
    {"darkslategrey", 0x2f4f4f},
    {"darkturquoise", 0x00ced1},
    {"darkviolet", 0x9400d3},
    {"deeppink", 0xff1493},
    {"deepskyblue", 0x00bfff},
    {"dimgray", 0x696969},
    {"dimgrey", 0x696969},
    {"dodgerblue", 0x1e90ff},
    {"firebrick", 0xb22222},
    {"floralwhite", 0xfffaf0},
    {"forestgreen", 0x228b22},
    {"fuchsia", 0xff00ff},
    {"gainsboro", 0xdcdcdc},
    {"ghostwhite", 0xf8f8ff},
    {"gold", 0xffd700},
    {"goldenrod", 0xdaa520},
    {"gray", 0x808080},
    {"green", 0x008000},
    {"greenyellow", 0xadff2f},
    {"grey", 0x808080},
    {"honeydew", 0xf0fff0},
    {"hotpink", 0xff69b4},
    {"indianred", 0xcd5c5c},
    {"indigo", 0x4b0082},
    {"ivory", 0xfffff0},
    {"khaki", 0xf0e68c},
    {"lavender", 0xe6e6fa},
    {"lavenderblush", 0xfff0f5},
    {"lawngreen", 0x7cfc00},
    {"lemonchiffon", 0xfffacd},
    {"lightblue", 0xadd8e6},
    {"lightcoral", 0xf08080},
    {"lightcyan", 0xe0ffff},
    {"lightgoldenrodyellow", 0xfafad2},
    {"lightgray", 0xd3d3d3},
    {"lightgreen", 0x90ee90},
    {"lightgrey", 0xd3d3d3},
    {"lightpink", 0xffb6c1},
    {"lightsalmon", 0xffa07a},
    {"lightseagreen", 0x20b2aa},
    {"lightskyblue", 0x87cefa},
    {"lightslategray", 0x778899},
    {"lightslategrey", 0x778899},
    {"lightsteelblue", 0xb0c4de},
    {"lightyellow", 0xffffe0},
    {"lime", 0x00ff00},
    {"limegreen", 0x32cd32},
    {"linen", 0xfaf0e6},
    {"magenta", 0xff00ff},
    {"maroon", 0x800000},
    {"mediumaquamarine", 0x66cdaa},
    {"mediumblue", 0x0000cd},
    {"mediumorchid", 0xba55d3},
    {"mediumpurple", 0x9370db},
    {"mediumseagreen", 0x3cb371},
    {"mediumslateblue", 0x7b68ee},
    {"mediumspringgreen", 0x00fa9a},
    {"mediumturquoise", 0x48d1cc},
    {"mediumvioletred", 0xc71585},
    {"midnightblue", 0x191970},
    {"mintcream", 0xf5fffa},
    {"mistyrose", 0xffe4e1},
    {"moccasin", 0xffe4b5},
    {"navajowhite", 0xffdead},
    {"navy", 0x000080},
    {"oldlace", 0xfdf5e6},
    {"olive", 0x808000},
    {"olivedrab", 0x6b8e23},
    {"orange", 0xffa500},
    {"orangered", 0xff4500},
    {"orchid", 0xda70d6},
    {"palegoldenrod", 0xeee8aa},
    {"palegreen", 0x98fb98},
    {"paleturquoise", 0xafeeee},
    {"palevioletred", 0xdb7093},
    {"papayawhip", 0xffefd5},
    {"peachpuff", 0xffdab9},
    {"peru", 0xcd853f},
    {"pink", 0xffc0cb},
    {"plum", 0xdda0dd},
    {"powderblue", 0xb0e0e6},
    {"purple", 0x800080},
    {"rebeccapurple", 0x663399},
    {"red", 0xff0000},
    {"rosybrown", 0xbc8f8f},
    {"royalblue", 0x4169e1},
    {"saddlebrown", 0x8b4513},
    {"salmon", 0xfa8072},
    {"sandybrown", 0xf4a460},
    {"seagreen", 0x2e8b57},
    {"seashell", 0xfff5ee},
    {"sienna", 0xa0522d},
    {"silver", 0xc0c0c0},
    {"skyblue", 0x87ceeb},
    {"slateblue", 0x6a5acd},
    {"slategray", 0x708090},
    {"slategrey", 0x708090},
    {"snow", 0xfffafa},
    {"springgreen", 0x00ff7f},
    {"steelblue", 0x4682b4},
    {"tan", 0xd2b48c},
    {"teal", 0x008080},
    {"thistle", 0xd8bfd8},
    {"tomato", 0xff6347},
    {"turquoise", 0x40e0d0},
    {"violet", 0xee82ee},
    {"wheat", 0xf5deb3},
    {"white", 0xffffff},
    {"whitesmoke", 0xf5f5f5},
    {"yellow", 0xffff00},
    {"yellowgreen", 0x9acd32},
});

/// The transfer function of IEC 61966-2-1; `encoded` from 0 to 1.
double decode(double encoded) noexcept {
  return encoded <= 0.04045 ? encoded / 12.92 : power((encoded + 0.055) / 1.055, 2.4);
}

const std::array<double, 256>& decoded_bytes() noexcept {
  static const std::array<double, 256> table = [] {
    std::array<double, 256> decoded{};
    for (int i = 0; i < 256; ++i) decoded[static_cast<std::size_t>(i)] = decode(i / 255.0);
    return decoded;
  }();
  return table;
}

render::LinearRgb decode_bytes(std::uint32_t encoded) noexcept {
  const auto& table = decoded_bytes();
  return {table[encoded >> 16 & 0xFF], table[encoded >> 8 & 0xFF], table[encoded & 0xFF]};
}

}  // namespace

std::span<const NamedColor> named_colors() noexcept { return kNamedColors; }

std::optional<render::LinearRgb> find_named_color(std::string_view name) noexcept {
  const auto found = std::lower_bound(
      kNamedColors.begin(), kNamedColors.end(), name,
      [](const NamedColor& color, std::string_view wanted) { return color.name < wanted; });
  if (found == kNamedColors.end() || found->name != name) return std::nullopt;
  return decode_bytes(found->encoded);
}

double decode_srgb(double encoded_255) noexcept {
  const bool is_byte = encoded_255 >= 0 && encoded_255 <= 255 &&
                       encoded_255 == static_cast<double>(static_cast<int>(encoded_255));
  if (is_byte) return decoded_bytes()[static_cast<std::size_t>(encoded_255)];
  return decode(encoded_255 / 255.0);
}

render::LinearRgb decode_hex_color(std::string_view text) noexcept {
  const auto digit = [&](std::size_t i) -> std::uint32_t {
    const char c = text[i];
    return static_cast<std::uint32_t>(c <= '9' ? c - '0' : (c | 0x20) - 'a' + 10);
  };
  std::uint32_t encoded = 0;
  const bool is_short = text.size() == 4;
  for (std::size_t i = 1; i < text.size(); ++i) {
    encoded = encoded << 4 | digit(i);
    if (is_short) encoded = encoded << 4 | digit(i);
  }
  return decode_bytes(encoded);
}

render::LinearRgb decode_hsl(double hue, double saturation, double lightness) noexcept {
  const double twelfths = *modulo(hue, 360) / 30;
  const double a = saturation * std::min(lightness, 1 - lightness);
  const auto component = [&](double n) {
    const double k = *modulo(n + twelfths, 12);
    return lightness - a * std::max(-1.0, std::min({k - 3, 9 - k, 1.0}));
  };
  return {decode(component(0)), decode(component(8)), decode(component(4))};
}

render::LinearRgb color_of_temperature(double kelvin) noexcept {
  const double u = 1000 / kelvin;
  const double x = kelvin <= 4000 ? ((-0.2661239 * u - 0.2343589) * u + 0.8776956) * u + 0.179910
                                  : ((-3.0258469 * u + 2.1070379) * u + 0.2226347) * u + 0.240390;
  const double y =
      kelvin <= 2222   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
      : kelvin <= 4000 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                       : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
  const double big_x = x / y, big_z = (1 - x - y) / y;  // of luminance Y = 1
  const double r = 3.2404542 * big_x - 1.5371385 - 0.4985314 * big_z;
  const double g = -0.9692660 * big_x + 1.8760108 + 0.0415560 * big_z;
  const double b = 0.0556434 * big_x - 0.2040259 + 1.0572252 * big_z;
  const double largest = std::max({r, g, b});
  return {std::max(r, 0.0) / largest, std::max(g, 0.0) / largest, std::max(b, 0.0) / largest};
}

}  // namespace sdlc::lang
