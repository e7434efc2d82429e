#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/statistics/estimate.hpp"
#include "tests/support/statistics/scenes.hpp"

// Scenes whose radiance is known in closed form, seen along one ray. H0 of each test: the
// estimator's expectation is the closed form. Significance 1e-4 per test unless noted; seeds are
// fixed, so a failure is a defect.
namespace sdlc::test {
namespace {

using render::LinearRgb;
using render::Scene;
using render::Vec3;

constexpr LinearRgb kWhite{1};
constexpr LinearRgb kBlack{};

double schlick(double cosine, double r0) { return r0 + (1 - r0) * std::pow(1 - cosine, 5); }

TEST(LoneDiffuseSphere, ShowsItsAlbedoUnderAWhiteSky) {
  Scene scene = beam_scene({0, 0, 5}, {0.3, 0.2, 0}, kWhite);
  add_sphere(scene, {0, 0, 0}, 1, diffuse({0.8, 0.5, 0.1}));
  EXPECT_TRUE(agrees(radiance_along_axis(scene, {.depth = 2, .samples = 1000}), {0.8, 0.5, 0.1}));
  EXPECT_TRUE(agrees(radiance_along_axis(scene, {.depth = 50, .samples = 1000}), {0.8, 0.5, 0.1}));
}

TEST(LoneDiffuseSphere, IsBlackWhenTheCameraRayIsThePathsLast) {
  Scene scene = beam_scene({0, 0, 5}, {0, 0, 0}, kWhite);
  add_sphere(scene, {0, 0, 0}, 1, diffuse(kWhite));
  EXPECT_TRUE(agrees(radiance_along_axis(scene, {.depth = 1, .samples = 1000}), kBlack));
}

// Under the gradient 1 − t(1 − g), t = (1 + y) / 2, the cosine law gives E[t] = 1/2 + n_y / 3.
TEST(LoneDiffuseSphere, AveragesTheGradientByTheCosineLaw) {
  for (const double latitude : {90.0, 40.0, 0.0, -65.0}) {
    const double radians = latitude * M_PI / 180;
    const Vec3 normal{0, std::sin(radians), std::cos(radians)};
    Scene scene = beam_scene(normal * 4, {0, 0, 0}, kWhite);
    scene.background = {};
    const LinearRgb a{0.9, 0.6, 0.3}, g = scene.background.top;
    add_sphere(scene, {0, 0, 0}, 1, diffuse(a));
    const double t = 0.5 + normal.y / 3;
    const LinearRgb expected = a * (LinearRgb{1} - (LinearRgb{1} - g) * t);
    EXPECT_TRUE(agrees(radiance_along_axis(scene, {.samples = 1 << 18}), expected, 1e-4 / 4))
        << "latitude " << latitude;
  }
}

TEST(GradientSky, HasItsEndsStraightUpAndDown) {
  Scene up = beam_scene({0, 0, 0}, {0, 1, 0}, kWhite);
  up.background = {};
  EXPECT_TRUE(agrees(radiance_along_axis(up, {.samples = 10}), {0.5, 0.7, 1}));
  Scene down = beam_scene({0, 0, 0}, {0, -1, 0}, kWhite);
  down.background = {};
  EXPECT_TRUE(agrees(radiance_along_axis(down, {.samples = 10}), kWhite));
}

TEST(EmissiveShell, LightsADiffuseSphereEvenly) {
  const LinearRgb a{0.7, 0.4, 0.9};
  Scene scene = beam_scene({0, 0, 5}, {0.5, 0.1, 0}, kBlack);
  add_sphere(scene, {0, 0, 0}, 1, diffuse(a));
  add_sphere(scene, {1, -2, 3}, 30, emissive({0.5, 1, 2}, 3));
  const LinearRgb expected = a * LinearRgb{0.5, 1, 2} * 3;
  EXPECT_TRUE(agrees(radiance_along_axis(scene, {.depth = 2, .samples = 1000}), expected));
}

// Of the light that leaves a point of the shell by the cosine law, F = ρ² hits the emitter; the
// rest hits the shell again under the same conditions.
TEST(ConcentricEmitter, LightsADiffuseShellAsTheGeometricSeriesSays) {
  const double a = 0.8, rho = 0.6, f = rho * rho, l = 2;
  Scene scene = beam_scene({0, 0, 1.6}, {0, 0.3, 2}, kBlack);
  add_sphere(scene, {0, 0, 0}, 2, diffuse(LinearRgb{a}));
  add_sphere(scene, {0, 0, 0}, 2 * rho, emissive(kWhite, l));
  for (const int depth : {2, 3, 6, 40}) {
    const double q = a * (1 - f);
    const double expected = a * f * l * (1 - std::pow(q, depth - 1)) / (1 - q);
    EXPECT_TRUE(agrees(radiance_along_axis(scene, {.depth = depth, .samples = 1 << 18}),
                       LinearRgb{expected}, 1e-4 / 4))
        << "depth " << depth;
  }
}

// Irradiance from a sphere of radius R at distance d, completely above the horizon: π L cos θ (R /
// d)².
TEST(SphereLight, LightsADiffuseSurfaceByTheInverseSquareLaw) {
  const double a = 0.7, l = 20, radius = 0.5, theta = 0.6;
  Scene scene = beam_scene({0, 3, 2}, {0, 0, 0}, kBlack);
  add_sphere(scene, {0, -100, 0}, 100, diffuse(LinearRgb{a}));  // its top is the origin
  const Vec3 light = Vec3{std::sin(theta), std::cos(theta), 0} * 4.0;
  add_sphere(scene, light, radius, emissive(kWhite, l));
  const double expected = a * l * std::cos(theta) * (radius / 4) * (radius / 4);
  EXPECT_TRUE(
      agrees(radiance_along_axis(scene, {.depth = 2, .samples = 1 << 20}), LinearRgb{expected}));
}

TEST(CameraAtTheCentreOfGlass, SeesTheSkyThroughAllReflections) {
  const double n = 1.5, c = 0.5, r = (n - 1) * (n - 1) / ((n + 1) * (n + 1));
  Scene scene = beam_scene({0, 0, 0}, {0, 0, -1}, kWhite);
  add_sphere(scene, {0, 0, 0}, 1, transmissive(LinearRgb{c}, n));
  for (const int depth : {2, 3, 50}) {
    const double expected = c * (1 - r) * (1 - std::pow(c * r, depth - 1)) / (1 - c * r);
    EXPECT_TRUE(agrees(radiance_along_axis(scene, {.depth = depth, .samples = 1 << 18}),
                       LinearRgb{expected}, 1e-4 / 3))
        << "depth " << depth;
  }
}

// A ray that hits glass at impact parameter b is reflected with R_o, or enters, and then hits the
// surface from inside at a constant angle forever.
TEST(GlassSphere, ReflectsAndRefractsByTheImpactParameter) {
  const double n = 1.5, c = 0.5, r0 = (n - 1) * (n - 1) / ((n + 1) * (n + 1));
  for (const double b : {0.0, 0.5, 0.9, 0.99}) {
    const double outer = schlick(std::sqrt(1 - b * b), r0);
    const double inner = schlick(std::sqrt(1 - b * b / (n * n)), r0);
    const double expected = outer * c + (1 - outer) * c * c * (1 - inner) / (1 - c * inner);
    Scene scene = beam_scene({b, 0, 5}, {b, 0, 0}, kWhite);
    add_sphere(scene, {0, 0, 0}, 1, transmissive(LinearRgb{c}, n));
    EXPECT_TRUE(agrees(radiance_along_axis(scene, {.depth = 60, .samples = 1 << 18}),
                       LinearRgb{expected}, 1e-4 / 4))
        << "impact parameter " << b;
  }
}

TEST(GlassSphere, WithExactFresnelReflectsAsFresnelsEquationsSay) {
  const double n = 1.5, b = 0.8, cosine = std::sqrt(1 - b * b),
               beyond = std::sqrt(1 - b * b / (n * n));
  const double across = (cosine - n * beyond) / (cosine + n * beyond);
  const double along = (n * cosine - beyond) / (n * cosine + beyond);
  const double reflected = (across * across + along * along) / 2;  // the same on both sides
  const double c = 0.5;
  const double expected =
      reflected * c + (1 - reflected) * c * c * (1 - reflected) / (1 - c * reflected);
  Scene scene = beam_scene({b, 0, 5}, {b, 0, 0}, kWhite);
  add_sphere(scene, {0, 0, 0}, 1, transmissive(LinearRgb{c}, n, render::Fresnel::Exact));
  EXPECT_TRUE(
      agrees(radiance_along_axis(scene, {.depth = 60, .samples = 1 << 18}), LinearRgb{expected}));
}

TEST(WhiteGlass, ReturnsAWhiteSkyExactly) {
  Scene scene = beam_scene({0.4, 0.3, 5}, {0.4, 0.3, 0}, kWhite);
  add_sphere(scene, {0, 0, 0}, 1, transmissive(kWhite, 1.5));
  const Estimate estimate = radiance_along_axis(scene, {.depth = 1000, .samples = 10000});
  EXPECT_EQ(estimate.mean, kWhite);
}

// The end of the mirrored unit vector is perturbed within a ball of radius f; the cap below the
// surface is absorbed.
TEST(FuzzyMirror, LosesWhatPointsIntoTheSurface) {
  const double color = 0.9;
  for (const auto& [fuzz, cosine] : {std::pair{0.5, 0.2}, {0.5, 0.9}, {1.0, 0.3}, {2.5, 0.6}}) {
    const double sine = std::sqrt(1 - cosine * cosine);
    Scene scene = beam_scene({sine * 3, 1 + cosine * 3, 0}, {0, 1, 0}, kWhite);
    add_sphere(scene, {0, 0, 0}, 1, specular(LinearRgb{color}, fuzz));
    const double s = std::min(1.0, cosine / fuzz);
    const double survives = 1 - (2 - 3 * s + s * s * s) / 4;
    EXPECT_TRUE(agrees(radiance_along_axis(scene, {.samples = 1 << 18}),
                       LinearRgb{color * survives}, 1e-4 / 4))
        << "fuzz " << fuzz << ", cosine " << cosine;
  }
}

TEST(ClosedRoom, WithoutALightIsBlackWhateverItsWalls) {
  for (const render::Material& wall :
       {diffuse(kWhite), specular(kWhite, 0), specular(kWhite, 0.3)}) {
    Scene scene = beam_scene({0.2, 0.1, 0}, {1, 0.3, -1}, kWhite);
    add_sphere(scene, {0, 0, 0}, 1, wall);
    EXPECT_TRUE(agrees(radiance_along_axis(scene, {.depth = 200, .samples = 2000}), kBlack));
  }
}

TEST(CameraOnASurface, LooksOutOfItUnhindered) {
  for (const double radius : {1e-6, 1.0, 6.371e6}) {
    Scene scene = beam_scene({0, radius, 0}, {0.3 * radius, 1.2 * radius, 0}, LinearRgb{0.25});
    add_sphere(scene, {0, 0, 0}, radius, diffuse(LinearRgb{0.9}));
    EXPECT_TRUE(agrees(radiance_along_axis(scene, {.samples = 100}), LinearRgb{0.25}));
  }
}

TEST(CameraOnASurface, LookingIntoGlassMeetsItsFarSide) {
  Scene scene = beam_scene({0, 1, 0}, {0, 0, 0}, kWhite);
  add_sphere(scene, {0, 0, 0}, 1, unlit(LinearRgb{0.3}));
  EXPECT_TRUE(agrees(radiance_along_axis(scene, {.samples = 10}), LinearRgb{0.3}));
}

TEST(CameraWhereTwoSpheresTouch, SeesBetweenThem) {
  // Along the common tangent plane neither sphere is hit.
  Scene scene = beam_scene({0, 0, 0}, {1, 0.0001, 0.5}, LinearRgb{0.25});
  add_sphere(scene, {0, -3, 0}, 3, diffuse(LinearRgb{0.9}));
  add_sphere(scene, {0, 1, 0}, 1, unlit(LinearRgb{0.5}));
  // Slightly upwards the ray enters the upper sphere, whose surface it started on.
  EXPECT_TRUE(agrees(radiance_along_axis(scene, {.samples = 10}), LinearRgb{0.5}));
  scene.camera.at = {1, 0, 0.5};
  EXPECT_TRUE(agrees(radiance_along_axis(scene, {.samples = 10}), LinearRgb{0.25}));
}

TEST(SphereScene, WithoutLightIsExactlyBlack) {
  Scene scene = beam_scene({0, 0, 5}, {0, 0, 0}, kBlack);
  add_sphere(scene, {0, 0, 0}, 1, diffuse(kWhite));
  add_sphere(scene, {0, -101, 0}, 100, transmissive(kWhite, 1.5));
  EXPECT_EQ(radiance_along_axis(scene, {.samples = 1000}).mean, kBlack);
}

}  // namespace
}  // namespace sdlc::test
