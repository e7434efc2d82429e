#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "lang/object/object.hpp"
#include "render/math/color.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::lang {

/// The tag of a number (ruling 20): metres and seconds are 1, and do not add up.
enum class Unit : std::uint8_t { None, Length, Time };

struct Scalar {
  double value = 0;
  Unit unit = Unit::None;
};

struct Triple {
  render::Vec3 value;
  Unit unit = Unit::None;
};

struct AngleTriple {
  render::Vec3 degrees;
};

/// `from .. to`
struct Bounds {
  double from = 0, to = 0;
  Unit unit = Unit::None;
};

/// What has been reported; whatever is computed from it is silent.
struct Failed {};

/// What an expression computes, with the tags and types that a property has not yet asked for.
using Computed = std::variant<Failed, Scalar, bool, std::string, Triple, Angle, AngleTriple,
                              render::LinearRgb, Bounds, MaterialValue, MotionValue>;

inline bool has_failed(const Computed& value) noexcept {
  return std::holds_alternative<Failed>(value);
}

/// "a number", "a length": what a message calls the value.
std::string_view describe(const Computed& value) noexcept;

}  // namespace sdlc::lang
