#pragma once

#include <cstdint>

#include <gtest/gtest.h>

#include "render/math/color.hpp"

namespace sdlc::test {

/// A mean of independent samples and its standard error, per channel.
struct Estimate {
  render::LinearRgb mean;
  render::LinearRgb standard_error;
  std::uint64_t samples = 0;
};

/// Accumulates an Estimate.
class EstimateBuilder {
 public:
  void add(render::LinearRgb sample) {
    sum_ += sample;
    sum_of_squares_ += sample * sample;
    ++count_;
  }
  Estimate estimate() const;

 private:
  render::LinearRgb sum_, sum_of_squares_;
  std::uint64_t count_ = 0;
};

/// Two-sided z-test of H0 "the expectation is `expected`" in each channel, at a third of
/// `significance` each (Bonferroni): under H0 it fails with at most that probability over the
/// choice of seeds. A channel without any spread must be exact except for the rounding of the sum,
/// n · 2^-53 of it.
testing::AssertionResult agrees(const Estimate& estimate, render::LinearRgb expected,
                                double significance = 1e-4);

/// The same for H0 "both have the same expectation". They are independent.
testing::AssertionResult agree(const Estimate& a, const Estimate& b, double significance);

}  // namespace sdlc::test
