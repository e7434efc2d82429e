#include <cmath>

#include "lang/math/elementary.hpp"

namespace sdlc::lang {

double round_half_away(double x) noexcept {
  const double whole = std::trunc(x);
  return std::fabs(x - whole) < 0.5 ? whole : whole + std::copysign(1.0, x);
}

std::optional<double> modulo(double a, double b) noexcept {
  if (b == 0) return std::nullopt;
  const double rest = std::fmod(a, b);  // exact, with the sign of a
  if (rest == 0) return 0;
  return (rest < 0) == (b < 0) ? rest : rest + b;
}

}  // namespace sdlc::lang
