#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "render/scene/instances.hpp"
#include "render/session/render.hpp"
#include "tests/render/kernel/kernels.hpp"
#include "tests/support/reference/path_tracer.hpp"
#include "tests/support/statistics/random.hpp"
#include "tests/support/statistics/scaled_scene.hpp"
#include "tests/support/statistics/scenes.hpp"

// Paths with light sampling equal those of the reference, as in
// same_paths_test.cpp.
namespace sdlc::test {
namespace {

using render::LightSampling;
using render::LinearRgb;
using render::Precision;
using render::RenderResult;
using render::RenderSettings;
using render::Scene;
using render::Search;
using render::Vec3;

/// Every material below a few lights: some overlap, one contains a sphere, and some are partly
/// below the ground.
Scene lit_scene() {
  Scene scene = beam_scene({0, 1, 4}, {0, 0, 0}, LinearRgb{0.05});
  scene.camera.aspect = 1.5;
  scene.camera.plane_height = 1.2;
  add_sphere(scene, {0, -100.5, 0}, 100, diffuse({0.5, 0.6, 0.3}));
  add_sphere(scene, {-1, 0, 0}, 0.5, specular({0.8, 0.8, 0.6}, 0.2));
  add_sphere(scene, {0, 0, 0}, 0.5, transmissive({1, 0.9, 1}, 1.5));
  add_sphere(scene, {1, 0, 0}, 0.5, diffuse({0.9, 0.2, 0.1}));
  add_sphere(scene, {0.5, 1, -1}, 0.3, emissive({1, 0.9, 0.8}, 5));
  add_sphere(scene, {0.3, 1.1, -0.8}, 0.2, emissive({0.2, 0.9, 0.8}, 8));
  add_sphere(scene, {-0.5, 0.8, 0.5}, 0.1, unlit({0.1, 0.3, 0.9}));
  add_sphere(scene, {-0.3, 0.3, 1}, 0.05, emissive({0.9, 0.5, 0.8}, 50));
  add_sphere(scene, {1.5, 0.2, 1}, 0.02, emissive({0.9, 0.5, 0.2}, 100));
  add_sphere(scene, {-1.5, -0.45, 1}, 0.2, emissive({0.1, 0.5, 0.2}, 3));
  add_sphere(scene, {0.4, -0.3, 1.2}, 0.15, diffuse({0.9, 1, 1}));
  add_sphere(scene, {0.4, -0.3, 1.2}, 0.3, transmissive({0.9, 1, 1}, 1.2));
  add_sphere(scene, {0, 0, 0}, 0, emissive({1, 1, 1}, 1));
  return scene;
}

Scene lit_and_moving() {
  Scene scene = lit_scene();
  scene.shifts.assign(scene.spheres.size(), Vec3{});
  scene.shifts[3] = {0, 0.4, 0};
  scene.shifts[4] = {-0.5, 0.1, 0.2};
  scene.shifts[8] = {0, -1, 0};
  return scene;
}

Scene lit_by_one() {
  Scene scene = beam_scene({0, 0, 4}, {0, 0, 0}, LinearRgb{});
  add_sphere(scene, {0, -100.5, 0}, 100, diffuse({0.5, 0.6, 0.3}));
  add_sphere(scene, {0, 0, 0}, 0.5, diffuse({0.8, 0.2, 0.3}));
  add_sphere(scene, {2, 3, 1}, 0.1, emissive({1, 1, 0.8}, 400));
  return scene;
}

/// More lights than one random number can select.
Scene lit_by_thousands() {
  Scene scene = lit_by_one();
  Random random(4);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 place{random.between(-5, 5), random.between(1, 3), random.between(-5, 3)};
    add_sphere(scene, place, random.between(0.005, 0.02),
               emissive({random.between(0, 1), random.between(0, 1), 1}, 50));
  }
  return scene;
}

Scene lit_room() {
  Scene scene = beam_scene({0, 0, 0.5}, {0, 0.3, 2}, LinearRgb{});
  add_sphere(scene, {0, 0, 0}, 2, diffuse({0.8, 0.7, 0.9}));
  add_sphere(scene, {0.5, 0.2, 0}, 0.3, emissive({1, 1, 0.7}, 10));
  add_sphere(scene, {-0.8, 0.9, 0.9}, 0.5, diffuse({0.3, 0.7, 0.9}));
  return scene;
}

Scene lit_from_a_surface() {
  Scene scene = lit_scene();
  put_camera_on_a_surface(scene);
  return scene;
}

/// The distant sun is computed in double, too.
Scene lit_above_a_large_ground() {
  Scene scene = balls_above_a_large_ground();
  add_sphere(scene, {3e4, 4e4, 1e4}, 1e4, emissive({1, 0.9, 0.7}, 5));
  add_sphere(scene, {0.5, 1, 1}, 0.3, emissive({0.5, 0.9, 0.7}, 5));
  return scene;
}

const std::vector<std::pair<const char*, Scene>>& scenes() {
  static const std::vector<std::pair<const char*, Scene>> all{
      {"lit", lit_scene()},
      {"moving", lit_and_moving()},
      {"by one", lit_by_one()},
      {"room", lit_room()},
      {"from a surface", lit_from_a_surface()},
      {"above a large ground", lit_above_a_large_ground()}};
  return all;
}

constexpr RenderSettings kSettings{
    .width = 42, .height = 28, .samples = 150, .depth = 12, .light_sampling = LightSampling::On};

constexpr RenderSettings kCaustics{.width = 42,
                                   .height = 28,
                                   .samples = 150,
                                   .depth = 12,
                                   .light_sampling = LightSampling::Caustics};

/// Equal in double except for rounding. In float some paths diverge where rounding changes a
/// choice. H0: their radiance has the same expectation, except for 1e-6 of the largest by which
/// float may round. Significance 1e-5.
void expect_same_paths(const RenderResult& wide, const RenderResult& reference, const char* name) {
  EXPECT_EQ(wide.nonfinite_samples, 0u) << name;
  EXPECT_EQ(wide.camera_samples, reference.camera_samples) << name;
  EXPECT_GT(wide.sampled_lights, 0u) << name;
  EstimateBuilder differences;
  double largest = 0, brightest = 0;
  for (std::size_t i = 0; i < wide.picture.pixels.size(); ++i) {
    const LinearRgb ours = wide.picture.pixels[i], theirs = reference.picture.pixels[i];
    differences.add(ours - theirs);
    largest = std::max(largest, difference(ours, theirs));
    brightest = std::max(brightest, difference(theirs, LinearRgb{}));
  }
  if (wide.kernel.precision == Precision::Double) {
    EXPECT_LT(largest, 1e-9 * std::max(1.0, brightest)) << name;
    EXPECT_EQ(wide.rays, reference.rays) << name;
    EXPECT_EQ(wide.truncated_paths, reference.truncated_paths) << name;
  } else {
    Estimate estimate = differences.estimate();
    if (difference(estimate.mean, LinearRgb{}) <= 1e-6 * brightest) estimate.mean = LinearRgb{};
    EXPECT_TRUE(agrees(estimate, LinearRgb{}, 1e-5)) << name;
    EXPECT_LT(estimate.standard_error.g, 1e-3) << name;
    EXPECT_NEAR(static_cast<double>(wide.rays) / static_cast<double>(reference.rays), 1, 1e-3)
        << name;
  }
}

class LightPaths : public testing::TestWithParam<WideForm> {
 protected:
  static render::KernelRequest through_hierarchy() {
    render::KernelRequest request = GetParam().request();
    request.search = Search::Bvh;
    return request;
  }
};

TEST_P(LightPaths, AreThoseOfTheReference) {
  for (const auto& [name, scene] : scenes()) {
    const RenderResult reference = render_by_reference(scene, kSettings);
    expect_same_paths(render_with(scene, kSettings, GetParam().request()), reference, name);
  }
}

TEST_P(LightPaths, AreTheSameThroughAHierarchy) {
  for (const auto& [name, scene] : scenes()) {
    for (const RenderSettings& settings : {kSettings, kCaustics}) {
      const RenderResult all = render_with(scene, settings, GetParam().request());
      const RenderResult bvh = render_with(scene, settings, through_hierarchy());
      ASSERT_EQ(all.kernel.search, Search::All);
      ASSERT_EQ(bvh.kernel.search, Search::Bvh);
      EXPECT_EQ(all.picture.pixels, bvh.picture.pixels) << name;
      EXPECT_EQ(all.rays, bvh.rays) << name;
    }
  }
}

TEST_P(LightPaths, ToThousandsOfLightsAreThoseOfTheReference) {
  RenderSettings settings = kSettings;
  settings.samples = 32;
  const Scene scene = lit_by_thousands();
  const RenderResult reference = render_by_reference(scene, settings);
  EXPECT_EQ(reference.sampled_lights, 5001u);
  expect_same_paths(render_with(scene, settings, through_hierarchy()), reference, "thousands");
}

TEST_P(LightPaths, DoNotDependOnThreads) {
  for (RenderSettings settings : {kSettings, kCaustics}) {
    settings.threads = 1;
    const RenderResult expected = render_with(lit_and_moving(), settings, GetParam().request());
    settings.threads = 3;
    const RenderResult result = render_with(lit_and_moving(), settings, GetParam().request());
    EXPECT_EQ(result.picture.pixels, expected.picture.pixels);
    EXPECT_EQ(result.rays, expected.rays);
  }
}

TEST_P(LightPaths, DoNotDependOnTheScaleOfTheWorld) {
  for (RenderSettings settings : {kSettings, kCaustics}) {
    settings.samples = 8;
    for (const Scene& scene : {lit_and_moving(), lit_scene(), lit_by_one()}) {
      const auto expected = render_with(scene, settings, GetParam().request()).picture;
      for (const int exponent : {60, -60}) {
        const Scene other = scaled(scene, exponent);
        EXPECT_EQ(render_with(other, settings, GetParam().request()).picture.pixels,
                  expected.pixels);
      }
    }
  }
}

// Inverse trigonometric functions round differently, so a few paths meet the edge of a beam on the
// other side. H0: the radiance has the same expectation. Significance 1e-5.
TEST_P(LightPaths, ByCastersAreThoseOfThePortableKernel) {
  for (const auto& [name, scene] : scenes()) {
    const RenderResult portable =
        render_with(scene, kCaustics, {.backend = &render::portable_backend()});
    const RenderResult wide = render_with(scene, kCaustics, GetParam().request());
    EXPECT_EQ(wide.kernel.casters.size(), portable.kernel.casters.size()) << name;
    EXPECT_EQ(wide.nonfinite_samples, 0u) << name;
    EstimateBuilder differences;
    double brightest = 0;
    for (std::size_t i = 0; i < wide.picture.pixels.size(); ++i) {
      differences.add(wide.picture.pixels[i] - portable.picture.pixels[i]);
      brightest = std::max(brightest, difference(portable.picture.pixels[i], LinearRgb{}));
    }
    Estimate estimate = differences.estimate();
    if (difference(estimate.mean, LinearRgb{}) <= 1e-6 * brightest) estimate.mean = LinearRgb{};
    EXPECT_TRUE(agrees(estimate, LinearRgb{}, 1e-5)) << name;
    EXPECT_LT(estimate.standard_error.g, 1e-3) << name;
  }
}

TEST_P(LightPaths, LeaveSamplesOutAsAWholeThatAreNotFinite) {
  Scene scene = lit_by_one();
  scene.background = {.bottom = LinearRgb{1}, .top = LinearRgb{1}};
  scene.materials[2] = emissive({1e300, 1, 1}, 1e300);
  const RenderSettings settings{
      .width = 32, .height = 32, .samples = 16, .depth = 6, .light_sampling = LightSampling::On};
  const RenderResult reference = render_by_reference(scene, settings);
  const RenderResult wide = render_with(scene, settings, GetParam().request());
  EXPECT_GT(reference.nonfinite_samples, 1000u);
  EXPECT_LE(reference.nonfinite_samples, reference.camera_samples);
  EXPECT_NEAR(static_cast<double>(wide.nonfinite_samples),
              static_cast<double>(reference.nonfinite_samples), 3);
  for (std::size_t i = 0; i < wide.picture.pixels.size(); ++i) {
    ASSERT_TRUE(is_finite(wide.picture.pixels[i]));
  }
}

/// A light of so small an angle that directions in float hardly distinguish its edge from its
/// centre still gives a·L·cos θ·(r/d)² if nothing is in the way.
TEST_P(LightPaths, FindTheTiniestLights) {
  const double a = 0.7, d = 4, radius = 4e-9, theta = 0.6;
  Scene scene = beam_scene({0, 3, 0}, {0, 0, 0}, LinearRgb{});
  scene.camera.plane_height = 1e-4;
  add_sphere(scene, {0, -10, 0}, 10, diffuse(LinearRgb{a}));  // its top is the origin
  add_sphere(scene, {d * std::sin(theta), d * std::cos(theta), 0}, radius,
             emissive(LinearRgb{1}, 20 * (d / radius) * (d / radius)));
  add_sphere(scene, {0, 0, 0}, 25, unlit(LinearRgb{}));  // behind it
  const RenderSettings settings{
      .width = 4, .height = 4, .samples = 64, .depth = 2, .light_sampling = LightSampling::On};
  const LinearRgb expected{20 * a * std::cos(theta)};
  for (const LinearRgb pixel : render_with(scene, settings, GetParam().request()).picture.pixels) {
    EXPECT_LT(difference(pixel, expected), 1e-3 * expected.r);
  }
}

/// Emitters that are seen directly, found by scattering, sampled, and hidden.
Scene hardly_lit() {
  Scene scene = lit_scene();
  add_sphere(scene, {0, 0, 0}, 0.3, emissive({1, 1, 1}, 1));
  add_sphere(scene, {0, 0, 0}, 0.35, diffuse({1, 1, 1}));  // around the previous one
  add_sphere(scene, {-3, 4, 3}, 0.004, emissive({1, 1, 1}, 1));
  add_sphere(scene, {3, 40, 3}, 0.1, emissive({1, 1, 1}, 1));
  return scene;
}

TEST_P(LightPaths, ReachEmittersAsOftenAsThoseOfTheReference) {
  const Scene scene = hardly_lit();
  RenderSettings settings = kSettings;
  settings.samples = 3;
  for (const LightSampling sampling : {LightSampling::Off, LightSampling::On}) {
    settings.light_sampling = sampling;
    settings.threads = 1;
    const RenderResult reference = render_by_reference(scene, settings);
    EXPECT_GE(reference.scarce_emitters.size(), 2u);
    EXPECT_EQ(std::ranges::count(reference.scarce_emitters, render::ReachedEmitter{13, 0}), 1)
        << "in the dark";
    settings.threads = 3;
    for (const auto& request : {GetParam().request(), through_hierarchy()}) {
      const RenderResult wide = render_with(scene, settings, request);
      if (wide.kernel.precision == Precision::Double) {
        EXPECT_EQ(wide.scarce_emitters, reference.scarce_emitters);
      } else {  // a path or two diverge
        ASSERT_EQ(wide.scarce_emitters.size(), reference.scarce_emitters.size());
        for (std::size_t i = 0; i < wide.scarce_emitters.size(); ++i) {
          EXPECT_EQ(wide.scarce_emitters[i].sphere, reference.scarce_emitters[i].sphere);
          EXPECT_NEAR(wide.scarce_emitters[i].paths, reference.scarce_emitters[i].paths, 2);
        }
      }
    }
  }
}

TEST_P(LightPaths, OfInstancesAreThoseOfTheirSpheres) {
  if (GetParam().precision != Precision::Double) GTEST_SKIP() << "instances are traced in double";
  Scene scene = lit_and_moving();
  scene.prototypes = {{.spheres = {{{0, 0, 0}, 0.2, 0}, {{0.3, 0.1, 0}, 0.15, 3}}, .shifts = {}}};
  for (const Vec3 place : {Vec3{-0.6, -0.3, 1.5}, Vec3{0.2, 0.5, 0.3}}) {
    scene.instances.push_back({.prototype = 0, .placement = {.translate = place}, .shift = {}});
  }
  const RenderResult held_once = render_with(scene, kSettings, through_hierarchy());
  const RenderResult plain = render_with(without_instances(scene), kSettings, through_hierarchy());
  EXPECT_EQ(held_once.sampled_lights, plain.sampled_lights);
  EXPECT_EQ(held_once.scarce_emitters, plain.scarce_emitters);
  EXPECT_NEAR(static_cast<double>(held_once.rays), static_cast<double>(plain.rays), 20);
  std::size_t different = 0;
  for (std::size_t i = 0; i < plain.picture.pixels.size(); ++i) {
    different += difference(held_once.picture.pixels[i], plain.picture.pixels[i]) > 1e-6;
  }
  EXPECT_LE(different, 5u);  // rounding makes one path in about ten thousand diverge
}

INSTANTIATE_TEST_SUITE_P(Forms, LightPaths, testing::ValuesIn(wide_forms()), form_name);

TEST(LightKernel, GivesTheSameBytesWithAllInstructionSetsThatFuse) {
  expect_same_bytes(scenes(), kSettings);
  expect_same_bytes(scenes(), kCaustics);
}

}  // namespace
}  // namespace sdlc::test
