#pragma once

namespace sdlc::render {

/// The quantile at .975 of Student's t, half the length of an interval of 95 % in standard errors,
/// by its series in 1 / ν (Abramowitz, Stegun, 26.7.5): 1 % too small for 2 degrees of freedom,
/// 11 % for 1; fewer count as 1.
double student_t_975(double degrees) noexcept;

}  // namespace sdlc::render
