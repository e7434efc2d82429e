#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "render/image/picture.hpp"
#include "tests/extremes/forms.hpp"
#include "tests/extremes/scenes.hpp"
#include "tests/support/statistics/estimate.hpp"
#include "tests/support/statistics/scaled_scene.hpp"

// Pictures that must be equal, to the bit or except for noise.
namespace sdlc::test {
namespace {

using render::LinearRgb;
using render::Picture;
using render::Precision;
using render::RenderResult;
using render::RenderSettings;
using render::Scene;
using render::Vec3;

constexpr RenderSettings kSmall{
    .width = 24, .height = 16, .samples = 8, .depth = 12, .seed = 3, .threads = 2};

class Pictures : public testing::TestWithParam<Form> {
 protected:
  Picture picture(const Scene& scene, const RenderSettings& settings = kSmall) const {
    const RenderResult result = render_in(GetParam(), scene, settings);
    EXPECT_EQ(result.nonfinite_samples, 0u);
    return result.picture;
  }
};

Scene moving_field() {
  Scene scene = field_scene();
  scene.shifts.assign(scene.spheres.size(), Vec3{});
  scene.shifts[2] = {0, 0.4, 0};
  scene.shifts[9] = {-0.3, 0, 0.25};
  return scene;
}

TEST_P(Pictures, AreTheSameBytesAtEveryScaleThatIsAPowerOfTwo) {
  for (const Scene& scene : {field_scene(), moving_field()}) {
    const Picture expected = picture(scene);
    for (const int exponent : {60, -60, 1, -1, 100, -100, 300, -300, 900, -900}) {
      EXPECT_EQ(picture(scaled(scene, exponent)).pixels, expected.pixels) << "2^" << exponent;
    }
  }
}

/// Coordinates that are exact after a shift by 1e8: multiples of 2^-20.
Scene coarse(Scene scene) {
  const auto round = [](Vec3& v) {
    for (double* c : {&v.x, &v.y, &v.z}) *c = std::nearbyint(*c * 0x1p20) * 0x1p-20;
  };
  round(scene.camera.from);
  round(scene.camera.at);
  for (render::Sphere& sphere : scene.spheres) round(sphere.center);
  return scene;
}

TEST_P(Pictures, AreTheSameBytesWhereverTheSceneIs) {
  const Scene scene = coarse(field_scene());
  const Picture expected = picture(scene);
  for (const Vec3 offset : {Vec3{1e8, 0, 0}, Vec3{-1e8, 1e8, 3e7}, Vec3{0, 1 << 29, 7}}) {
    EXPECT_EQ(picture(moved(scene, offset)).pixels, expected.pixels);
  }
}

/// H0: two pictures have the same expectation, pixel by pixel over all channels. The pictures'
/// random numbers differ. A z-test on the mean difference.
testing::AssertionResult differ_by_noise_only(const Picture& a, const Picture& b) {
  EstimateBuilder differences;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) differences.add(a.pixels[i] - b.pixels[i]);
  return agrees(differences.estimate(), LinearRgb{}, 1e-4);
}

TEST_P(Pictures, DifferByNoiseOnlyFromThoseOfAMovedScene) {
  RenderSettings settings = kSmall;
  settings.samples = 64;
  const Picture expected = picture(field_scene(), settings);
  settings.seed = 99;
  // At 1e12 coordinates are rounded to 1.2e-4.
  for (const double offset : {1e3, 1e7, 1e12}) {
    const Scene there = moved(field_scene(), {offset, -offset, offset});
    if (!may_trace(GetParam(), there, settings)) continue;
    EXPECT_TRUE(differ_by_noise_only(picture(there, settings), expected)) << "offset " << offset;
  }
}

TEST_P(Pictures, AreTheSameBytesForAnyNumberOfThreads) {
  RenderSettings settings{.width = 53, .height = 37, .samples = 70, .depth = 12, .threads = 1};
  const Scene scene = moving_field();
  const RenderResult expected = render_in(GetParam(), scene, settings);
  for (const int threads : {2, 3, 8}) {
    settings.threads = threads;
    const RenderResult result = render_in(GetParam(), scene, settings);
    EXPECT_EQ(result.picture.pixels, expected.picture.pixels) << threads << " threads";
    EXPECT_EQ(result.rays, expected.rays);
    EXPECT_EQ(result.truncated_paths, expected.truncated_paths);
  }
}

TEST_P(Pictures, AreOfExactlyTheSizeThatIsAskedFor) {
  const Scene scene = field_scene();
  for (const auto& [width, height] : {std::pair{1, 1}, {100'000, 1}, {1, 3000}, {17, 5}}) {
    RenderSettings settings{.width = width, .height = height, .samples = 1, .depth = 4};
    const RenderResult result = render_in(GetParam(), scene, settings);
    ASSERT_EQ(result.picture.pixels.size(),
              static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    EXPECT_EQ(result.nonfinite_samples, 0u);
    EXPECT_TRUE(std::all_of(result.picture.pixels.begin(), result.picture.pixels.end(),
                            [](LinearRgb c) { return is_finite(c); }));
  }
}

TEST_P(Pictures, OfOneSampleShowWhatIsInTheMiddleOfEachPixel) {
  Scene scene = beam_scene({0, 0, 0}, {0, 0, -1}, LinearRgb{});
  add_sphere(scene, {0.25, 0.25, -1}, 1e-3, unlit({1, 1, 1}));
  const Picture two = picture(scene, {.width = 2, .height = 2, .samples = 1, .depth = 1});
  EXPECT_EQ(two.at(1, 0), LinearRgb{1});
  EXPECT_EQ(two.at(0, 0), LinearRgb{});
  EXPECT_EQ(two.at(1, 1), LinearRgb{});
}

INSTANTIATE_TEST_SUITE_P(Forms, Pictures, testing::ValuesIn(all_forms()), form_name);

// H0: the same expectation. Paths use the same random numbers and diverge only where float rounds a
// choice differently, so there are few differences. Significance 1e-4.
TEST(FloatAgainstDouble, DiffersByNothingButNoise) {
  const RenderSettings settings{.width = 96, .height = 64, .samples = 128, .depth = 16};
  for (const double ground : {100.0, 1000.0}) {
    const Scene scene = field_scene(ground);
    for (const render::Backend* backend : render::available_vectors()) {
      const Form in_float{render::Search::All, Precision::Float, backend};
      const Form in_double{render::Search::All, Precision::Double, backend};
      ASSERT_TRUE(may_trace(in_float, scene, settings));
      EXPECT_TRUE(differ_by_noise_only(render_in(in_float, scene, settings).picture,
                                       render_in(in_double, scene, settings).picture))
          << "ground " << ground << ", " << backend->name;
    }
  }
}

}  // namespace
}  // namespace sdlc::test
