#include "render/exactness/touching.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/statistics/random.hpp"

namespace sdlc::render {
namespace {

constexpr double kUnit = 0x1p-24;
// The required distance of two spheres whose far sides are at `extent`.
constexpr double apart(double extent) { return 4 * kUnit * extent; }

/// Spheres of a rebased scene, and their radii after touching ones are separated.
class Touching : public testing::Test {
 protected:
  void add(Vec3 center, double radius, Vec3 shift = {}) {
    scene_.spheres.push_back({.center = center, .radius = radius});
    scene_.shifts.push_back(shift);
  }
  std::vector<double> parted(Precision precision = Precision::Float,
                             std::vector<std::uint32_t> exact = {}) {
    Scene scene = scene_;
    part_touching(scene, precision, exact);
    std::vector<double> radii;
    for (const Sphere& sphere : scene.spheres) radii.push_back(sphere.radius);
    return radii;
  }

  Scene scene_;
};

TEST_F(Touching, ShrinksTheSmallerOfTwoThatTouchFromOutside) {
  add({0, 0, -0.25}, 0.125);
  add({0, 0, -0.875}, 0.5);
  EXPECT_DOUBLE_EQ(parted()[0], 0.125 - apart(1.375));
  EXPECT_EQ(parted()[1], 0.5);
  EXPECT_DOUBLE_EQ(parted(Precision::Double)[0], 0.125 - apart(1.375) * 0x1p-29);
  EXPECT_DOUBLE_EQ(parted(Precision::Float, {1})[0], 0.125 - apart(0.375));
}

TEST_F(Touching, ShrinksTheInnerOneOfTwoThatTouch) {
  add({0, 0, 0.3}, 0.5);
  add({0, 0, 0.7}, 0.1);
  EXPECT_EQ(parted()[0], 0.5);
  EXPECT_DOUBLE_EQ(parted()[1], 0.1 - apart(0.8));
}

TEST_F(Touching, LeavesSpheresThatAreApartOrCross) {
  for (const double gap : {1.01, -1.01}) {
    scene_ = {};
    add({0, 0, -0.2 + gap * apart(1.3)}, 0.1);
    add({0, 0, -0.8}, 0.5);
    EXPECT_EQ(parted()[0], 0.1) << gap;
  }
  scene_ = {};
  add({0, 0, -0.2 - 0.99 * apart(1.3)}, 0.1);  // any closer and they touch
  add({0, 0, -0.8}, 0.5);
  EXPECT_DOUBLE_EQ(parted()[0], 0.1 - 1.99 * apart(1.3));
}

TEST_F(Touching, PartsAChainOfSpheresWithinSpheres) {
  add({0, 0, 0}, 0.8);
  add({0, 0, -0.3}, 0.5);  // touches the first, and everything below
  add({0, 0, -0.6}, 0.2);
  const auto radii = parted();
  EXPECT_DOUBLE_EQ(radii[1], 0.5 - apart(0.8));
  EXPECT_DOUBLE_EQ(radii[2], 0.2 - 2 * apart(0.8));
}

TEST_F(Touching, PartsWhatGoesTogether) {
  add({0, 0, 0}, 0.75, {0.5, 0, 0});
  add({0, 1, 0}, 0.25, {0.5, 0, 0});
  EXPECT_DOUBLE_EQ(parted()[1], 0.25 - apart(std::hypot(0.5, 1) + 0.25));
  scene_.shifts[1] = {-0.5, 0, 0};  // past the other one
  EXPECT_EQ(parted()[1], 0.25);
  scene_.shifts.clear();
  EXPECT_DOUBLE_EQ(parted()[1], 0.25 - apart(1.25));
}

// The second one shrinks by up to two gaps, and would otherwise intersect a sphere that is nearer
// to it.
TEST_F(Touching, ShrinksWhatIsInASphereThatShrinks) {
  add({0, 0, 0}, 1);
  add({0, 0, -1.5}, 0.5);
  add({0, 0, -1.5}, 0.5 - 1.5 * apart(2));
  const auto radii = parted();
  EXPECT_DOUBLE_EQ(radii[1], 0.5 - apart(2));
  EXPECT_DOUBLE_EQ(radii[2], 0.5 - 2 * apart(2));
}

// For two spheres in double of any size, points near the camera are accurate.
TEST_F(Touching, PartsTwoThatAreMetInDoubleByWhereTheyTouch) {
  add({0, 0, -1024}, 1024 - 1);
  add({0, 0, -2048}, 2048 - 1);
  const auto radii = parted(Precision::Float, {0, 1});
  EXPECT_EQ(radii[1], 2047);
  EXPECT_GT(radii[0], 1023 - 4 * kUnit * 2);
  EXPECT_LT(radii[0], 1023 - 4 * kUnit);
}

// No pair is nearer than allowed, and pairs that were separate or nested stay so.
TEST_F(Touching, KeepsWhatIsInWhat) {
  test::Random random(3);
  for (int scene = 0; scene < 200; ++scene) {
    scene_ = {};
    // Each new one touches an earlier one from outside or inside, or nearly does.
    add({0, 0, 0}, 0.5);
    for (int i = 1; i < 30; ++i) {
      const Sphere& other =
          scene_.spheres[static_cast<std::size_t>(random.between(0, static_cast<double>(i)))];
      const double radius = other.radius * random.between(0.5, 1);
      const double gap = apart(1) * random.between(-0.9, 3);
      const double distance =
          random.between(0, 1) < 0.5 ? other.radius - radius - gap : other.radius + radius + gap;
      add(other.center + random.direction() * distance, radius);
    }
    double extent = 0;
    for (const Sphere& s : scene_.spheres) extent = std::max(extent, length(s.center) + s.radius);
    const auto radii = parted();
    for (std::size_t a = 0; a < radii.size(); ++a) {
      for (std::size_t b = 0; b < radii.size(); ++b) {
        const Sphere &s = scene_.spheres[a], &t = scene_.spheres[b];
        if (a == b || s.radius < t.radius) continue;
        const double distance = length(s.center - t.center);
        const double least =
            0.99 * apart(std::max(length(s.center) + s.radius, length(t.center) + t.radius));
        if (distance - s.radius - t.radius > -least) {
          EXPECT_GT(distance - radii[a] - radii[b], least) << scene << ": " << a << ", " << b;
        }
        if (s.radius - t.radius - distance > -least) {
          EXPECT_GT(radii[a] - radii[b] - distance, least) << scene << ": " << a << ", " << b;
        }
      }
    }
  }
}

TEST_F(Touching, LeavesASphereThatTheCameraStandsOn) {
  add({0, 0, -0.125}, 0.125);
  add({0, 0, -0.75}, 0.5);
  EXPECT_EQ(parted()[0], 0.125);
}

TEST_F(Touching, LeavesASphereThatWouldLoseMoreThanItsSixtyFourth) {
  const double tiny = 60 * apart(1);
  add({0, 0, -0.5 + tiny}, tiny);
  add({0, 0, -1}, 0.5);
  EXPECT_EQ(parted()[0], tiny);
  EXPECT_LT(parted(Precision::Double)[0], tiny);
}

}  // namespace
}  // namespace sdlc::render
