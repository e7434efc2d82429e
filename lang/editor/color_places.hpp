#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lang/editor/scene_view.hpp"
#include "lang/source/source.hpp"
#include "render/math/color.hpp"

/// Colours in texts, for swatches and colour pickers.
namespace sdlc::lang {

enum class ColorSpelling : std::uint8_t {
  Hex,   ///< `#fc0`, `#ffcc00`
  Name,  ///< `tomato`
  Rgb,   ///< the constructor of the same name, as the others
  Hsl,
  Linear,
  Linear255,  ///< or `[r, g, b]` of a config
  Kelvin,
};

/// sRGB-encoded red, green and blue, from 0 to 1: what a swatch shows.
using DisplayedRgb = std::array<double, 3>;

/// A colour literal, or a call of a constructor of colours whose arguments are numbers.
struct ColorPlace {
  Span where;
  ColorSpelling spelling = ColorSpelling::Hex;
  render::LinearRgb color;
  std::array<Span, 3> numbers = {};  ///< of spellings with three: in the order of the components

  /// The largest component if it is greater than 1, else 1. A swatch shows the colour divided by
  /// it, and a picked colour is multiplied by it, so that a picker never changes it.
  double intensity() const noexcept;
  DisplayedRgb displayed() const noexcept;
};

/// All colours of a scene file that a swatch can show, in the order of the text. Colours with
/// negative components and wrong arguments are omitted.
std::vector<ColorPlace> colors_of(const SceneView& view, std::uint32_t file);
/// The colour in exactly this place; nullopt if there is none.
std::optional<ColorPlace> color_at(const SceneView& view, std::uint32_t file, Span where);

/// The colours of a JSON config.
std::vector<ColorPlace> colors_of_config(std::string_view text);

/// Texts for a picked colour in place of the old one, the one with the old spelling first. It keeps
/// labels, units and comments, the case of hex digits, and the numbers of components that do not
/// change. Names that the scene hides are not used.
std::vector<std::string> color_presentations(const SceneView& view, std::uint32_t file,
                                             const ColorPlace& place, const DisplayedRgb& picked);
/// The same for a config, which has one spelling. `text`: the whole text.
std::vector<std::string> config_color_presentations(std::string_view text, const ColorPlace& place,
                                                    const DisplayedRgb& picked);

}  // namespace sdlc::lang
