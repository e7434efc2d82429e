#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/statistics/estimate.hpp"
#include "tests/support/statistics/random.hpp"
#include "tests/support/statistics/scenes.hpp"

// Light sampling has the same expectation as scattering alone, at every depth limit. Where there is
// a closed form, H0 is that the expectation equals it; elsewhere, that paths with and without light
// sampling have the same expectation, so that estimates with different seeds differ according to
// their standard errors. Significance 1e-4 per test, shared among its cases; seeds are fixed.
namespace sdlc::test {
namespace {

using render::LightSampling;
using render::LinearRgb;
using render::Scene;
using render::Vec3;

constexpr LinearRgb kWhite{1};
constexpr LinearRgb kBlack{};
constexpr int kDepths[]{2, 3, 5, 16};

Estimate with_lights(const Scene& scene, int depth, std::uint64_t samples = 1 << 16) {
  return radiance_along_axis(
      scene, {.depth = depth, .samples = samples, .seed = 11, .light_sampling = LightSampling::On});
}

/// A gray ground, seen at the origin, under a dim sky; its color makes many bounces matter.
Scene on_the_ground() {
  Scene scene = beam_scene({0, 3, 2}, {0, 0, 0}, {0.1, 0.05, 0.2});
  add_sphere(scene, {0, -100, 0}, 100, diffuse({0.8, 0.7, 0.9}));
  return scene;
}

Scene behind_glass() {
  Scene scene = on_the_ground();
  add_sphere(scene, {0.5, 1.5, 0}, 0.4, emissive({1, 0.8, 0.5}, 10));
  add_sphere(scene, {0.3, 0.8, 0}, 0.3, transmissive({0.9, 1, 1}, 1.5));
  add_sphere(scene, {-1, 0.5, -0.5}, 0.5, specular({0.8, 0.8, 0.8}, 0.1));
  return scene;
}

Scene behind_unlit_ones() {
  Scene scene = on_the_ground();
  add_sphere(scene, {0.5, 1.5, 0}, 0.5, emissive({1, 0.8, 0.5}, 10));
  add_sphere(scene, {0.3, 0.8, 0}, 0.25, unlit({0.2, 0.3, 0.1}));
  add_sphere(scene, {-1, 0.5, 0}, 0.4, diffuse({0.5, 0.8, 0.3}));
  return scene;
}

Scene moving_ones() {
  Scene scene = behind_unlit_ones();
  add_sphere(scene, {-1, 1.4, 0}, 0.3, emissive({0.2, 0.8, 1}, 15));
  scene.shifts.assign(scene.spheres.size(), Vec3{});
  scene.shifts[1] = {-1, 0.5, 0.2};
  scene.shifts[2] = {0.5, 0, 0};
  scene.shifts[4] = {0.3, -2, 0.1};  // below the ground
  return scene;
}

/// Near enough for scattering to find it as often as connections, and far away later.
Scene large_and_moving() {
  Scene scene = on_the_ground();
  add_sphere(scene, {0, 0.9, 0}, 0.6, emissive({1, 0.8, 0.5}, 3));
  scene.shifts = {Vec3{}, {4, 1, 0}};
  return scene;
}

Scene from_inside_of_one() {
  Scene scene = on_the_ground();
  add_sphere(scene, {0, 0.2, 0}, 0.5, emissive({1, 0.8, 0.5}, 2));
  add_sphere(scene, {0.6, 0.4, 0}, 0.3, emissive({0.3, 0.8, 0.5}, 9));
  scene.camera.from = {0, 0.3, 0.1};
  return scene;
}

Scene overlapping_ones() {
  Scene scene = on_the_ground();
  add_sphere(scene, {0.2, 1, 0}, 0.4, emissive({1, 0.1, 0.1}, 8));
  add_sphere(scene, {-0.2, 1.1, 0}, 0.4, emissive({0.1, 1, 0.1}, 4));
  add_sphere(scene, {0.2, 1.2, 0}, 0.1, emissive({0.1, 0.1, 1}, 100));  // in the first one
  return scene;
}

Scene both_sides_of_a_shell() {
  Scene scene = beam_scene({0, 0, 0.5}, {0, 0.3, 2}, kBlack);
  add_sphere(scene, {0, 0, 0}, 2, diffuse({0.8, 0.7, 0.9}));
  add_sphere(scene, {0.5, 0.2, 0}, 0.3, emissive(kWhite, 10));
  add_sphere(scene, {3, 3, 3}, 0.7, emissive(kWhite, 100));  // outside
  add_sphere(scene, {-0.8, 0.9, 0.9}, 0.5, diffuse({0.3, 0.7, 0.9}));
  return scene;
}

Scene camera_on_a_surface() {
  Scene scene = behind_unlit_ones();
  scene.camera.from = {0, 1, 1.5};
  add_sphere(scene, {0, 1.5, 1.5}, 0.5, diffuse({0.7, 0.7, 0.7}));
  return scene;
}

/// Centres, and with them half of each light, below the horizon of the visible point.
Scene at_the_horizon() {
  Scene scene = on_the_ground();
  add_sphere(scene, {1, 0, 0}, 0.4, emissive({1, 0.8, 0.5}, 10));
  add_sphere(scene, {-1, -0.1, 0}, 0.4, emissive({0.2, 0.8, 0.5}, 10));
  add_sphere(scene, {0, -1, 0}, 0.5, emissive({1, 1, 1}, 1000));
  return scene;
}

Scene three_thousand() {
  Scene scene = on_the_ground();
  Random random(9);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 place{random.between(-3, 3), random.between(-0.2, 2.5), random.between(-3, 3)};
    const LinearRgb color{random.between(0, 1), random.between(0, 1), random.between(0, 1)};
    add_sphere(scene, place, random.between(0.005, 0.02), emissive(color, 50));
  }
  return scene;
}

/// Seen from the side, so that much is absorbed and the mirrored direction passes the lamps.
Scene on_metal(double fuzz) {
  Scene scene = beam_scene({0, 1, 2}, {0, 0, 0}, {0.1, 0.05, 0.2});
  add_sphere(scene, {0, -100, 0}, 100, specular({0.8, 0.7, 0.9}, fuzz));
  add_sphere(scene, {0.2, 1.3, -2}, 0.3, emissive({1, 0.8, 0.5}, 10));
  add_sphere(scene, {-0.5, 0.3, -2}, 0.4, emissive({0.2, 0.8, 1}, 5));
  add_sphere(scene, {0.1, 0.6, -0.8}, 0.2, diffuse({0.5, 0.8, 0.3}));
  return scene;
}

Scene moving_over_metal() {
  Scene scene = on_metal(0.6);
  scene.shifts = {Vec3{}, {0.5, -1, 0.2}, {0.3, -0.5, 0}, {0, 0.5, 0}};
  return scene;
}

TEST(LightSampling, HasTheExpectationOfPlainPathsAtEveryDepth) {
  const std::vector<std::pair<const char*, Scene>> scenes{
      {"behind glass", behind_glass()},
      {"behind unlit spheres", behind_unlit_ones()},
      {"moving", moving_ones()},
      {"large and moving", large_and_moving()},
      {"from inside of one", from_inside_of_one()},
      {"overlapping", overlapping_ones()},
      {"both sides of a shell", both_sides_of_a_shell()},
      {"camera on a surface", camera_on_a_surface()},
      {"at the horizon", at_the_horizon()},
      {"three thousand", three_thousand()},
      {"slightly fuzzy metal", on_metal(0.01)},
      {"brushed metal", on_metal(0.2)},
      {"wide metal", on_metal(0.6)},
      {"the widest metal", on_metal(1)},
      {"fuzz above 1", on_metal(2.5)},
      {"moving over metal", moving_over_metal()}};
  const double significance = 1e-4 / static_cast<double>(scenes.size() * std::size(kDepths));
  for (const auto& [name, scene] : scenes) {
    for (const int depth : kDepths) {
      const Estimate plain = radiance_along_axis(scene, {.depth = depth, .samples = 1 << 18});
      EXPECT_TRUE(agree(with_lights(scene, depth), plain, significance))
          << name << ", depth " << depth;
    }
  }
}

TEST(LightSampling, ChangesNothingThatTheLastRayCannotReach) {
  for (const Scene& scene : {behind_glass(), moving_ones()}) {
    EXPECT_EQ(with_lights(scene, 1, 100).mean, kBlack);
  }
}

// As in analytic_test.cpp.
TEST(LightSampling, LightsADiffuseShellAsTheGeometricSeriesSays) {
  const double a = 0.8, rho = 0.6, f = rho * rho, l = 2;
  Scene scene = beam_scene({0, 0, 1.6}, {0, 0.3, 2}, kBlack);
  add_sphere(scene, {0, 0, 0}, 2, diffuse(LinearRgb{a}));
  add_sphere(scene, {0, 0, 0}, 2 * rho, emissive(kWhite, l));
  for (const int depth : kDepths) {
    const double q = a * (1 - f);
    const double expected = a * f * l * (1 - std::pow(q, depth - 1)) / (1 - q);
    EXPECT_TRUE(agrees(with_lights(scene, depth), LinearRgb{expected}, 1e-4 / 4))
        << "depth " << depth;
  }
}

TEST(LightSampling, LightsADiffuseSurfaceByTheInverseSquareLawWithLittleNoise) {
  const double a = 0.7, theta = 0.6;
  // From half the view to an angular radius of 2e-16, which rounded directions miss.
  for (const auto& [radius, d] :
       {std::pair{0.5, 4.0}, {2.9, 4.0}, {1e-3, 50.0}, {5e-8, 50.0}, {1e-14, 50.0}}) {
    const double l = 20 * (d / radius) * (d / radius);
    Scene scene = beam_scene({0, 3, 2}, {0, 0, 0}, kBlack);
    add_sphere(scene, {0, -100, 0}, 100, diffuse(LinearRgb{a}));  // its top is the origin
    add_sphere(scene, {d * std::sin(theta), d * std::cos(theta), 0}, radius, emissive(kWhite, l));
    add_sphere(scene, {0, 0, 0}, 250, unlit(kBlack));  // behind the light
    const double expected = 20 * a * std::cos(theta);
    const Estimate estimate = with_lights(scene, 2);
    EXPECT_TRUE(agrees(estimate, LinearRgb{expected}, 1e-4 / 5)) << "radius " << radius;
    // Of one sample; that of plain paths is about d / radius times the mean.
    EXPECT_LT(estimate.standard_error.g * 256, (radius < 1 ? 0.15 : 0.6) * expected) << radius;
  }
}

TEST(LightSampling, LightsMetalWithLittleNoise) {
  // A lamp in the mirrored direction of the ray, much smaller than what the metal scatters into.
  for (const double fuzz : {0.05, 0.35, 1.0}) {
    const double radius = 1e-3, d = 2, l = 1e6;
    Scene scene = beam_scene({0, 3, 2}, {0, 0, 0}, kBlack);
    add_sphere(scene, {0, -1000, 0}, 1000, specular(LinearRgb{0.7}, fuzz));
    const double axis = std::atan2(3, 2);
    add_sphere(scene, {0, d * std::sin(axis), -d * std::cos(axis)}, radius, emissive(kWhite, l));
    // The density of the mirrored direction times the solid angle of the lamp.
    const double end = 1 + fuzz, start = 1 - fuzz;
    const double density = (end * end * end - start * start * start) / (4 * fuzz * fuzz * fuzz);
    const double expected = 0.7 * l * density * (radius / d) * (radius / d);
    const Estimate estimate = with_lights(scene, 2);
    // The density varies over the lamp by some (radius / d / fuzz)².
    const double varies = 3 * std::pow(radius / d / fuzz, 2) * expected;
    EXPECT_NEAR(estimate.mean.g, expected, varies) << fuzz;
    EXPECT_LT(estimate.standard_error.g * 256, 0.02 * expected) << fuzz;  // of one sample
  }
}

TEST(LightSampling, FindsTheLightsThatMatterAmongThousands) {
  const Scene scene = three_thousand();
  const Estimate plain = radiance_along_axis(scene, {.depth = 2, .samples = 1 << 16});
  EXPECT_LT(with_lights(scene, 2).standard_error.g, plain.standard_error.g / 5);
}

}  // namespace
}  // namespace sdlc::test
