#include "tests/support/reference/light_cone.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/statistics/random.hpp"

namespace sdlc::test::reference {
namespace {

TEST(LightCone, HasTheHeightOfTheCapThatTheSphereCovers) {
  EXPECT_NEAR(light_cone({0, 0, 2}, 1).height, 1 - std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(light_cone({3e5, 0, 0}, 3e-5).height / 0.5e-20, 1, 1e-12);
}

TEST(LightCone, IsNoneFromInsideAndFromTooNear) {
  EXPECT_EQ(light_cone({0.5, 0, 0}, 1).height, 0);
  EXPECT_EQ(light_cone({0, 0, 0}, 1).height, 0);
  EXPECT_EQ(light_cone({1.05, 0, 0}, 1).height, 0);
  EXPECT_GT(light_cone({1.06, 0, 0}, 1).height, 0);
}

TEST(LightCone, HasDirectionsOfLengthOneThatMeetTheSphereWhereTheySay) {
  test::Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 to_center = random.direction() * random.between(1.2, 5);
    const double radius = random.between(0.01, 1);
    const auto [direction, distance] = sample_cone(light_cone(to_center, radius), radius,
                                                   {random.between(0, 1), random.between(0, 1)});
    EXPECT_NEAR(length(direction), 1, 1e-14);
    // At the edge of the cone half the chord is the root of a rounding error.
    EXPECT_NEAR(length(direction * distance - to_center), radius, 1e-7);
    EXPECT_LT(distance, length(to_center));
  }
}

TEST(LightCone, IsFilledEvenly) {
  // The share of the cap within the cosine c is (1 − c) / height. H0: the directions have this
  // share.
  test::Random random(2);
  const Vec3 to_center{1, 2, -2};
  const LightCone cone = light_cone(to_center, 1.5);
  constexpr int kSamples = 100000;
  int inner = 0, on_one_side = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 direction =
        sample_cone(cone, 1.5, {random.between(0, 1), random.between(0, 1)}).direction;
    inner += 1 - dot(direction, to_center) / 3 < cone.height / 4;
    on_one_side += dot(direction, Vec3{0, 1, 1}) > 0;  // across the axis
  }
  // Four standard deviations: false alarms in 6e-5 of seeds.
  EXPECT_NEAR(inner, kSamples / 4, 4 * std::sqrt(kSamples * 3.0 / 16));
  EXPECT_NEAR(on_one_side, kSamples / 2, 4 * std::sqrt(kSamples / 4.0));
}

// Weight of a connection times the inverse of its density, and that of a scattered ray, by their
// definitions.
TEST(ScatteringWeight, IsThatOfTheBalanceHeuristic) {
  const LightCone cone = light_cone({0, 0, 3}, 1);
  const double probability = 0.3, cosine = 0.4;
  const double of_light = probability / (2 * M_PI * cone.height), of_scattering = cosine / M_PI;
  const double weight = scattering_weight(probability, cone, cosine);
  EXPECT_NEAR(weight, of_scattering / (of_light + of_scattering), 1e-15);
  EXPECT_NEAR(weight, of_light / (of_light + of_scattering) * of_scattering / of_light, 1e-15);
  EXPECT_EQ(scattering_weight(0, cone, cosine), 1);
  EXPECT_EQ(scattering_weight(0.5, LightCone{}, cosine), 1);
  EXPECT_EQ(scattering_weight(0, cone, 0), 1);
}

}  // namespace
}  // namespace sdlc::test::reference
