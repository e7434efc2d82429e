#include <cstddef>
#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

#include "render/tiles/render.hpp"
#include "tests/support/statistics/scenes.hpp"

namespace sdlc::render {
namespace {

Scene sphere_under_the_sky() {
  Scene scene = test::beam_scene({0, 0, 4}, {0, 0, 0}, LinearRgb{1});
  scene.background = {};
  test::add_sphere(scene, {0, 0, 0}, 1, test::diffuse({0.7, 0.5, 0.2}));
  test::add_sphere(scene, {0, -101, 0}, 100, test::diffuse({0.5, 0.5, 0.5}));
  return scene;
}

/// A lamp that hardly any path from the floor finds by itself, in the dark.
Scene tiny_lamp() {
  Scene scene = test::beam_scene({0, 1, 4}, {0, -0.5, 0}, LinearRgb{0});
  test::add_sphere(scene, {0, -101, 0}, 100, test::diffuse({0.5, 0.5, 0.5}));
  test::add_sphere(scene, {0, 30, 0}, 1e-4, test::emissive({1, 1, 1}, 1e10));
  return scene;
}

constexpr RenderSettings kSmall{.width = 40, .height = 30, .samples = 1 << 16, .depth = 6};

RenderResult rendered(const Scene& scene, const RenderSettings& settings) {
  RenderMonitor monitor;
  return render(scene, settings, monitor);
}

TEST(GoalForTheError, IsTheSameForAnyNumberOfThreads) {
  for (const bool is_adaptive : {false, true}) {
    RenderSettings settings = kSmall;
    settings.error = 0.006;
    settings.is_adaptive = is_adaptive;
    settings.threads = 1;
    const RenderResult expected = rendered(sphere_under_the_sky(), settings);
    ASSERT_TRUE(expected.has_reached_error);
    for (const int threads : {2, 5}) {
      settings.threads = threads;
      const RenderResult result = rendered(sphere_under_the_sky(), settings);
      EXPECT_EQ(result.picture.pixels, expected.picture.pixels) << threads << " threads";
      EXPECT_EQ(result.error->relative_error, expected.error->relative_error);
      EXPECT_EQ(result.samples_of_pixels, expected.samples_of_pixels);
    }
  }
}

TEST(GoalForTheError, EndsWithTheMostSamplesAndSaysSo) {
  for (const bool is_adaptive : {false, true}) {
    for (const int most : {4, 10, 101}) {
      RenderSettings settings = kSmall;
      settings.error = 1e-6;
      settings.is_adaptive = is_adaptive;
      settings.samples = most;
      const RenderResult result = rendered(sphere_under_the_sky(), settings);
      EXPECT_EQ(result.most_samples, static_cast<std::uint64_t>(most));
      EXPECT_FALSE(result.has_reached_error);
      EXPECT_EQ(result.error.has_value(), most >= 8);
    }
  }
}

TEST(GoalForTheError, IsReachedAtOnceWhereThereIsNoNoise) {
  RenderSettings settings = kSmall;
  settings.error = 1e-9;
  const RenderResult black =
      rendered(test::beam_scene({0, 0, 4}, {0, 0, 0}, LinearRgb{0}), settings);
  EXPECT_TRUE(black.has_reached_error);
  EXPECT_LE(black.most_samples, 32u);
  EXPECT_EQ(black.error->relative_error, 0);
  settings.width = settings.height = 1;
  EXPECT_TRUE(
      rendered(test::beam_scene({0, 0, 4}, {0, 0, 0}, LinearRgb{1}), settings).has_reached_error);
}

// False convergence: nothing differs, as nothing was found.
TEST(GoalForTheError, IsNotReachedWhereALampWasHardlyMet) {
  RenderSettings settings = kSmall;
  settings.error = 0.02;
  settings.light_sampling = LightSampling::Off;
  const RenderResult result = rendered(tiny_lamp(), settings);
  ASSERT_EQ(result.scarce_emitters.size(), 1u);
  EXPECT_EQ(result.scarce_emitters[0].sphere, 1u);
  EXPECT_FALSE(result.has_reached_error);
  EXPECT_FALSE(result.error);
  settings.light_sampling = LightSampling::Auto;
  const RenderResult lit = rendered(tiny_lamp(), settings);
  EXPECT_TRUE(lit.has_reached_error);
  EXPECT_TRUE(lit.scarce_emitters.empty());
  EXPECT_GT(lit.error->mean, 0);
}

TEST(GoalForTime, GivesEveryPixelASampleHoweverShortItIs) {
  RenderSettings settings = kSmall;
  settings.seconds = 1e-9;
  const RenderResult result = rendered(sphere_under_the_sky(), settings);
  EXPECT_TRUE(result.is_complete);
  EXPECT_EQ(result.least_samples, 1u);
  EXPECT_EQ(result.camera_samples, 40u * 30);
  EXPECT_FALSE(result.error);
}

TEST(GoalForTime, CountsTheSamplesOfEachPixel) {
  RenderSettings settings = kSmall;
  settings.width = 400;
  settings.height = 300;
  settings.seconds = 0.1;
  settings.keeps_variance = true;
  const RenderResult result = rendered(sphere_under_the_sky(), settings);
  std::uint64_t samples = 0;
  const std::size_t pixels = result.picture.pixels.size();
  for (std::size_t i = 0; i < pixels; ++i) {
    samples += result.samples_of_pixels.empty() ? result.most_samples : result.samples_of_pixels[i];
  }
  EXPECT_EQ(samples, result.camera_samples);
  EXPECT_EQ(result.variance.pixels.size(), result.error ? pixels : 0);
}

TEST(Goals, EndSoonWhenTheyAreCancelled) {
  for (const bool is_adaptive : {false, true}) {
    RenderSettings settings = kSmall;
    settings.samples = 1 << 24;
    settings.error = 1e-9;
    settings.is_adaptive = is_adaptive;
    RenderMonitor monitor;
    std::thread canceller([&] {
      while (monitor.samples_done.load() < 40u * 30 * 500) std::this_thread::yield();
      monitor.cancel = true;
    });
    const RenderResult result = render(sphere_under_the_sky(), settings, monitor);
    canceller.join();
    EXPECT_FALSE(result.is_complete);
    EXPECT_GE(result.least_samples, 32u);
    for (const LinearRgb& pixel : result.picture.pixels) EXPECT_FALSE(is_black(pixel));
  }
}

TEST(Render, TellsOfNoSamplesThatACancelledRenderDoesNotHave) {
  RenderMonitor monitor;
  monitor.on_tracing = [&] { monitor.cancel = true; };
  const RenderResult result = render(sphere_under_the_sky(), kSmall, monitor);
  EXPECT_EQ(result.least_samples, 0u);
  EXPECT_FALSE(result.error);
}

}  // namespace
}  // namespace sdlc::render
