#pragma once

namespace sdlc::render {

/// The 0.975 quantile of Student's t distribution: half the length of a 95 % interval, in standard
/// errors. Uses the series in 1 / ν (Abramowitz, Stegun, 26.7.5), which is 1 % too small for 2
/// degrees of freedom and 11 % for 1. Fewer degrees count as 1.
double student_t_975(double degrees) noexcept;

}  // namespace sdlc::render
