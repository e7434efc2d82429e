#include "render/scene/touching.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

constexpr double kUnit = 0x1p-24;
// What two spheres are to be apart whose far sides are at `extent`.
constexpr double apart(double extent) { return 4 * kUnit * extent; }

/// Spheres of a rebased scene, and their radii once those that touch are parted.
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
  add({0, 0, -0.2 - 0.99 * apart(1.3)}, 0.1);  // by less they touch
  add({0, 0, -0.8}, 0.5);
  EXPECT_DOUBLE_EQ(parted()[0], 0.1 - 1.99 * apart(1.3));
}

TEST_F(Touching, PartsAChainOfSpheresWithinSpheres) {
  add({0, 0, 0}, 0.8);
  add({0, 0, -0.3}, 0.5);  // touches the first, and all below
  add({0, 0, -0.6}, 0.2);
  const auto radii = parted();
  EXPECT_DOUBLE_EQ(radii[1], 0.5 - apart(0.8));
  EXPECT_DOUBLE_EQ(radii[2], 0.2 - 2 * apart(0.8));
}

// From (1, 1) to (−1, 1) beside one at the origin it comes as near as 1 at half time.
TEST_F(Touching, PartsWhatTouchesWhileTheShutterIsOpen) {
  add({0, 0, 0}, 0.7);
  add({1, 1, 0}, 0.3, {-2, 0, 0});
  const double extent = std::sqrt(2) + 0.3;
  EXPECT_DOUBLE_EQ(parted()[1], 0.3 - apart(extent));
  scene_.shifts[1] = {-0.5, 0, 0};  // not yet there
  EXPECT_EQ(parted()[1], 0.3);
  scene_.shifts = {{0.5, 0, 0}, {0.5, 0, 0}};  // both go the same way
  EXPECT_EQ(parted()[1], 0.3);
}

TEST_F(Touching, LeavesASphereThatTheCameraStandsOn) {
  add({0, 0, -0.1}, 0.1);
  add({0, 0, -0.7}, 0.5);
  EXPECT_EQ(parted()[0], 0.1);
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
