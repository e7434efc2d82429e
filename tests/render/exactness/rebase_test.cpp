#include "render/exactness/rebase.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/statistics/scaled_scene.hpp"

namespace sdlc::render {
namespace {

using test::scaled;

Scene small_scene() {
  Scene scene;
  scene.camera = {.from = {1, 2, 3}, .at = {4, 5, 7}};
  scene.spheres = {{{0, 0.5, -2}, 1.5, 0}, {{3, 3, 3}, 0.25, 0}};
  scene.shifts = {{0, 0, 0}, {0.5, -0.25, 9}};
  return scene;
}

TEST(RebaseToCamera, BringsTheExtentBetweenOneAndTwo) {
  Scene scene = small_scene();
  rebase_to_camera(scene);
  EXPECT_EQ(scene.camera.from, Vec3{});
  double extent = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const Sphere& s = scene.spheres[i];
    extent = std::fmax(extent,
                       std::fmax(length(s.center), length(s.center + scene.shifts[i])) + s.radius);
  }
  EXPECT_GE(extent, 1);
  EXPECT_LT(extent, 2);
}

TEST(RebaseToCamera, CountsTheRadiusOfTheLens) {
  Scene scene = small_scene();
  scene.camera.aperture = 200;
  rebase_to_camera(scene);
  EXPECT_EQ(scene.camera.aperture / 2, 100.0 / 64);  // of an extent of 109.6
}

TEST(RebaseToCamera, GivesTheSameBitsForEveryPowerOfTwo) {
  Scene expected = small_scene();
  rebase_to_camera(expected);
  for (const int exponent : {-1000, -60, 60, 1000}) {
    Scene scene = scaled(small_scene(), exponent);
    rebase_to_camera(scene);
    EXPECT_EQ(scene.spheres, expected.spheres) << exponent;
    EXPECT_EQ(scene.shifts, expected.shifts) << exponent;
    EXPECT_EQ(scene.camera.at, expected.camera.at) << exponent;
  }
}

TEST(RebaseToCamera, SurvivesCoordinatesNearTheLargestNumber) {
  Scene scene;
  scene.camera = {.from = {1.6e308, 0, 0}, .at = {-1.6e308, 0, 0}};
  scene.spheres = {{{-1.6e308, 1e307, 0}, 1e308, 0}};
  rebase_to_camera(scene);
  EXPECT_TRUE(is_finite(scene.spheres[0].center));
  EXPECT_GT(scene.spheres[0].radius, 0);
  EXPECT_LT(scene.camera.at.x, 0);
}

}  // namespace
}  // namespace sdlc::render
