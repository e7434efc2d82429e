#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "render/session/render.hpp"
#include "tests/render/session/relative_difference.hpp"
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

/// A lamp in the dark that almost no path from the floor finds by scattering.
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
      EXPECT_EQ(result.max_samples, static_cast<std::uint64_t>(most));
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
  EXPECT_LE(black.max_samples, 32u);
  EXPECT_EQ(black.error->relative_error, 0);
  settings.width = settings.height = 1;
  EXPECT_TRUE(
      rendered(test::beam_scene({0, 0, 4}, {0, 0, 0}, LinearRgb{1}), settings).has_reached_error);
}

TEST(GoalForTheError, IsNotReachedByABlackPictureOfPathsThatWereCutOff) {
  Scene room = test::beam_scene({0, 0, 0}, {0, 0, -1}, LinearRgb{1});
  test::add_sphere(room, {0, 0, 0}, 1, test::diffuse({0.7, 0.5, 0.2}));
  RenderSettings settings = kSmall;
  settings.samples = 32;
  for (const std::optional<double> goal : {std::optional<double>(), std::optional<double>(0.5)}) {
    settings.error = goal;
    const RenderResult result = rendered(room, settings);
    EXPECT_TRUE(is_black(result.picture.pixels[0]));
    EXPECT_FALSE(result.error);
    EXPECT_FALSE(result.has_reached_error);
  }
}

// False convergence: nothing differs, because nothing was found.
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

/// A ground, one small lamp that connections find, and a ball that makes a caustic of its light.
Scene caustic(const Material& ball, double lamp_radius) {
  Scene scene = test::beam_scene({0, 1.5, 6}, {0, 0.5, 0}, LinearRgb{0});
  scene.camera.plane_height = 0.54;
  scene.camera.aspect = 16.0 / 9;
  test::add_sphere(scene, {0, -1000, 0}, 1000, test::diffuse(LinearRgb{0.5}));
  test::add_sphere(scene, {0, 0.8, 0}, 0.5, ball);
  test::add_sphere(scene, {-1.4, 2.2, 0.4}, lamp_radius, test::emissive(LinearRgb{1}, 20000));
  return scene;
}

// Connections to lights carry no information about light through glass, which they cannot find.
TEST(GoalForTheError, IsNotReachedWhereNoPathFoundACaustic) {
  const Scene scenes[] = {caustic(test::transmissive(LinearRgb{1}, 1.5), 0.01),
                          caustic(test::transmissive(LinearRgb{0.8}, 1.3), 0.005),
                          caustic(test::specular(LinearRgb{1}, 0.02), 0.03),
                          caustic(test::specular(LinearRgb{0.9}, 0), 0.01)};
  for (const Scene& scene : scenes) {
    RenderSettings settings{
        .width = 96, .height = 54, .samples = 256, .light_sampling = LightSampling::On};
    settings.error = 0.02;
    const RenderResult result = rendered(scene, settings);
    EXPECT_EQ(result.sampled_lights, 1u);
    EXPECT_FALSE(result.has_reached_error);
    EXPECT_EQ(result.max_samples, 256u);
    EXPECT_NE(result.error.has_value(), !result.rare_paths.empty());
    // The error of the same picture without a goal is also unknown.
    settings.error.reset();
    settings.samples = 64;
    EXPECT_FALSE(rendered(scene, settings).error);
  }
}

// Directions in float are too coarse for the beams of such a lamp.
TEST(GoalForTheError, IsNotReachedWhereConnectionsCannotFindTheCaustic) {
  RenderSettings settings{
      .width = 96, .height = 54, .samples = 256, .light_sampling = LightSampling::Caustics};
  settings.error = 0.02;
  Scene scene = caustic(test::transmissive(LinearRgb{1}, 1.5), 1e-5);
  scene.materials.back().parameter = 2e10;
  const RenderResult result = rendered(scene, settings);
  EXPECT_EQ(result.kernel.casters.size(), 1u);
  EXPECT_FALSE(result.has_reached_error);
}

