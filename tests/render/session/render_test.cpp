#include "render/session/render.hpp"

#include <cstring>
#include <thread>

#include <gtest/gtest.h>

#include "tests/support/statistics/scaled_scene.hpp"
#include "tests/support/statistics/scenes.hpp"

namespace sdlc::render {
namespace {

/// Every material, a gradient and motion.
Scene rich_scene() {
  Scene scene = test::beam_scene({0, 1, 4}, {0, 0, 0}, LinearRgb{1});
  scene.background = {};
  scene.camera.aspect = 1.5;
  scene.camera.plane_height = 1.2;
  test::add_sphere(scene, {0, -100.5, 0}, 100, test::diffuse({0.5, 0.6, 0.3}));
  test::add_sphere(scene, {-1, 0, 0}, 0.5, test::specular({0.8, 0.8, 0.6}, 0.2));
  test::add_sphere(scene, {0, 0, 0}, 0.5, test::transmissive({1, 1, 1}, 1.5));
  test::add_sphere(scene, {1, 0, 0}, 0.5, test::diffuse({0.9, 0.2, 0.1}));
  test::add_sphere(scene, {0.5, 1, -1}, 0.3, test::emissive({1, 0.9, 0.8}, 5));
  test::add_sphere(scene, {-0.5, 0.8, 0.5}, 0.1, test::unlit({0.1, 0.3, 0.9}));
  scene.shifts.assign(scene.spheres.size(), Vec3{});
  scene.shifts[3] = {0, 0.4, 0};
  return scene;
}

RenderResult render_with_threads(int threads, int samples = 80) {
  RenderMonitor monitor;
  const RenderSettings settings{
      .width = 75, .height = 50, .samples = samples, .depth = 8, .seed = 5, .threads = threads};
  return render(rich_scene(), settings, monitor);
}

TEST(Render, GivesTheSameBytesForAnyNumberOfThreads) {
  const RenderResult expected = render_with_threads(1);
  for (const int threads : {2, 7}) {
    const RenderResult result = render_with_threads(threads);
    EXPECT_EQ(std::memcmp(result.picture.pixels.data(), expected.picture.pixels.data(),
                          expected.picture.pixels.size() * sizeof(LinearRgb)),
              0)
        << threads << " threads";
    EXPECT_EQ(result.rays, expected.rays);
    EXPECT_EQ(result.truncated_paths, expected.truncated_paths);
  }
}

TEST(Render, ChangesWithTheSeed) {
  RenderMonitor first, second;
  const RenderSettings settings{.width = 8, .height = 8, .samples = 4, .depth = 4, .seed = 1};
  RenderSettings other = settings;
  other.seed = 2;
  EXPECT_NE(render(rich_scene(), settings, first).picture.pixels,
            render(rich_scene(), other, second).picture.pixels);
}

TEST(Render, CountsWhatItTraced) {
  const RenderResult result = render_with_threads(2);
  EXPECT_TRUE(result.is_complete);
  EXPECT_EQ(result.camera_samples, 75u * 50 * 80);
  EXPECT_GE(result.rays, result.camera_samples);
  EXPECT_GT(result.truncated_paths, 0u);
  EXPECT_EQ(result.nonfinite_samples, 0u);
}

TEST(Render, PutsTheTopOfTheViewIntoTheFirstRow) {
  Scene scene = test::beam_scene({0, 0, 0}, {0, 0, -1}, LinearRgb{});
  scene.background = {.bottom = {0, 0, 0}, .top = {1, 1, 1}};
  RenderMonitor monitor;
  const Picture picture =
      render(scene, {.width = 3, .height = 9, .samples = 1, .depth = 1}, monitor).picture;
  EXPECT_GT(picture.at(1, 0).r, picture.at(1, 4).r);
  EXPECT_GT(picture.at(1, 4).r, picture.at(1, 8).r);
}

TEST(Render, PutsTheRightOfTheViewIntoTheLastColumn) {
  Scene scene = test::beam_scene({0, 0, 0}, {0, 0, -1}, LinearRgb{});
  test::add_sphere(scene, {0.3, 0, -1}, 0.1, test::unlit({1, 1, 1}));
  RenderMonitor monitor;
  const Picture picture =
      render(scene, {.width = 9, .height = 9, .samples = 1, .depth = 1}, monitor).picture;
  EXPECT_EQ(picture.at(7, 4), LinearRgb{1});
  EXPECT_EQ(picture.at(1, 4), LinearRgb{});
}

TEST(Render, LooksThroughPixelCentresWithOneSample) {
  Scene scene = test::beam_scene({0, 0, 0}, {0, 0, -1}, LinearRgb{});
  // Covers the centre of the only pixel and nothing else.
  test::add_sphere(scene, {0, 0, -1}, 1e-6, test::unlit({1, 1, 1}));
  RenderMonitor monitor;
  EXPECT_EQ(
      render(scene, {.width = 1, .height = 1, .samples = 1, .depth = 1}, monitor).picture.at(0, 0),
      LinearRgb{1});
}

TEST(Render, ReturnsSoonWhenItIsCancelled) {
  RenderMonitor monitor;
  // The first finished pixel cancels the rest, from another thread as Ctrl-C does.
  std::thread canceller([&] {
    while (monitor.samples_done.load() == 0) std::this_thread::yield();
    monitor.cancel = true;
  });
  const RenderResult result =
      render(rich_scene(), {.width = 4000, .height = 4000, .samples = 64, .depth = 8}, monitor);
  canceller.join();
  EXPECT_FALSE(result.is_complete);
  EXPECT_GT(result.camera_samples, 0u);
  EXPECT_LT(result.camera_samples, 4000u * 4000 * 64);
}

TEST(Render, EndsALongPixelAndALongPathWhenItIsCancelled) {
  // Without checking the flag inside a pixel, and inside a path, either would take hours.
  Scene closed = test::beam_scene({0, 0, 0}, {0, 0, -1}, LinearRgb{});
  test::add_sphere(closed, {0, 0, 0}, 1, test::diffuse({1, 1, 1}));
  for (const RenderSettings& settings :
       {RenderSettings{.width = 1, .height = 1, .samples = 1'000'000'000, .depth = 1000},
        RenderSettings{.width = 1, .height = 1, .samples = 1, .depth = 1'000'000'000}}) {
    RenderMonitor monitor;
    std::thread canceller;
    monitor.on_tracing = [&] { canceller = std::thread([&] { monitor.cancel = true; }); };
    EXPECT_FALSE(render(closed, settings, monitor).is_complete);
    canceller.join();
  }
}

// A scene scaled by a power of two, or moved so far that its coordinates are still exact, is the
// same scene.
TEST(Render, DoesNotDependOnTheScaleOfTheWorld) {
  const auto picture = [](int exponent) {
    RenderMonitor monitor;
    return render(test::scaled(rich_scene(), exponent),
                  {.width = 24, .height = 16, .samples = 8, .depth = 8}, monitor)
        .picture;
  };
  const Picture expected = picture(0);
  EXPECT_EQ(picture(60).pixels, expected.pixels);
  EXPECT_EQ(picture(-60).pixels, expected.pixels);
}

}  // namespace
}  // namespace sdlc::render
