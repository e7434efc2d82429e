#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "tests/extremes/cases.hpp"
#include "tests/support/statistics/estimate.hpp"

// Radiance along the axis against its closed form, by every kernel in every precision that resolves
// the scene. H0 of each comparison: the estimator's expectation is the closed form. Significance
// 1e-5 each, with fixed seeds: the probability that one of all comparisons fails by chance is below
// 2 %. Rounding, and the angle of a pixel, may add 1e-5 of the value in float and 1e-7 in double.
namespace sdlc::test {
namespace {

using render::LinearRgb;
using render::Precision;

class Extremes : public testing::TestWithParam<Form> {};

testing::AssertionResult is(Estimate estimate, LinearRgb expected, Precision precision) {
  const double part = precision == Precision::Double ? 1e-7 : 1e-5;
  const auto forgive = [&](double& mean, double wanted) {
    if (std::fabs(mean - wanted) <= part * std::fabs(wanted)) mean = wanted;
  };
  forgive(estimate.mean.r, expected.r);
  forgive(estimate.mean.g, expected.g);
  forgive(estimate.mean.b, expected.b);
  return agrees(estimate, expected, 1e-5);
}

TEST_P(Extremes, HaveTheirKnownRadiance) {
  int traced = 0;
  for (const ExtremeCase& extreme : extreme_cases()) {
    for (const ExtremeVariant& variant : extreme.variants) {
      if (!may_trace(GetParam(), variant.scene, settings_of(variant))) continue;
      ++traced;
      const Measured measured = measure(variant, GetParam());
      EXPECT_EQ(measured.result.nonfinite_samples, 0u) << extreme.name << ": " << variant.what;
      EXPECT_TRUE(is(measured.estimate, variant.expected, GetParam().precision))
          << extreme.name << ": " << variant.what << " ("
          << name_of(measured.result.kernel.precision) << ")";
    }
  }
  EXPECT_GT(traced, GetParam().precision == Precision::Double ? 100 : 50);
}

INSTANTIATE_TEST_SUITE_P(Forms, Extremes, testing::ValuesIn(all_forms()), form_name);

}  // namespace
}  // namespace sdlc::test