// Against a picture of another seed with four times as many samples, whose own error is included:
// the goal plus a quarter of its square.
TEST(GoalForTheError, IsReachedWhereConnectionsFindTheCaustic) {
  Scene glass = caustic(test::transmissive(LinearRgb{1}, 1.5), 0.1);
  glass.materials.back().parameter = 200;
  for (const Scene& scene : {glass, caustic(test::specular(LinearRgb{0.9}, 0), 0.01)}) {
    RenderSettings settings{
        .width = 32, .height = 18, .samples = 1 << 20, .light_sampling = LightSampling::Caustics};
    settings.error = 0.1;
    const RenderResult result = rendered(scene, settings);
    ASSERT_TRUE(result.has_reached_error);
    settings.error.reset();
    settings.samples = static_cast<int>(4 * result.max_samples);
    settings.seed = 99;
    EXPECT_LT(test::relative_difference(result.picture, rendered(scene, settings).picture),
              0.1 * std::sqrt(1.25));
  }
}

TEST(LightSamplingAuto, SamplesLightsWhereNothingElseFindsThem) {
  const RenderSettings settings{.width = 32, .height = 18, .samples = 8};
  const auto choice = [&](const Scene& scene) {
    return rendered(scene, settings).kernel.light_choice;
  };
  EXPECT_EQ(choice(caustic(test::transmissive(LinearRgb{1}, 1.5), 0.01)), "caustics, 1 light");
  EXPECT_EQ(choice(caustic(test::specular(LinearRgb{0.9}, 0), 0.01)), "caustics, 1 light");
  EXPECT_EQ(choice(caustic(test::specular(LinearRgb{0.9}, 0.02), 0.01)),
            "on, 1 light, also at metal");
  EXPECT_EQ(choice(caustic(test::specular(LinearRgb{0.9}, 0.02), 0.1)), "on, 1 light");
  EXPECT_EQ(choice(caustic(test::specular(LinearRgb{0.9}, 0.5), 0.1)),
            "on, 1 light, also at metal");
  EXPECT_EQ(choice(caustic(test::diffuse(LinearRgb{0.9}), 0.01)), "on, 1 light");
}

TEST(GoalForTheError, IsReachedWhereTheCausticWasFound) {
  // The lamp is so large that thousands of paths find it.
  Scene scene = caustic(test::transmissive(LinearRgb{1}, 1.5), 0.4);
  scene.materials.back().parameter = 12;
  RenderSettings settings{.width = 48, .height = 27, .samples = 1 << 14};
  settings.error = 0.05;
  const RenderResult result = rendered(scene, settings);
  EXPECT_TRUE(result.has_reached_error);
  EXPECT_TRUE(result.rare_paths.empty());
}

// Sobol' points spread evenly over a pixel, so each replicate hits a lamp smaller than the pixel
// equally often: the replicates agree, and each is off by a path. Of 30 seeds these 7 were
// certified with .005 % while the error was up to 922 %.
TEST(GoalForTheError, IsNotReachedWhereReplicatesAgreeOnALampSmallerThanAPixel) {
  Scene scene = test::beam_scene({0, 1, 6}, {0, 0.5, 0}, LinearRgb{0.2});
  scene.camera.plane_height = 2 * 0.364;  // of 40°
  scene.camera.aspect = 16.0 / 9;
  test::add_sphere(scene, {0, -100, 0}, 100, test::diffuse(LinearRgb{0.6}));
  test::add_sphere(scene, {0.3, 1.2, 0}, 0.0015, test::emissive(LinearRgb{1}, 100000));
  for (const std::uint64_t seed : {13, 14, 17, 20, 22, 23, 27}) {
    RenderSettings settings{.width = 96, .height = 54, .samples = 5000, .seed = seed};
    settings.error = 0.02;
    EXPECT_FALSE(rendered(scene, settings).has_reached_error) << seed;
  }
}

// The camera sees the lamp hundreds of times; without connections almost no path finds the surfaces
// that it lights.
TEST(GoalForTheError, IsNotReachedByALampThatIsOnlySeen) {
  Scene scene = caustic(test::diffuse(LinearRgb{0.5}), 0.003);
  scene.spheres.back().center = {0, 1.42, 5.5};
  RenderSettings settings{.width = 96, .height = 54, .samples = 64};
  settings.error = 1000;
  settings.light_sampling = LightSampling::Off;
  const RenderResult result = rendered(scene, settings);
  EXPECT_TRUE(result.scarce_emitters.empty());
  EXPECT_FALSE(result.error);
}

