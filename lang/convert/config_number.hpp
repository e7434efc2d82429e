#pragma once

#include <span>
#include <string>

namespace sdlc::lang {

/// Tells -0 from 0.
bool have_same_bits(double a, double b) noexcept;

/// The shortest spelling that reads back as the same number, as JSON has it; -0 keeps its sign.
std::string config_number(double number);

struct ScaledComponent {
  double number = 0;     ///< 255 times the component
  bool is_exact = true;  ///< the config's reader makes the very component of it
};

/// The component of a linear colour on the scale of configs, where 255 is 1. Several numbers may be
/// read as the same component: one of `preferred`, which ascends, goes before the one that is
/// shortest to spell. One component in 256 is read from no number at all.
ScaledComponent to_config_scale(double component, std::span<const double> preferred);

}  // namespace sdlc::lang
