#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "render/session/render.hpp"
#include "tests/support/statistics/estimate.hpp"
#include "tests/support/statistics/scenes.hpp"

// Connections by way of mirrors and glass have the same expectation as scattering alone, at every
// depth limit. H0: paths with and without them have the same expectation, so that estimates with
// different seeds differ according to their standard errors. Significance 1e-4 per test, shared
// among its cases; seeds are fixed.
namespace sdlc::test {
namespace {

using render::LightSampling;
using render::LinearRgb;
using render::RenderResult;
using render::RenderSettings;
using render::Scene;
using render::Vec3;

constexpr LinearRgb kBlack{};
constexpr int kDepths[]{2, 3, 4, 6, 16};

/// A gray ground, seen at the origin.
Scene on_the_ground(LinearRgb sky = kBlack) {
  Scene scene = beam_scene({0, 3, 2}, {0, 0, 0}, sky);
  add_sphere(scene, {0, -100, 0}, 100, diffuse({0.8, 0.7, 0.9}));
  return scene;
}

Scene below_glass() {
  Scene scene = on_the_ground({0.1, 0.05, 0.2});
  add_sphere(scene, {0.3, 0.5, -0.1}, 0.4, transmissive({0.9, 1, 0.8}, 1.5));
  add_sphere(scene, {0.8, 1.6, -0.2}, 0.3, emissive({1, 0.8, 0.5}, 10));
  return scene;
}

/// Light of all orders of reflection inside, exactly.
Scene below_diamond() {
  Scene scene = on_the_ground();
  add_sphere(scene, {0.1, 0.45, 0}, 0.4, transmissive({1, 1, 1}, 2.4, render::Fresnel::Exact));
  add_sphere(scene, {-0.8, 0.9, 0.2}, 0.25, emissive({1, 0.8, 0.5}, 10));
  return scene;
}

/// The visible point, the centre of the ball and that of the light are on one line.
Scene in_the_focus() {
  Scene scene = on_the_ground();
  add_sphere(scene, {0, 0.6, 0}, 0.4, transmissive({1, 1, 1}, 1.5));
  add_sphere(scene, {0, 3, 0}, 0.2, emissive({1, 0.8, 0.5}, 10));
  return scene;
}

Scene beside_mirrors() {
  Scene scene = on_the_ground();
  add_sphere(scene, {0.7, 0.5, 0}, 0.4, specular({0.9, 0.8, 0.7}, 0));
  add_sphere(scene, {-0.6, 0.3, 0.4}, 0.3, specular({0.7, 0.8, 0.9}, 0));
  add_sphere(scene, {-0.2, 0.3, -0.5}, 0.3, specular({0.9, 0.9, 0.9}, 0.3));
  add_sphere(scene, {0.1, 1.7, 0.3}, 0.3, emissive({1, 0.8, 0.5}, 10));
  add_sphere(scene, {1.4, 1.2, 0.5}, 0.2, emissive({0.2, 0.8, 1}, 30));
  return scene;
}

/// A shell, a lamp in glass, and one that overlaps with it.
Scene among_nested_ones() {
  Scene scene = on_the_ground();
  add_sphere(scene, {0.4, 0.5, 0}, 0.4, transmissive({0.9, 1, 0.8}, 1.5));
  add_sphere(scene, {0.4, 0.5, 0}, 0.3, transmissive({1, 1, 1}, 1 / 1.5));
  add_sphere(scene, {-0.5, 0.5, 0.2}, 0.4, transmissive({0.9, 0.9, 1}, 1.3));
  add_sphere(scene, {-0.5, 0.5, 0.2}, 0.2, emissive({1, 0.8, 0.5}, 10));
  add_sphere(scene, {-0.1, 0.7, 0.2}, 0.15, emissive({0.2, 0.8, 0.5}, 10));
  return scene;
}

Scene moving_ones() {
  Scene scene = below_glass();
  add_sphere(scene, {-0.6, 0.3, 0.4}, 0.3, specular({0.7, 0.8, 0.9}, 0));
  scene.shifts.assign(scene.spheres.size(), Vec3{});
  scene.shifts[1] = {-0.3, 0.1, 0.2};
  scene.shifts[2] = {0.3, -0.5, 0.1};
  scene.shifts[3] = {0, 0.4, 0};
  return scene;
}

/// The ground is in the ball, whose glass is denser than what is around it.
Scene inside_of_glass() {
  Scene scene = beam_scene({0, 0.5, 0.4}, {0, 0, 0}, kBlack);
  add_sphere(scene, {0, -0.5, 0}, 0.5, diffuse({0.8, 0.7, 0.9}));
  add_sphere(scene, {0, 0, 0}, 2, transmissive({0.9, 1, 0.9}, 1.4));
  add_sphere(scene, {0.5, 3.5, 0}, 1, emissive({1, 0.8, 0.5}, 10));
  add_sphere(scene, {0.5, 0.3, 0}, 0.2, specular({0.9, 0.8, 0.7}, 0));
  return scene;
}

TEST(Caustics, HaveTheExpectationOfPlainPathsAtEveryDepth) {
  const std::vector<std::pair<const char*, Scene>> scenes{
      {"below glass", below_glass()},     {"below diamond", below_diamond()},
      {"in the focus", in_the_focus()},   {"beside mirrors", beside_mirrors()},
      {"nested", among_nested_ones()},    {"moving", moving_ones()},
      {"inside glass", inside_of_glass()}};
  const double significance = 1e-4 / static_cast<double>(scenes.size() * std::size(kDepths));
  for (const auto& [name, scene] : scenes) {
    for (const int depth : kDepths) {
      const Estimate plain = radiance_along_axis(scene, {.depth = depth, .samples = 1 << 18});
      const Estimate found = radiance_along_axis(
          scene, {.depth = depth, .seed = 11, .light_sampling = LightSampling::Caustics});
      EXPECT_TRUE(agree(found, plain, significance)) << name << ", depth " << depth;
    }
  }
}

/// A lamp that is so small that plain paths hardly ever find it; its light is that of a larger one.
Scene in_the_focus_of(double lamp) {
  Scene scene = in_the_focus();
  scene.spheres[2].radius = lamp;
  scene.materials[2] = emissive({1, 1, 1}, 1 / (lamp * lamp));
  return scene;
}

// The light on the ground below the ball hardly depends on the size of a small lamp: with one of
// 1e-3 it differs from the limit by less than its standard error. Neither does the noise; the
// largest is where light comes only by reflections inside, which few connections try.
TEST(Caustics, AreFoundHoweverSmallTheLampIs) {
  for (const double aside : {0.0, 0.05, 0.4}) {
    const auto estimate = [&](double lamp, std::uint64_t seed) {
      Scene scene = in_the_focus_of(lamp);
      for (render::Sphere& sphere : scene.spheres) {
        if (sphere.radius < 50) sphere.center.x += aside;
      }
      return radiance_along_axis(scene, {.depth = 8,
                                         .samples = 1 << 16,
                                         .seed = seed,
                                         .light_sampling = LightSampling::Caustics});
    };
    const Estimate expected = estimate(1e-3, 1);
    for (const double lamp : {1e-5, 1e-8}) {
      const Estimate found = estimate(lamp, 2);
      EXPECT_TRUE(agree(found, expected, 1e-4 / 6)) << lamp << ", " << aside;
      EXPECT_LT(found.standard_error.g * 256, 25 * found.mean.g) << lamp << ", " << aside;
    }
  }
}

/// A ball with a small image of a lamp, filling the picture.
Scene glint(const render::Material& ball) {
  Scene scene = beam_scene({0, 0, 5}, {0, 0, 0}, {0.05, 0.05, 0.05});
  scene.camera.plane_height = 0.4;
  add_sphere(scene, {0, 0, 0}, 1, ball);
  add_sphere(scene, {2, 3, 4}, 0.1, emissive({1, 0.8, 0.5}, 100));
  return scene;
}

// In every order of the spheres: a search that hits nothing must not be taken for one of them.
TEST(Caustics, ShowTheImagesOfLampsThatPlainPathsShow) {
  for (int i = 0; i < 6; ++i) {
    Scene scene = glint(i < 3 ? specular({0.9, 0.8, 0.7}, 0) : transmissive({1, 0.9, 0.8}, 1.5));
    add_sphere(scene, {0, -101, 0}, 100, diffuse({0.5, 0.5, 0.5}));
    std::rotate(scene.spheres.begin(), scene.spheres.begin() + i % 3, scene.spheres.end());
    const auto mean_of_pictures = [&](LightSampling sampling, std::uint64_t first_seed) {
      EstimateBuilder pictures;
      for (std::uint64_t seed = first_seed; seed < first_seed + 100; ++seed) {
        const RenderSettings settings{.width = 12,
                                      .height = 12,
                                      .samples = 256,
                                      .depth = 8,
                                      .seed = seed,
                                      .light_sampling = sampling};
        render::RenderMonitor monitor;
        const RenderResult result = render::render(scene, settings, monitor);
        LinearRgb sum;
        for (const LinearRgb& pixel : result.picture.pixels) sum += pixel;
        pictures.add(sum / static_cast<double>(result.picture.pixels.size()));
      }
      return pictures.estimate();
    };
    const Estimate plain = mean_of_pictures(LightSampling::On, 1);
    const Estimate found = mean_of_pictures(LightSampling::Caustics, 1000);
    EXPECT_TRUE(agree(found, plain, 1e-4 / 6)) << i;
    EXPECT_LT(found.standard_error.g, plain.standard_error.g / 3) << i;
  }
}

}  // namespace
}  // namespace sdlc::test
