#pragma once

#include <cmath>

#include "render/session/student_t.hpp"

namespace sdlc::render {

/// The variance of a sum of independent terms whose variances are each known only roughly. The
/// effective number of terms, (Σ v)² / Σ v², is the degrees of freedom of a Student's t
/// distribution (Satterthwaite, "An approximate distribution of estimates of variance components",
/// 1946).
class PooledVariance {
 public:
  void add(double variance) noexcept {
    sum_ += variance;
    squares_ += variance * variance;
  }
  /// Half the length of the 95 % confidence interval for the sum of the terms.
  double half_width() const noexcept {
    if (!(sum_ > 0)) return 0;
    return student_t_975(sum_ * sum_ / squares_) * std::sqrt(sum_);
  }

 private:
  double sum_ = 0, squares_ = 0;
};

}  // namespace sdlc::render
