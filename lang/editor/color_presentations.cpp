#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "lang/editor/color_places.hpp"
#include "lang/text/ascii.hpp"
#include "lang/value/colors.hpp"
#include "render/image/tone.hpp"

namespace sdlc::lang {
namespace {

using Components = std::array<double, 3>;
using Codes = std::array<int, 3>;

Codes codes_of(const DisplayedRgb& displayed) {
  Codes codes{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double fraction = std::isfinite(displayed[i]) ? std::clamp(displayed[i], 0.0, 1.0) : 0;
    codes[i] = static_cast<int>(std::lround(fraction * 255));
  }
  return codes;
}

// Hex and names

std::string hex(const Codes& codes) {
  return fmt::format("#{:02x}{:02x}{:02x}", codes[0], codes[1], codes[2]);
}

/// Three digits if the old text has three and they are enough, in its case.
std::string hex_like(std::string_view old, const Codes& codes) {
  std::string text = hex(codes);
  const bool is_short = old.size() == 4;
  const bool fits = std::ranges::all_of(codes, [](int code) { return code % 17 == 0; });
  if (is_short && fits) text = {text[0], text[1], text[3], text[5]};
  const auto is_lower = [](char c) { return c >= 'a' && c <= 'f'; };
  const auto is_upper = [](char c) { return c >= 'A' && c <= 'F'; };
  const bool is_capital = std::ranges::any_of(old, is_upper) && std::ranges::none_of(old, is_lower);
  return is_capital ? upper_case(text) : text;
}

std::string name_of(const Codes& codes) {
  const auto encoded = static_cast<std::uint32_t>(codes[0] << 16 | codes[1] << 8 | codes[2]);
  const auto named = std::ranges::find(named_colors(), encoded, &NamedColor::encoded);
  return named == named_colors().end() ? std::string() : std::string(named->name);
}

// Components as numbers

/// CSS Color 4, 7.2: hue in degrees, saturation and lightness from 0 to 1.
Components hsl_of(const DisplayedRgb& rgb) {
  const auto [r, g, b] = rgb;
  const double max = std::max({r, g, b}), min = std::min({r, g, b}), range = max - min;
  const double lightness = (max + min) / 2;
  if (range == 0) return {0, 0, lightness};
  const double saturation = range / (1 - std::fabs(2 * lightness - 1));
  double sixths = 0;
  if (max == r) {
    sixths = (g - b) / range + (g < b ? 6 : 0);
  } else if (max == g) {
    sixths = (b - r) / range + 2;
  } else {
    sixths = (r - g) / range + 4;
  }
  return {sixths * 60, std::min(saturation, 1.0), lightness};
}

/// The numbers of the constructor.
Components components_of(ColorSpelling spelling, const DisplayedRgb& rgb, double intensity) {
  if (spelling == ColorSpelling::Hsl) return hsl_of(rgb);
  Components components{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double linear = render::decode_tone(render::Tone::Srgb, rgb[i]) * intensity;
    components[i] = spelling == ColorSpelling::Rgb         ? rgb[i] * 255
                    : spelling == ColorSpelling::Linear255 ? linear * 255
                                                           : linear;
  }
  return components;
}

/// The colour that the constructor makes of the numbers.
render::LinearRgb color_of(ColorSpelling spelling, const Components& c) {
  switch (spelling) {
    case ColorSpelling::Rgb: return {decode_srgb(c[0]), decode_srgb(c[1]), decode_srgb(c[2])};
    case ColorSpelling::Hsl: return decode_hsl(c[0], c[1], c[2]);
    case ColorSpelling::Linear255: return {c[0] / 255, c[1] / 255, c[2] / 255};
    default: return {c[0], c[1], c[2]};
  }
}

/// How a number is written.
struct NumberStyle {
  int decimals = 0;
  std::string_view unit;
  double factor = 1;  ///< from the value to the number before the unit
};

NumberStyle style_of(std::string_view number) {
  const std::size_t end = number.find_last_of("0123456789.") + 1;
  NumberStyle style;
  style.unit = number.substr(end);
  if (style.unit == "%") style.factor = 100;
  if (style.unit == "rad") style.factor = 0.017453292519943295;
  if (style.unit == "turn") style.factor = 1 / 360.0;
  const std::string_view digits = number.substr(0, end);
  const std::size_t point = digits.find('.');
  const bool is_plain = digits.find_first_of("eE") == std::string_view::npos;
  if (point != std::string_view::npos && is_plain) {
    style.decimals = static_cast<int>(digits.size() - point - 1);
  }
  return style;
}

std::string written(double value, const NumberStyle& style, int decimals) {
  std::string text = fmt::format("{:.{}f}", value * style.factor, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
  }
  return text + std::string(style.unit);
}

double rounded(double value, const NumberStyle& style, int decimals) {
  double scale = 1;
  for (int i = 0; i < decimals; ++i) scale *= 10;
  return std::round(value * style.factor * scale) / scale / style.factor;
}

using Styles = std::array<NumberStyle, 3>;

/// The fewest decimals, at least those of the styles, that give the picked codes.
int enough_decimals(ColorSpelling spelling, const Components& components, const Styles& styles,
                    double intensity, const Codes& codes) {
  constexpr int kMaxDecimals = 9;
  int decimals = std::max({styles[0].decimals, styles[1].decimals, styles[2].decimals});
  for (; decimals < kMaxDecimals; ++decimals) {
    Components numbers{};
    for (std::size_t i = 0; i < 3; ++i) {
      numbers[i] = rounded(components[i], styles[i], decimals);
    }
    const render::LinearRgb color = color_of(spelling, numbers) / intensity;
    const Codes made{render::to_code8(render::Tone::Srgb, color.r),
                     render::to_code8(render::Tone::Srgb, color.g),
                     render::to_code8(render::Tone::Srgb, color.b)};
    if (made == codes) break;
  }
  return decimals;
}

/// The old text with other numbers.
std::string with_numbers(std::string_view text, const ColorPlace& place, const Codes& codes) {
  const Codes old_codes = codes_of(place.displayed());
  const DisplayedRgb picked{codes[0] / 255.0, codes[1] / 255.0, codes[2] / 255.0};
  const Components components = components_of(place.spelling, picked, place.intensity());
  Styles styles;
  for (std::size_t i = 0; i < 3; ++i) {
    styles[i] = style_of(text.substr(place.numbers[i].begin, place.numbers[i].size()));
  }
  const int decimals =
      enough_decimals(place.spelling, components, styles, place.intensity(), codes);
  const bool is_hsl = place.spelling == ColorSpelling::Hsl;
  const bool is_grey = codes[0] == codes[1] && codes[1] == codes[2];
  std::array<std::size_t, 3> order{0, 1, 2};  // of the text: labels allow any
  std::ranges::sort(order, {}, [&](std::size_t i) { return place.numbers[i].begin; });
  std::string result;
  std::uint32_t at = place.where.begin;
  for (const std::size_t i : order) {
    const Span number = place.numbers[i];
    const bool is_kept = is_hsl ? is_grey && i == 0 : codes[i] == old_codes[i];  // grey has no hue
    const std::string_view old = text.substr(number.begin, number.size());
    result += text.substr(at, number.begin - at);
    result += is_kept ? std::string(old) : written(components[i], styles[i], decimals);
    at = number.end;
  }
  return result += text.substr(at, place.where.end - at);
}

/// The codes as the name of a colour, unless the scene has another value of that name.
std::string visible_name(const SymbolTable& table, const Codes& codes) {
  std::string name = name_of(codes);
  const bool is_hidden = std::ranges::any_of(table.symbols(), [&](const Symbol& symbol) {
    return symbol.name == name && name_space_of(symbol.kind) == NameSpace::Values;
  });
  return is_hidden ? std::string() : name;
}

std::string in_old_spelling(std::string_view text, const ColorPlace& place, const Codes& codes,
                            const std::string& name) {
  const std::string_view old = text.substr(place.where.begin, place.where.size());
  switch (place.spelling) {
    case ColorSpelling::Hex: return hex_like(old, codes);
    case ColorSpelling::Name: return name.empty() ? hex(codes) : name;
    case ColorSpelling::Kelvin: return hex(codes);
    default: return with_numbers(text, place, codes);
  }
}

}  // namespace

std::vector<std::string> color_presentations(const SceneView& view, std::uint32_t file,
                                             const ColorPlace& place, const DisplayedRgb& picked) {
  const std::string_view text = view.file(file).text();
  const Codes codes = codes_of(picked);
  if (codes == codes_of(place.displayed())) return {std::string(view.file(file).text(place.where))};
  const std::string name = visible_name(view.table(file), codes);
  std::vector<std::string> texts{in_old_spelling(text, place, codes, name)};
  // Other spellings cannot express the intensity.
  if (place.intensity() > 1) return texts;
  const auto add = [&](std::string other) {
    if (!other.empty() && std::ranges::find(texts, other) == texts.end()) {
      texts.push_back(std::move(other));
    }
  };
  add(name);
  add(hex(codes));
  const bool is_rgb_hidden = view.module(file).function_names.contains("rgb");
  if (!is_rgb_hidden) add(fmt::format("rgb({}, {}, {})", codes[0], codes[1], codes[2]));
  return texts;
}

std::vector<std::string> config_color_presentations(std::string_view text, const ColorPlace& place,
                                                    const DisplayedRgb& picked) {
  const Codes codes = codes_of(picked);
  if (codes == codes_of(place.displayed())) {
    return {std::string(text.substr(place.where.begin, place.where.size()))};
  }
  return {with_numbers(text, place, codes)};
}

}  // namespace sdlc::lang
