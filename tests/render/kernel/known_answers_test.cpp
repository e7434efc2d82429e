#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "render/kernel/tracer.hpp"
#include "render/session/render.hpp"
#include "tests/render/kernel/kernels.hpp"
#include "tests/support/statistics/scenes.hpp"

// Scenes whose radiance is known in closed form, by the wide kernel. H0 of each test: the
// estimator's expectation is the closed form. Significance 1e-4 per comparison, with fixed seeds.
// Rounding may add 1e-5 in float and 1e-12 in double.
namespace sdlc::test {
namespace {

using render::LinearRgb;
using render::Scene;
using render::Vec3;

constexpr LinearRgb kWhite{1};
constexpr LinearRgb kBlack{};

class KnownAnswer : public testing::TestWithParam<WideForm> {
 protected:
  /// The radiance along the camera's axis: a picture of 16 × 16 pixels, so narrow that all see the
  /// same.
  Estimate radiance(Scene scene, int depth = 16, int samples = 1024) const {
    scene.camera.plane_height *= 1e-9;
    const render::RenderResult result = render_with(
        scene, {.width = 16, .height = 16, .samples = samples, .depth = depth, .seed = 7},
        GetParam().request());
    EXPECT_EQ(result.nonfinite_samples, 0u);
    EstimateBuilder builder;
    for (const LinearRgb& pixel : result.picture.pixels) builder.add(pixel);
    return builder.estimate();
  }

