#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <gtest/gtest.h>

#include "render/kernel/backend.hpp"
#include "render/session/render.hpp"
#include "tests/render/session/relative_difference.hpp"
#include "tests/support/statistics/scenes.hpp"

namespace sdlc::render {
namespace {

/// A ground, balls of three materials and a lamp.
Scene balls() {
  Scene scene = test::beam_scene({0, 1, 4}, {0, 0, 0}, LinearRgb{0.5});
  scene.camera.aspect = 4.0 / 3;
  scene.camera.plane_height = 0.8;
  test::add_sphere(scene, {0, -100.5, 0}, 100, test::diffuse({0.5, 0.6, 0.3}));
  test::add_sphere(scene, {-1, 0, 0}, 0.5, test::specular({0.8, 0.8, 0.6}, 0.2));
  test::add_sphere(scene, {1, 0, 0}, 0.5, test::diffuse({0.9, 0.2, 0.1}));
  test::add_sphere(scene, {0, 1, -1}, 0.4, test::emissive({1, 0.9, 0.8}, 5));
  return scene;
}

constexpr RenderSettings kDenoised{.width = 80,
                                   .height = 60,
                                   .samples = 16,
                                   .depth = 8,
                                   .light_sampling = LightSampling::Off,
                                   .is_denoised = true};

RenderSettings plain(RenderSettings settings) {
  settings.is_denoised = false;
  return settings;
}

RenderResult rendered(const Scene& scene, const RenderSettings& settings) {
  RenderMonitor monitor;
  return render(scene, settings, monitor);
}

TEST(DenoisedRender, HasTheErrorThatItStates) {
  RenderSettings settings = plain(kDenoised);
  settings.samples = 1 << 14;
  settings.seed = 77;
  const Picture reference = rendered(balls(), settings).picture;
  int covered = 0;
  constexpr int kSeeds = 60;
  for (int seed = 0; seed < kSeeds; ++seed) {
    settings = kDenoised;
    settings.seed = static_cast<std::uint64_t>(seed);
    const RenderResult result = rendered(balls(), settings);
    ASSERT_TRUE(result.error && result.plain_error);
    EXPECT_LT(result.error->relative_error, 0.7 * result.plain_error->relative_error);
    const double error = test::relative_difference(result.picture, reference);
    covered += result.error->interval.from <= error && error <= result.error->interval.to;
  }
  // 95 %, less 4 binomial standard errors.
  EXPECT_GE(covered, 0.83 * kSeeds);
}

TEST(DenoisedRender, HasTheErrorThatItStatesInAFewPixels) {
  Scene matt = test::beam_scene({0, 1, 4}, {0, 0, 0}, LinearRgb{0.5});
  matt.camera.aspect = 4.0 / 3;
  matt.camera.plane_height = 0.8;
  test::add_sphere(matt, {0, -100.5, 0}, 100, test::diffuse({0.5, 0.6, 0.3}));
  test::add_sphere(matt, {0.3, 0, 0}, 0.5, test::diffuse({0.9, 0.2, 0.1}));
  RenderSettings few = kDenoised;
  few.crop = PixelWindow{.x = 30, .y = 45, .width = 4, .height = 3};  // on the ground
  few.samples = 8;
  RenderSettings settings = plain(few);
  settings.samples = 1 << 18;
  settings.seed = 77;
  const Picture reference = rendered(matt, settings).picture;
  int denoised = 0, above = 0;
  for (int seed = 0; seed < 300; ++seed) {
    settings = few;
    settings.seed = static_cast<std::uint64_t>(seed);
    const RenderResult result = rendered(matt, settings);
    if (!result.plain_error) continue;
    ++denoised;
    EXPECT_LT(result.error->interval.from, result.error->interval.to) << seed;
    above += test::relative_difference(result.picture, reference) > result.error->interval.to;
  }
  ASSERT_GT(denoised, 100);
  // 5 %, and 4 binomial standard errors.
  EXPECT_LE(above, 0.05 * denoised + 4 * std::sqrt(0.05 * 0.95 * denoised));
}

TEST(DenoisedRender, TracesTheSamePaths) {
  const RenderResult expected = rendered(balls(), plain(kDenoised));
  const RenderResult result = rendered(balls(), kDenoised);
  EXPECT_EQ(result.plain_error->relative_error, expected.error->relative_error);
  EXPECT_EQ(result.rays, expected.rays);
  EXPECT_NE(result.picture.pixels, expected.picture.pixels);
}

TEST(DenoisedRender, IsTheSameForAnyNumberOfThreadsAndFusedInstructionSet) {
  for (const std::optional<double> goal : {std::optional<double>(), std::optional<double>(0.03)}) {
    RenderSettings settings = kDenoised;
    settings.error = goal;
    std::optional<RenderResult> expected;
    for (const Backend* backend : available_vectors()) {
      if (!backend->is_fused) continue;
      for (const int threads : {1, 3}) {
        settings.threads = threads;
        RenderMonitor monitor;
        RenderResult result = render(balls(), settings, monitor, {.backend = backend});
        ASSERT_TRUE(result.plain_error);
        if (!expected) expected = result;
        EXPECT_EQ(result.picture.pixels, expected->picture.pixels)
            << backend->name << ", " << threads << " threads";
        EXPECT_EQ(result.error->relative_error, expected->error->relative_error);
      }
    }
  }
}

TEST(DenoisedRender, ReachesAnErrorWithFewerSamples) {
  RenderSettings settings = kDenoised;
  settings.samples = 1 << 16;
  settings.error = 0.05;
  const RenderResult denoised = rendered(balls(), settings);
  const RenderResult as_traced = rendered(balls(), plain(settings));
  EXPECT_TRUE(denoised.has_reached_error);
  EXPECT_LE(denoised.error->interval.to, 0.05);
  EXPECT_GT(denoised.plain_error->interval.to, 0.05);
  EXPECT_LT(static_cast<double>(denoised.max_samples),
            0.7 * static_cast<double>(as_traced.max_samples));
}

TEST(DenoisedRender, IsPlainWithTooFewSamples) {
  RenderSettings settings = kDenoised;
  settings.samples = 7;
  const RenderResult result = rendered(balls(), settings);
  EXPECT_FALSE(result.plain_error);
  EXPECT_EQ(result.picture.pixels, rendered(balls(), plain(settings)).picture.pixels);
}

TEST(DenoisedRender, IsPlainWhereThereIsNoNoise) {
  for (const double radiance : {0.0, 1.0}) {
    const Scene scene = test::beam_scene({0, 0, 4}, {0, 0, 0}, LinearRgb{radiance});
    const RenderResult result = rendered(scene, kDenoised);
    EXPECT_FALSE(result.plain_error);
    EXPECT_EQ(result.error->relative_error, 0);
    EXPECT_EQ(result.picture.pixels, rendered(scene, plain(kDenoised)).picture.pixels);
  }
}

// A filter cannot know of light that no sample has seen.
TEST(DenoisedRender, IsPlainWhereTheErrorIsUnknown) {
  Scene scene = test::beam_scene({0, 1.5, 6}, {0, 0.5, 0}, LinearRgb{0});
  test::add_sphere(scene, {0, -1000, 0}, 1000, test::diffuse(LinearRgb{0.5}));
  test::add_sphere(scene, {0, 0.8, 0}, 0.5, test::transmissive(LinearRgb{1}, 1.5));
  test::add_sphere(scene, {-1.4, 2.2, 0.4}, 0.01, test::emissive(LinearRgb{1}, 20000));
  RenderSettings settings = kDenoised;
  settings.light_sampling = LightSampling::On;
  for (const std::optional<double> goal : {std::optional<double>(), std::optional<double>(0.02)}) {
    settings.error = goal;
    const RenderResult result = rendered(scene, settings);
    EXPECT_FALSE(result.rare_paths.empty());
    EXPECT_FALSE(result.has_reached_error);
    EXPECT_FALSE(result.plain_error);
    EXPECT_FALSE(result.error);
    EXPECT_EQ(result.picture.pixels, rendered(scene, plain(settings)).picture.pixels);
  }
}

}  // namespace
}  // namespace sdlc::render
