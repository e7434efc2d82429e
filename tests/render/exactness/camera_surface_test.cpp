#include "render/exactness/camera_surface.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "render/exactness/rebase.hpp"
#include "tests/support/statistics/random.hpp"

namespace sdlc::render {
namespace {

using test::Random;

std::size_t count_in_rebased(Scene scene) {
  rebase_to_camera(scene);
  std::size_t count = 0;
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
    const Vec3 shift = scene.shifts.empty() ? Vec3{} : scene.shifts[i];
    count += has_camera_on_it(scene.spheres[i], shift) ? 1 : 0;
  }
  return count;
}

double power_of_ten(double e) { return std::pow(10.0, e); }

/// Up to four spheres of any size anywhere, many of them with the camera on their surface.
Scene random_scene(Random& random) {
  const double size = power_of_ten(random.between(-307, 305));
  const bool is_far = random.between(0, 1) < 0.5, has_shifts = random.between(0, 1) < 0.3;
  Scene scene;
  scene.camera.from = is_far ? random.in_box(size) : Vec3{};
  scene.camera.at = scene.camera.from + Vec3{size, 0, 0};
  const double count = random.between(1, 5);
  for (int i = 1; i <= count; ++i) {
    const double part = random.between(0, 1) < 0.5 ? 1 : power_of_ten(random.between(-200, 0));
    const double radius = size * part;
    // On it, or nearly, or somewhere; from outside.
    const double way = random.between(0, 1);
    const double off = way < 0.6 ? 0 : way < 0.8 ? power_of_ten(random.between(-16, -9)) : 0.5;
    const Vec3 center = scene.camera.from + random.direction() * radius * (1 + off);
    scene.spheres.push_back({center, radius, 0});
    if (has_shifts) scene.shifts.push_back(i % 2 == 0 ? Vec3{0, size * part, 0} : Vec3{});
  }
  return scene;
}

TEST(CameraSurface, IsCountedAsInTheRebasedScene) {
  Random random(17);
  std::array<int, 6> scenes_with{};
  for (int i = 0; i < 1000; ++i) {
    const Scene scene = random_scene(random);
    const std::size_t expected = count_in_rebased(scene);
    EXPECT_EQ(count_under_camera(scene), expected) << "scene " << i;
    ++scenes_with[expected];
  }
  // None, one and several: ensures that the answers are not all "no".
  EXPECT_GT(scenes_with[0], 100);
  EXPECT_GT(scenes_with[1], 100);
  EXPECT_GT(scenes_with[2], 100);
}

TEST(CameraSurface, IsCountedAsInTheRebasedSceneAtTheEndsOfDouble) {
  const auto on = [](Vec3 camera, double radius) {
    return Sphere{camera + Vec3{0, radius, 0}, radius, 0};
  };
  for (const double offset : {0.0, 1e-308, 1.0, 1e300, -1.7e308}) {
    for (const double a : {4.9e-324, 1e-310, 1e-300, 1e-150, 1.0, 1e150, 1e300, 8e307}) {
      for (const double b : {4.9e-324, 1e-300, 1.0, 1e300}) {
        Scene scene;
        scene.camera = {.from = {offset, 0, 0}, .at = {offset, 0, 1}};
        scene.spheres = {on(scene.camera.from, a), on(scene.camera.from, b), {{}, 0, 0}};
        EXPECT_EQ(count_under_camera(scene), count_in_rebased(scene))
            << offset << ", " << a << ", " << b;
        scene.shifts = {{}, {1e-300, 0, 0}, {}};
        EXPECT_EQ(count_under_camera(scene), count_in_rebased(scene))
            << offset << ", " << a << ", " << b << ", moving";
      }
    }
  }
}

// Squares of lengths that are small compared with the extent underflow: a distance becomes 0.
TEST(CameraSurface, IsNotThatOfSpheresTooSmallForTheScene) {
  Scene scene;
  scene.spheres = {{{1e-200, 0, 0}, 1e-200, 0}};
  EXPECT_EQ(count_under_camera(scene), 1u);
  scene.spheres.push_back({{0, 0, -3}, 1, 0});
  EXPECT_EQ(count_under_camera(scene), 0u);
  EXPECT_EQ(count_in_rebased(scene), 0u);
}

}  // namespace
}  // namespace sdlc::render
