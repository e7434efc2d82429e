#include "render/kernel/wide_scene.hpp"

#include <gtest/gtest.h>

#include "tests/support/statistics/random.hpp"
#include "tests/support/statistics/scenes.hpp"

namespace sdlc::render {
namespace {

constexpr int kSide = 158, kLayers = 4;
constexpr int kMany = kSide * kSide * kLayers;

/// Spheres around the points of a flat grid, each with a different color, a third of them metal.
Scene colorful_crowd() {
  test::Random random(17);
  Scene scene;
  for (int i = 0; i < kMany; ++i) {
    const Vec3 point{1.0 * (i % kSide), 1.0 * (i / kSide % kLayers), 1.0 * (i / kSide / kLayers)};
    const LinearRgb color{random.between(0, 1), random.between(0, 1), random.between(0, 1)};
    test::add_sphere(scene, (point + random.in_box(0.2)) / kSide - Vec3{0.5, 0.5, 0.5},
                     random.between(0.1, 0.3) / kSide,
                     i % 3 == 0 ? test::specular(color, i % 1000 * 1e-3) : test::diffuse(color));
  }
  return scene;
}

template <typename T>
double bytes_a_sphere(const Scene& scene) {
  const WideScene<T> wide(scene, Search::Bvh);
  return static_cast<double>(wide.memory_bytes()) / kMany;
}

TEST(WideScene, TakesFewBytesASphereWithAMaterialOfItsOwn) {
  const Scene scene = colorful_crowd();
  ASSERT_EQ(scene.materials.size(), scene.spheres.size());
  EXPECT_LE(bytes_a_sphere<float>(scene), 54);
  EXPECT_LE(bytes_a_sphere<double>(scene), 92);
}

}  // namespace
}  // namespace sdlc::render
