#include "render/session/student_t.hpp"

#include <algorithm>

namespace sdlc::render {

double student_t_975(double degrees) noexcept {
  constexpr double z = 1.959963984540054, z2 = z * z;
  constexpr double g1 = z * (z2 + 1) / 4;
  constexpr double g2 = z * ((5 * z2 + 16) * z2 + 3) / 96;
  constexpr double g3 = z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384;
  constexpr double g4 = z * ((((79 * z2 + 776) * z2 + 1482) * z2 - 1920) * z2 - 945) / 92160;
  const double u = 1 / std::max(degrees, 1.0);
  return z + u * (g1 + u * (g2 + u * (g3 + u * g4)));
}

}  // namespace sdlc::render