TEST(Passes, ThatAreShownDoNotChangeThePictureOrItsError) {
  const Scene scene = caustic(test::transmissive(LinearRgb{1}, 1.5), 0.3);
  for (const std::optional<double> error : {std::optional<double>(), std::optional(0.2)}) {
    RenderSettings settings{.width = 48, .height = 27, .samples = 100};
    settings.error = error;
    const RenderResult at_once = rendered(scene, settings);
    RenderMonitor monitor;
    monitor.shows_passes = true;
    std::vector<std::uint64_t> samples;
    ErrorSoFar last;
    monitor.on_pass = [&](const Film& film, const std::function<ErrorSoFar()>& error_so_far) {
      samples.push_back(film.sample_counts().min);
      last = error_so_far();
      EXPECT_TRUE(samples.back() >= kMinReplicatedSamples || !last.error);
    };
    const RenderResult shown = render(scene, settings, monitor);
    EXPECT_EQ(samples.front(), 1u);
    EXPECT_GT(samples.size(), 4u);
    EXPECT_EQ(samples.back(), at_once.max_samples);
    EXPECT_EQ(shown.picture.pixels, at_once.picture.pixels);
    ASSERT_TRUE(shown.error);
    EXPECT_EQ(shown.error->relative_error, at_once.error->relative_error);
    ASSERT_TRUE(last.error);
    EXPECT_EQ(last.error->interval.to, shown.error->interval.to);
  }
}

TEST(Passes, HaveNoErrorWhereRarePathsHideIt) {
  const Scene scene = caustic(test::transmissive(LinearRgb{1}, 1.5), 0.01);
  RenderSettings settings{
      .width = 96, .height = 54, .samples = 64, .light_sampling = LightSampling::On};
  RenderMonitor monitor;
  monitor.shows_passes = true;
  int passes = 0;  // with enough samples for an error
  monitor.on_pass = [&](const Film& film, const std::function<ErrorSoFar()>& error_so_far) {
    const ErrorSoFar known = error_so_far();
    EXPECT_FALSE(known.error);
    if (film.sample_counts().min < kMinReplicatedSamples) return;
    ++passes;
    EXPECT_FALSE(known.rare_paths.empty());
  };
  EXPECT_FALSE(render(scene, settings, monitor).error);
  EXPECT_GT(passes, 3);
}

TEST(GoalForTime, GivesEveryPixelASampleHoweverShortItIs) {
  RenderSettings settings = kSmall;
  settings.seconds = 1e-9;
  const RenderResult result = rendered(sphere_under_the_sky(), settings);
  EXPECT_TRUE(result.is_complete);
  EXPECT_EQ(result.min_samples, 1u);
  EXPECT_EQ(result.camera_samples, 40u * 30);
  EXPECT_FALSE(result.error);
}

TEST(GoalForTime, LeavesTheTimeToFinish) {
  RenderSettings settings = kSmall;
  settings.samples = 1 << 24;
  settings.seconds = 1;
  int calls = 0, later_passes = 0;
  bool has_picture = false;
  RenderMonitor monitor;
  monitor.seconds_to_finish = [&](const Picture& picture) {
    ++calls;
    has_picture = picture.at(20, 15).g > 0;
    return 2.0;
  };
  monitor.on_pass = [&](const Film&, const auto& /*error*/) { later_passes += calls; };
  const RenderResult result = render(choose_kernel(sphere_under_the_sky(), settings),
                                     sphere_under_the_sky(), settings, monitor);
  EXPECT_TRUE(result.is_complete);
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE(has_picture);
  EXPECT_EQ(later_passes, 1);  // the one after which it was called
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
    samples += result.samples_of_pixels.empty() ? result.max_samples : result.samples_of_pixels[i];
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
    EXPECT_GE(result.min_samples, 32u);
    for (const LinearRgb& pixel : result.picture.pixels) EXPECT_FALSE(is_black(pixel));
  }
}

TEST(Render, TellsOfNoSamplesThatACancelledRenderDoesNotHave) {
  RenderMonitor monitor;
  monitor.on_tracing = [&] { monitor.cancel = true; };
  const RenderResult result = render(sphere_under_the_sky(), kSmall, monitor);
  EXPECT_EQ(result.min_samples, 0u);
  EXPECT_FALSE(result.error);
}

}  // namespace
}  // namespace sdlc::render
