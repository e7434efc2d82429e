#include "tests/support/reference/intersect.hpp"

#include <gtest/gtest.h>

namespace sdlc::test::reference {
namespace {

TEST(HitDistance, IsTheNearPointFromOutside) {
  EXPECT_EQ(hit_distance({0, 0, 5}, {0, 0, -1}, 1), 4);
}

TEST(HitDistance, IsTheFarPointFromInside) {
  EXPECT_EQ(hit_distance({0, 0, 0.5}, {0, 0, -1}, 1), 1.5);
  EXPECT_EQ(hit_distance({0, 0, 0.5}, {0, 0, 1}, 1), 0.5);
}

TEST(HitDistance, IsNoneBehindOrBeside) {
  EXPECT_EQ(hit_distance({0, 0, 5}, {0, 0, 1}, 1), kNoHit);
  EXPECT_EQ(hit_distance({0, 1.001, 5}, {0, 0, -1}, 1), kNoHit);
}

// The error grows as distance / radius: 1e-16 · 1e8 here, where the textbook formula has lost every
// digit.
TEST(HitDistance, KeepsItsDigitsFarAway) {
  const double t = hit_distance({0, 0.6, 1e8}, {0, 0, -1}, 1);
  EXPECT_NEAR(t, 1e8 - 0.8, 3e-8);
  EXPECT_EQ(hit_distance({0, 1 + 1e-7, 1e8}, {0, 0, -1}, 1), kNoHit);
}

TEST(RehitDistance, IsNoneOutwardsAndTheChordInwards) {
  const Vec3 normal{0, 1, 0};
  EXPECT_EQ(rehit_distance({0, 1, 0}, normal, 2), kNoHit);
  EXPECT_EQ(rehit_distance({1, 0, 0}, normal, 2), kNoHit);
  EXPECT_EQ(rehit_distance({0, -1, 0}, normal, 2), 4);
}

TEST(RehitNormal, KeepsLengthAndAngleOverAThousandReflections) {
  const Vec3 start = unit({0.3, 1, 0.2});
  Vec3 normal = start, direction = unit({0.5, -0.7, 0.1});
  const double cosine = -dot(direction, normal);
  for (int i = 0; i < 1000; ++i) {
    normal = rehit_normal(direction, normal);
    direction = unit(direction - normal * (2 * dot(direction, normal)));
  }
  EXPECT_NEAR(length(normal), 1, 1e-15);
  EXPECT_NEAR(-dot(direction, normal), cosine, 1e-12);
}

}  // namespace
}  // namespace sdlc::test::reference