  testing::AssertionResult is(Estimate estimate, LinearRgb expected) const {
    const double rounding = GetParam().precision == render::Precision::Double ? 1e-12 : 1e-5;
    const auto forgive = [&](double& mean, double wanted) {
      if (std::fabs(mean - wanted) <= rounding) mean = wanted;
    };
    forgive(estimate.mean.r, expected.r);
    forgive(estimate.mean.g, expected.g);
    forgive(estimate.mean.b, expected.b);
    return agrees(estimate, expected);
  }
};

TEST_P(KnownAnswer, ALoneDiffuseSphereShowsItsAlbedo) {
  Scene scene = beam_scene({0, 0, 5}, {0.3, 0.2, 0}, kWhite);
  add_sphere(scene, {0, 0, 0}, 1, diffuse({0.8, 0.5, 0.1}));
  EXPECT_TRUE(is(radiance(scene, 2), {0.8, 0.5, 0.1}));
  EXPECT_TRUE(is(radiance(scene, 50), {0.8, 0.5, 0.1}));
  EXPECT_TRUE(is(radiance(scene, 1), kBlack));
}

// Under the gradient 1 − t(1 − g), t = (1 + y) / 2, the cosine law gives E[t] = 1/2 + n_y / 3.
TEST_P(KnownAnswer, ADiffuseSphereAveragesTheGradientByTheCosineLaw) {
  for (const double latitude : {90.0, 40.0, 0.0, -65.0}) {
    const double radians = latitude * M_PI / 180;
    const Vec3 normal{0, std::sin(radians), std::cos(radians)};
    Scene scene = beam_scene(normal * 4, {0, 0, 0}, kWhite);
    scene.background = {};
    const LinearRgb a{0.9, 0.6, 0.3}, g = scene.background.top;
    add_sphere(scene, {0, 0, 0}, 1, diffuse(a));
    const double t = 0.5 + normal.y / 3;
    EXPECT_TRUE(is(radiance(scene), a * (LinearRgb{1} - (LinearRgb{1} - g) * t)))
        << "latitude " << latitude;
  }
}

// Of the light that leaves a point of the shell by the cosine law, F = ρ² hits the emitter; the
// rest hits the shell again under the same conditions.
TEST_P(KnownAnswer, AConcentricEmitterLightsAShellAsTheGeometricSeriesSays) {
  const double a = 0.8, rho = 0.6, f = rho * rho, l = 2;
  Scene scene = beam_scene({0, 0, 1.6}, {0, 0.3, 2}, kBlack);
  add_sphere(scene, {0, 0, 0}, 2, diffuse(LinearRgb{a}));
  add_sphere(scene, {0, 0, 0}, 2 * rho, emissive(kWhite, l));
  for (const int depth : {2, 3, 6, 40}) {
    const double q = a * (1 - f);
    const double expected = a * f * l * (1 - std::pow(q, depth - 1)) / (1 - q);
    EXPECT_TRUE(is(radiance(scene, depth), LinearRgb{expected})) << "depth " << depth;
  }
}

TEST_P(KnownAnswer, ASphereLightFollowsTheInverseSquareLaw) {
  const double a = 0.7, l = 20, radius = 0.5, theta = 0.6;
  Scene scene = beam_scene({0, 3, 2}, {0, 0, 0}, kBlack);
  add_sphere(scene, {0, -100, 0}, 100, diffuse(LinearRgb{a}));  // its top is the origin
  const Vec3 light = Vec3{std::sin(theta), std::cos(theta), 0} * 4.0;
  add_sphere(scene, light, radius, emissive(kWhite, l));
  const double expected = a * l * std::cos(theta) * (radius / 4) * (radius / 4);
  EXPECT_TRUE(is(radiance(scene, 2, 4096), LinearRgb{expected}));
}

TEST_P(KnownAnswer, TheCameraAtTheCentreOfGlassSeesTheSkyThroughAllReflections) {
  const double n = 1.5, c = 0.5, r = (n - 1) * (n - 1) / ((n + 1) * (n + 1));
  Scene scene = beam_scene({0, 0, 0}, {0, 0, -1}, kWhite);
  add_sphere(scene, {0, 0, 0}, 1, transmissive(LinearRgb{c}, n));
  for (const int depth : {2, 3, 50, 1'000'000}) {
    const double expected = c * (1 - r) * (1 - std::pow(c * r, depth - 1)) / (1 - c * r);
    EXPECT_TRUE(is(radiance(scene, depth), LinearRgb{expected})) << "depth " << depth;
  }
}

// A ray that hits glass at impact parameter b is reflected with R_o, or enters, and then hits the
// surface from inside at a constant angle forever.
TEST_P(KnownAnswer, GlassReflectsAndRefractsByTheImpactParameter) {
  const double n = 1.5, c = 0.5, r0 = (n - 1) * (n - 1) / ((n + 1) * (n + 1));
  const auto schlick = [&](double cosine) { return r0 + (1 - r0) * std::pow(1 - cosine, 5); };
  for (const double scale : {1.0, 1e-5, 1e-8}) {
    for (const double b : {0.0, 0.5, 0.9}) {
      const double outer = schlick(std::sqrt(1 - b * b));
      const double inner = schlick(std::sqrt(1 - b * b / (n * n)));
      const double expected = outer * c + (1 - outer) * c * c * (1 - inner) / (1 - c * inner);
      Scene scene = beam_scene(Vec3{b, 0, 5} * scale, Vec3{b, 0, 0} * scale, kWhite);
      add_sphere(scene, {0, 0, 0}, scale, transmissive(LinearRgb{c}, n));
      EXPECT_TRUE(is(radiance(scene, 60), LinearRgb{expected}))
          << "impact parameter " << b << ", radius " << scale;
    }
  }
}

TEST_P(KnownAnswer, ExactFresnelReflectsAsTheEquationsSay) {
  const double n = 1.5, b = 0.8, c = 0.5, cosine = std::sqrt(1 - b * b),
               beyond = std::sqrt(1 - b * b / (n * n));
  const double across = (cosine - n * beyond) / (cosine + n * beyond);
  const double along = (n * cosine - beyond) / (n * cosine + beyond);
  const double r = (across * across + along * along) / 2;  // the same on both sides
  Scene scene = beam_scene({b, 0, 5}, {b, 0, 0}, kWhite);
  add_sphere(scene, {0, 0, 0}, 1, transmissive(LinearRgb{c}, n, render::Fresnel::Exact));
  EXPECT_TRUE(is(radiance(scene, 60), LinearRgb{r * c + (1 - r) * c * c * (1 - r) / (1 - c * r)}));
}

TEST_P(KnownAnswer, AnIndexBelowOneReflectsTotally) {
  Scene scene = beam_scene({0.7, 0, 5}, {0.7, 0, 0}, kWhite);
  add_sphere(scene, {0, 0, 0}, 1, transmissive(LinearRgb{0.5}, 0.5));
  EXPECT_TRUE(is(radiance(scene), LinearRgb{0.5}));
}

TEST_P(KnownAnswer, WhiteGlassReturnsAWhiteSkyExactly) {
  Scene scene = beam_scene({0.4, 0.3, 5}, {0.4, 0.3, 0}, kWhite);
  add_sphere(scene, {0, 0, 0}, 1, transmissive(kWhite, 1.5));
  EXPECT_EQ(radiance(scene, 1000).mean, kWhite);
}

TEST_P(KnownAnswer, NestedShellsOfIndexOneAreClear) {
  Scene scene = beam_scene({0.05, 0, 5}, {0.05, 0, 0}, kWhite);
  for (int i = 0; i < 64; ++i) add_sphere(scene, {0, 0, 0}, 1 - i / 80.0, transmissive(kWhite, 1));
  EXPECT_TRUE(is(radiance(scene, 400), kWhite));
}

// The end of the mirrored unit vector is perturbed within a ball of radius f; the cap below the
// surface is absorbed.
TEST_P(KnownAnswer, AFuzzyMirrorLosesWhatPointsIntoTheSurface) {
  const double color = 0.9;
  for (const auto& [fuzz, cosine] : {std::pair{0.5, 0.2}, {0.5, 0.9}, {1.0, 0.3}, {2.5, 0.6}}) {
    const double sine = std::sqrt(1 - cosine * cosine);
    Scene scene = beam_scene({sine * 3, 1 + cosine * 3, 0}, {0, 1, 0}, kWhite);
    add_sphere(scene, {0, 0, 0}, 1, specular(LinearRgb{color}, fuzz));
    const double s = std::min(1.0, cosine / fuzz);
    const double survives = 1 - (2 - 3 * s + s * s * s) / 4;
    EXPECT_TRUE(is(radiance(scene), LinearRgb{color * survives}))
        << "fuzz " << fuzz << ", cosine " << cosine;
  }
}

TEST_P(KnownAnswer, AClosedRoomWithoutALightIsBlack) {
  for (const render::Material& wall :
       {diffuse(kWhite), specular(kWhite, 0), specular(kWhite, 0.3)}) {
    Scene scene = beam_scene({0.2, 0.1, 0}, {1, 0.3, -1}, kWhite);
    add_sphere(scene, {0, 0, 0}, 1, wall);
    EXPECT_TRUE(is(radiance(scene, 200, 16), kBlack));
  }
}

TEST_P(KnownAnswer, TheCameraOnASurfaceLooksOutUnhinderedAndInToTheFarSide) {
  for (const double radius : {1e-6, 1.0, 6.371e6}) {
    Scene scene = beam_scene({0, radius, 0}, {0.3 * radius, 1.2 * radius, 0}, LinearRgb{0.25});
    add_sphere(scene, {0, 0, 0}, radius, unlit(LinearRgb{0.75}));
    EXPECT_TRUE(is(radiance(scene), LinearRgb{0.25}));
    scene.camera.at = {0.1 * radius, 0, 0};
    EXPECT_TRUE(is(radiance(scene), LinearRgb{0.75}));
  }
}

TEST_P(KnownAnswer, AWhiteGroundUnderAWhiteSkyIsWhite) {
  if (GetParam().precision == render::Precision::Float) GTEST_SKIP() << "it needs double";
  Scene scene = beam_scene({0, 1, 0}, {1, 0.8, 0}, kWhite);
  add_sphere(scene, {0, -1e9, 0}, 1e9, diffuse(kWhite));
  EXPECT_TRUE(is(radiance(scene, 50), kWhite));
}

// The distance to the ground is 1e-11 of that through it, and directions in float are not that
// close to unit length.
TEST_P(KnownAnswer, AGroundMetInDoubleIsMetWhereItIs) {
  if (GetParam().precision == render::Precision::Double) GTEST_SKIP() << "it is about float";
  Scene scene = beam_scene({0, 1e-5, 0}, {1e-5, 0, 0}, kWhite);
  add_sphere(scene, {0, -1e6, 0}, 1e6, diffuse(kWhite));
  add_sphere(scene, {3e5, 2e5, 0}, 1e5, diffuse(kWhite));
  const render::RenderSettings settings{.width = 8, .height = 8, .samples = 16, .depth = 1000};
  const std::array<std::uint32_t, 1> ground{0};
  const auto tracer = make_tracer(scene, {.precision = render::Precision::Mixed,
                                          .backend = GetParam().backend,
                                          .search = render::Search::All,
                                          .exact_spheres = ground});
  std::vector<render::PixelRun> runs;
  for (std::uint64_t pixel = 0; pixel < 64; ++pixel) {
    runs.push_back({.pixel = pixel, .parts = {{{.first = 0, .count = 16, .sum = {}}}}});
  }
  render::TraceCounts counts;
  ASSERT_TRUE(tracer->trace(settings, nullptr, runs, counts, std::atomic<bool>{false}));
  for (const render::PixelRun& run : runs) EXPECT_EQ(run.parts[0].sum, LinearRgb{16});
}

TEST_P(KnownAnswer, TheOffsetFromTheOriginDoesNotMatter) {
  const auto mean = [&](Vec3 offset) {
    Scene scene = beam_scene(offset + Vec3{0.5, 0, 5}, offset + Vec3{0.5, 0, 0}, kWhite);
    scene.background = {};
    add_sphere(scene, offset, 1, transmissive({0.9, 0.8, 0.7}, 1.5));
    return radiance(scene, 50, 64).mean;
  };
  EXPECT_EQ(mean({0, 0, 0}), mean({1 << 26, 0, -(1 << 26)}));
}

// A sphere of radius 1 that moves from x = −2 to x = 2 covers the axis from t = 1/4 to 3/4.
TEST_P(KnownAnswer, AMovingSphereCoversItsShareOfTheShutter) {
  Scene scene = beam_scene({0, 0, 5}, {0, 0, 0}, kBlack);
  add_sphere(scene, {-2, 0, 0}, 1, unlit(kWhite));
  scene.shifts = {{4, 0, 0}};
  EXPECT_TRUE(is(radiance(scene, 1), LinearRgb{0.5}));
}

INSTANTIATE_TEST_SUITE_P(Forms, KnownAnswer, testing::ValuesIn(wide_forms()), form_name);

}  // namespace
}  // namespace sdlc::test
