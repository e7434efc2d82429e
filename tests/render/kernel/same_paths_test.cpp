#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "render/session/render.hpp"
#include "tests/render/kernel/kernels.hpp"
#include "tests/support/reference/path_tracer.hpp"
#include "tests/support/statistics/scaled_scene.hpp"
#include "tests/support/statistics/scenes.hpp"

// The kernels trace the same paths as the reference, from the same random numbers: pictures
// are compared sample by sample, which finds errors that a comparison of expectations would miss.
namespace sdlc::test {
namespace {

using render::LinearRgb;
using render::Picture;
using render::Precision;
using render::RenderResult;
using render::RenderSettings;
using render::Scene;
using render::Search;
using render::Vec3;

/// Every material in several variants, nested spheres, and a gradient; more spheres than a vector
/// has lanes.
Scene rich_scene() {
  Scene scene = beam_scene({0, 1, 4}, {0, 0, 0}, LinearRgb{1});
  scene.background = {};
  scene.camera.aspect = 1.5;
  scene.camera.plane_height = 1.2;
  add_sphere(scene, {0, -100.5, 0}, 100, diffuse({0.5, 0.6, 0.3}));
  add_sphere(scene, {-1, 0, 0}, 0.5, specular({0.8, 0.8, 0.6}, 0.2));
  add_sphere(scene, {0, 0, 0}, 0.5, transmissive({1, 0.9, 1}, 1.5));
  add_sphere(scene, {0, 0, 0}, 0.4, transmissive({1, 1, 0.9}, 1 / 1.5));
  add_sphere(scene, {1, 0, 0}, 0.5, diffuse({0.9, 0.2, 0.1}));
  add_sphere(scene, {0.5, 1, -1}, 0.3, emissive({1, 0.9, 0.8}, 5));
  add_sphere(scene, {-0.5, 0.8, 0.5}, 0.1, unlit({0.1, 0.3, 0.9}));
  add_sphere(scene, {1.3, 0.2, 1}, 0.2, specular({0.9, 0.9, 0.9}, 0));
  add_sphere(scene, {-1.3, 0.1, 1}, 0.2, specular({0.7, 0.9, 0.9}, 2.5));
  add_sphere(scene, {0.4, -0.2, 1.2}, 0.25, transmissive({0.9, 1, 1}, 1.8, render::Fresnel::Exact));
  add_sphere(scene, {0, 0, 0}, 0, diffuse({1, 1, 1}));
  for (int i = 0; i < 14; ++i) {
    add_sphere(scene, {-1.6 + 0.25 * i, -0.42, 0.8 + 0.1 * (i % 3)}, 0.08,
               i % 2 ? diffuse({0.7, 0.7, 0.2}) : specular({0.9, 0.6, 0.5}, 0.05 * i));
  }
  return scene;
}

Scene moving_scene() {
  Scene scene = rich_scene();
  scene.shifts.assign(scene.spheres.size(), Vec3{});
  scene.shifts[4] = {0, 0.4, 0};
  scene.shifts[9] = {-0.3, 0, 0.2};
  return scene;
}

/// Only features of the smallest instantiation of the kernel.
Scene plain_scene() {
  Scene scene = beam_scene({0, 0, 4}, {0, 0, 0}, LinearRgb{0.7});
  add_sphere(scene, {0, -100.5, 0}, 100, diffuse({0.5, 0.6, 0.3}));
  add_sphere(scene, {0, 0, 0}, 0.5, diffuse({0.8, 0.2, 0.3}));
  return scene;
}

Scene metal_scene() {
  Scene scene = plain_scene();
  add_sphere(scene, {1, 0, 0}, 0.5, specular({0.8, 0.9, 0.3}, 0.3));
  return scene;
}

Scene scene_from_a_surface() {
  Scene scene = rich_scene();
  put_camera_on_a_surface(scene);
  return scene;
}

Scene scene_above_a_large_ground() {
  Scene scene = balls_above_a_large_ground();
  scene.background = {};
  return scene;
}

Scene moving_above_a_large_ground() {
  Scene scene = scene_above_a_large_ground();
  scene.shifts.assign(scene.spheres.size(), Vec3{});
  scene.shifts[3] = {0, 0.4, 0};
  return scene;
}

const std::vector<std::pair<const char*, Scene>>& scenes() {
  static const std::vector<std::pair<const char*, Scene>> all{
      {"rich", rich_scene()},
      {"moving", moving_scene()},
      {"plain", plain_scene()},
      {"metal", metal_scene()},
      {"from a surface", scene_from_a_surface()},
      {"above a large ground", scene_above_a_large_ground()},
      {"moving above a large ground", moving_above_a_large_ground()}};
  return all;
}

// 150 samples: two whole blocks of 64 and a part of one.
constexpr RenderSettings kSettings{.width = 42, .height = 28, .samples = 150, .depth = 12};

class WidePaths : public testing::TestWithParam<WideForm> {};

TEST_P(WidePaths, AreThoseOfTheReference) {
  for (const auto& [name, scene] : scenes()) {
    const RenderResult reference = render_by_reference(scene, kSettings);
    const RenderResult wide = render_with(scene, kSettings, GetParam().request());
    ASSERT_EQ(wide.kernel.search, Search::All);
    EXPECT_EQ(wide.nonfinite_samples, 0u);
    EXPECT_EQ(wide.camera_samples, reference.camera_samples);

    EstimateBuilder differences;
    double largest = 0;
    for (std::size_t i = 0; i < wide.picture.pixels.size(); ++i) {
      const LinearRgb ours = wide.picture.pixels[i], theirs = reference.picture.pixels[i];
      differences.add(ours - theirs);
      largest = std::max(largest, difference(ours, theirs));
    }
    if (GetParam().precision == Precision::Double) {
      // Rounding differs, but no path diverges.
      EXPECT_LT(largest, 1e-9) << name;
      EXPECT_EQ(wide.rays, reference.rays) << name;
      EXPECT_EQ(wide.truncated_paths, reference.truncated_paths) << name;
    } else {
      // Some paths diverge where float rounds a choice differently. H0: their radiance has the same
      // expectation, except for 1e-6 by which float may round colours. Significance 1e-5 for each
      // scene.
      Estimate estimate = differences.estimate();
      if (difference(estimate.mean, LinearRgb{}) <= 1e-6) estimate.mean = LinearRgb{};
      EXPECT_TRUE(agrees(estimate, LinearRgb{}, 1e-5)) << name;
      EXPECT_LT(estimate.standard_error.g, 1e-3) << name;
    }
  }
}

TEST_P(WidePaths, HitTheFirstSurfacesOfTheReference) {
  for (const auto& [name, scene] : scenes()) {
    const RenderSettings settings{
        .width = 60, .height = 40, .samples = 8, .depth = 3, .keeps_first_hits = true};
    render::RenderMonitor monitor;
    render::KernelRequest request = GetParam().request();
    const auto features = render::render(scene, settings, monitor, request).features;
    request.search = Search::Bvh;
    const auto by_bvh = render::render(scene, settings, monitor, request).features;
    const auto expected = render_by_reference(scene, settings).features;
    ASSERT_EQ(features.size(), expected.size());
    const bool is_double = GetParam().precision == Precision::Double;
    const double tolerance = is_double ? 1e-8 : 1e-3;
    int differing = 0;
    for (std::size_t i = 0; i < features.size(); ++i) {
      const render::PixelFeatures &a = features[i], &b = expected[i];
      ASSERT_EQ(a, by_bvh[i]) << name;
      const double difference =
          std::max({length(a.normal - b.normal), std::fabs(a.depth / b.depth - 1),
                    std::fabs(a.albedo.r - b.albedo.r), std::fabs(a.albedo.g - b.albedo.g),
                    std::fabs(a.albedo.b - b.albedo.b)});
      differing += difference <= tolerance ? 0 : 1;
    }
    // In float, rays at the edge of a sphere may miss it, and the normal there is off by the root
    // of the rounding error: a thousandth.
    EXPECT_LE(differing, is_double ? 0 : 12) << name;
  }
}

TEST_P(WidePaths, GiveTheSameBytesForAnyNumberOfThreads) {
  RenderSettings settings = kSettings;
  settings.threads = 1;
  const RenderResult expected = render_with(moving_scene(), settings, GetParam().request());
  for (const int threads : {2, 7}) {
    settings.threads = threads;
    const RenderResult result = render_with(moving_scene(), settings, GetParam().request());
    EXPECT_EQ(result.picture.pixels, expected.picture.pixels) << threads << " threads";
    EXPECT_EQ(result.rays, expected.rays);
    EXPECT_EQ(result.truncated_paths, expected.truncated_paths);
  }
}

TEST_P(WidePaths, DoNotDependOnTheScaleOfTheWorld) {
  const RenderSettings settings{.width = 24, .height = 16, .samples = 8, .depth = 8};
  const Picture expected = render_with(rich_scene(), settings, GetParam().request()).picture;
  for (const int exponent : {60, -60}) {
    const Scene scene = scaled(rich_scene(), exponent);
    EXPECT_EQ(render_with(scene, settings, GetParam().request()).picture.pixels, expected.pixels);
  }
}

TEST_P(WidePaths, LookThroughPixelCentresWithOneSample) {
  Scene scene = beam_scene({0, 0, 0}, {0, 0, -1}, LinearRgb{});
  add_sphere(scene, {0.25, 0.25, -1}, 1e-4, unlit({1, 1, 1}));
  const Picture picture =
      render_with(scene, {.width = 2, .height = 2, .samples = 1, .depth = 1}, GetParam().request())
          .picture;
  EXPECT_EQ(picture.at(1, 0), LinearRgb{1});
  EXPECT_EQ(picture.at(0, 0), LinearRgb{});
  EXPECT_EQ(picture.at(1, 1), LinearRgb{});
}

TEST_P(WidePaths, LeaveSamplesOutThatAreNotFinite) {
  Scene scene = beam_scene({0, 0, 0}, {0, 0, -1}, LinearRgb{0.5});
  scene.camera.plane_height = 2;
  add_sphere(scene, {-1.5, 0, -1}, 1, emissive({1e300, 1, 1}, 1e300));
  const RenderResult result = render_with(
      scene, {.width = 32, .height = 32, .samples = 64, .depth = 1}, GetParam().request());
  EXPECT_GT(result.nonfinite_samples, 10000u);
  EXPECT_LT(result.nonfinite_samples, 40000u);
  EXPECT_EQ(result.picture.at(0, 16), LinearRgb{});
  EXPECT_EQ(result.picture.at(31, 16), LinearRgb{0.5});
}

TEST_P(WidePaths, EndEarlyWhenTheRenderIsCancelled) {
  // Without checking the flag inside a path it would take hours.
  Scene closed = beam_scene({0, 0, 0}, {0, 0, -1}, LinearRgb{});
  add_sphere(closed, {0, 0, 0}, 1, diffuse({1, 1, 1}));
  render::RenderMonitor monitor;
  std::thread canceller;
  monitor.on_tracing = [&] {
    canceller = std::thread([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));  // in the middle of the path
      monitor.cancel = true;
    });
  };
  const RenderSettings settings{.width = 8, .height = 8, .samples = 1, .depth = 1'000'000'000};
  EXPECT_FALSE(render::render(closed, settings, monitor, GetParam().request()).is_complete);
  canceller.join();
}

INSTANTIATE_TEST_SUITE_P(Forms, WidePaths, testing::ValuesIn(wide_forms()), form_name);

// Square roots and quotients are rounded correctly, and no reciprocal estimates are used: the same
// bits from every instruction set that fuses multiplication and addition.
TEST(WideKernel, GivesTheSameBytesWithAllInstructionSetsThatFuse) {
  expect_same_bytes(scenes(), kSettings);
}

}  // namespace
}  // namespace sdlc::test
