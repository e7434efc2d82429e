#pragma once

#include <span>
#include <string>

namespace sdlc::lang {

/// The number of a JSON colour whose linear component is 1.
inline constexpr double kWhite = 255;

/// Unlike ==, distinguishes -0 from 0.
bool have_same_bits(double a, double b) noexcept;

/// The shortest JSON spelling that reads back as the same number; -0 keeps its sign.
std::string config_number(double number);

struct ScaledComponent {
  double number = 0;     ///< 255 times the component
  bool is_exact = true;  ///< number / 255 is the component, bit for bit
};

/// A component of a linear colour on the scale of configs. Several numbers may give the component:
/// the result is one of `preferred` (ascending) if possible, else the one with the shortest
/// spelling. About one component in 256 has no exact number.
ScaledComponent to_config_scale(double component, std::span<const double> preferred);

}  // namespace sdlc::lang
