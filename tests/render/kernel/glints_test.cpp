#include "render/kernel/glints.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "render/kernel/glint_outline.hpp"
#include "tests/support/statistics/scenes.hpp"

namespace sdlc::render {
namespace {

std::vector<Glint::Place> circle(double x, double y, double radius) {
  std::vector<Glint::Place> outline;
  for (int i = 0; i < 64; ++i) {
    const double angle = i * std::numbers::pi / 32;
    outline.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle)});
  }
  return outline;
}

// The margin is a fiftieth of the radius.
TEST(PartInPixel, IsARectangleAroundWhatIsInside) {
  const auto whole = part_in_pixel(circle(0.4, 0.6, 0.1));
  ASSERT_TRUE(whole);
  EXPECT_NEAR(whole->left, 0.3, 0.003);
  EXPECT_NEAR(whole->right, 0.5, 0.003);
  EXPECT_NEAR(whole->bottom, 0.5, 0.003);
  EXPECT_NEAR(whole->top, 0.7, 0.003);
  EXPECT_LT(whole->left, 0.3);
  EXPECT_GT(whole->top, 0.7);
  EXPECT_FALSE(part_in_pixel(circle(1.2, 0.6, 0.1)));
  EXPECT_FALSE(part_in_pixel(circle(1.08, 1.08, 0.1)));  // beside the corner
}

// A segment of a circle is much smaller than the part of its rectangle that is in the pixel.
TEST(PartInPixel, IsTightWhereTheEdgeOfThePixelCutsOffASegment) {
  const auto part = part_in_pixel(circle(1.09, 0.5, 0.1));
  ASSERT_TRUE(part);
  const double half_chord = std::sqrt(0.1 * 0.1 - 0.09 * 0.09);
  EXPECT_NEAR(part->left, 0.99, 0.003);
  EXPECT_EQ(part->right, 1);
  EXPECT_NEAR(part->bottom, 0.5 - half_chord, 0.004);
  EXPECT_NEAR(part->top, 0.5 + half_chord, 0.004);
}

/// A mirror in the middle of the picture, and a lamp to the right and above, beside the camera.
Scene mirror_and_lamp() {
  Scene scene = test::beam_scene({0, 0, 5}, {0, 0, 0}, LinearRgb{});
  test::add_sphere(scene, {0, 0, 0}, 1, test::specular(LinearRgb{1}, 0));
  test::add_sphere(scene, {2, 1, 5}, 0.1, test::emissive(LinearRgb{1}, 2));
  return scene;
}
const std::vector<std::uint32_t> kCasters{0}, kLights{1};

// The normal there is halfway between the directions to the camera and to the lamp.
TEST(Glints, AreWhereAMirrorShowsTheLamp) {
  const Glints glints = find_glints(mirror_and_lamp(), kCasters, kLights);
  EXPECT_TRUE(glints.are_complete);
  ASSERT_EQ(glints.images.size(), 1u);
  Vec3 normal{0, 0, 1};
  for (int i = 0; i < 100; ++i) {
    normal = unit(unit(Vec3{0, 0, 5} - normal) + unit(Vec3{2, 1, 5} - normal));
  }
  const double x = normal.x / (5 - normal.z) + 0.5, y = normal.y / (5 - normal.z) + 0.5;
  double low_x = 1, high_x = 0, low_y = 1, high_y = 0;
  for (const Glint::Place& at : glints.images[0].outline) {
    low_x = std::fmin(low_x, at.x), high_x = std::fmax(high_x, at.x);
    low_y = std::fmin(low_y, at.y), high_y = std::fmax(high_y, at.y);
  }
  EXPECT_NEAR((low_x + high_x) / 2, x, 1e-4);
  EXPECT_NEAR((low_y + high_y) / 2, y, 1e-4);
  EXPECT_LT(high_x - low_x, 0.006);
}

TEST(Glints, AreIncompleteWhereImagesMoveOrAreThin) {
  Scene moving = mirror_and_lamp();
  moving.shifts = {Vec3{}, {0.1, 0, 0}};
  EXPECT_FALSE(find_glints(moving, kCasters, kLights).are_complete);
  Scene with_lens = mirror_and_lamp();
  with_lens.camera.aperture = 0.1, with_lens.camera.focus = 5;
  EXPECT_FALSE(find_glints(with_lens, kCasters, kLights).are_complete);
  // A ring around a ball of glass with the lamp behind it.
  Scene ring = mirror_and_lamp();
  ring.materials[0] = test::transmissive(LinearRgb{1}, 1.5);
  ring.spheres[1].center = {0, 0, -5};
  EXPECT_FALSE(find_glints(ring, kCasters, kLights).are_complete);
}

}  // namespace
}  // namespace sdlc::render
