#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lang/object/value.hpp"
#include "render/math/color.hpp"

/// Values as text for people: short, and in several units.
namespace sdlc::lang {

/// The value in the syntax of the language. Long lists and strings are shortened with `…`.
std::string short_text(const Value& value);
/// The same value in other units: an angle in radians, a small length in centimetres, a colour in
/// hex.
std::vector<std::string> other_spellings(const Value& value);

/// The nearest `#rrggbb`; nullopt for a colour with a component below 0 or above 1.
std::optional<std::string> nearest_hex(render::LinearRgb color);
/// The hex colour that is decoded to exactly this colour.
std::optional<std::string> exact_hex(render::LinearRgb color);

}  // namespace sdlc::lang
