#include "render/exactness/precision.hpp"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/extremes/forms.hpp"
#include "tests/extremes/scenes.hpp"
#include "tests/support/statistics/estimate.hpp"

// Tests which precision is chosen, and that the result is correct at the edge of what is accepted.
namespace sdlc::test {
namespace {

using render::LinearRgb;
using render::Precision;
using render::RenderSettings;
using render::Scene;
using render::Search;
using render::Vec3;

class ChosenPrecision : public testing::Test {
 protected:
  void SetUp() override {
    if (render::available_vectors().empty()) GTEST_SKIP() << "this machine has no wide kernel";
  }
  static Precision of(const Scene& scene, int height = 540) {
    return choose_kernel(scene, {.width = 2 * height, .height = height}).precision;
  }
};

TEST_F(ChosenPrecision, IsNotFloatForTheEarthWithSmallSpheresOnIt) {
  Scene scene = beam_scene({0, 1, 4}, {0, 0, 0}, LinearRgb{1});
  for (int i = -3; i <= 3; ++i) add_sphere(scene, {0.5 * i, 0.1, 0}, 0.1, diffuse(LinearRgb{0.5}));
  EXPECT_EQ(of(scene), Precision::Float);
  for (const double radius : {6.371e6, 1e7, 1e9}) {
    Scene on_ground = scene;
    add_sphere(on_ground, {0, -radius, 0}, radius, diffuse(LinearRgb{0.5}));
    EXPECT_EQ(of(on_ground), Precision::Mixed) << "radius " << radius;
  }
}

TEST_F(ChosenPrecision, IsDoubleForAViewOfAMillionthOfADegree) {
  Scene scene = beam_scene({0, 0, 5}, {0, 0, 0}, LinearRgb{1});
  add_sphere(scene, {0, 0, 0}, 1, diffuse(LinearRgb{0.5}));
  scene.camera.plane_height = 2 * std::tan(20 * M_PI / 180);
  EXPECT_EQ(of(scene), Precision::Float);
  scene.camera.plane_height = 2 * std::tan(0.5e-6 * M_PI / 180);
  EXPECT_EQ(of(scene), Precision::Double);
  scene.camera.plane_height = 2 * std::tan(89.99999 * M_PI / 180);
  EXPECT_EQ(of(scene), Precision::Double);
}

TEST_F(ChosenPrecision, IsThatOfTheBoundsForScenesOfManyScales) {
  /// 49 spheres of radius 0.1 and one of 0.5 on a ground, all scaled by `scale`.
  const auto scene_on = [](double ground, double scale) {
    Scene scene = beam_scene(Vec3{0, 1.2, 4} * scale, Vec3{0, 0, 0}, LinearRgb{1});
    scene.camera.plane_height = 2 * std::tan(20 * M_PI / 180);
    scene.camera.aspect = 16.0 / 9;
    add_sphere(scene, Vec3{0, -ground, 0} * scale, ground * scale, diffuse(LinearRgb{0.5}));
    add_sphere(scene, Vec3{0, 0.5, -2} * scale, 0.5 * scale, diffuse(LinearRgb{0.5}));
    for (int i = 0; i < 49; ++i) {
      const Vec3 center{0.4 * (i % 7 - 3), 0.1, 0.4 * (i / 7 - 3) + 0.2};
      add_sphere(scene, center * scale, 0.1 * scale, diffuse(LinearRgb{0.5}));
    }
    return scene;
  };
  for (const double scale : {1.0, 1e-6, 1e-21, 1e21}) {
    EXPECT_EQ(of(scene_on(100, scale)), Precision::Mixed) << scale;
    EXPECT_EQ(of(scene_on(1000, scale)), Precision::Mixed) << scale;
    EXPECT_EQ(of(scene_on(6.371e6, scale)), Precision::Mixed) << scale;
    EXPECT_EQ(of(scene_on(1e9, scale)), Precision::Mixed) << scale;
  }
  Scene telephoto = beam_scene({0, 0, 3000}, {0, 0, 0}, LinearRgb{1});
  telephoto.camera.plane_height = 2 * std::tan(0.02 * M_PI / 180);
  add_sphere(telephoto, {0, 0, 0}, 1, diffuse(LinearRgb{0.5}));
  EXPECT_EQ(of(telephoto), Precision::Double);
  const auto most = [](double ground) {
    Scene scene = beam_scene({0, 1, 4}, {0, 0, 0}, LinearRgb{1});
    add_sphere(scene, {0, -ground, 0}, ground, diffuse(LinearRgb{0.5}));
    add_sphere(scene, {0, 0.1, 0}, 0.1, diffuse(LinearRgb{0.5}));
    return measure_scale(scene, scene.camera).ratio;
  };
  EXPECT_LT(most(1e11), render::kMaxScaleInDouble);
  EXPECT_GT(most(1e15), render::kMaxScaleInDouble);
}

// A pixel may be narrow in only one direction.
TEST_F(ChosenPrecision, MindsTheNarrowerSideOfAPixel) {
  Scene scene = beam_scene({0, 0, 5}, {0, 0, 0}, LinearRgb{1});
  add_sphere(scene, {0, 0, 0}, 1, diffuse(LinearRgb{0.5}));
  const auto precision = [&](int width, int height, double aspect) {
    scene.camera.aspect = aspect;
    return choose_kernel(scene, {.width = width, .height = height}).precision;
  };
  EXPECT_EQ(precision(500, 500, 1), Precision::Float);
  EXPECT_EQ(precision(500, 500, 1e-5), Precision::Double);
  EXPECT_EQ(precision(500, 500, 50), Precision::Float);
  EXPECT_EQ(precision(5'000'000, 1, 1), Precision::Double);
}

TEST_F(ChosenPrecision, DoesNotDependOnWhereTheSceneIsNorOnItsScale) {
  for (const double offset : {0.0, 1e3, 1e7, 1e12}) {
    EXPECT_EQ(of(moved(field_scene(), {offset, 0, -offset})), Precision::Mixed) << offset;
  }
}

/// H0: both have the same expectation. Significance 1e-4.
testing::AssertionResult agree(const Scene& scene, const RenderSettings& settings,
                               Precision expected) {
  const render::Backend* backend = render::available_vectors().back();
  const auto in = [&](Precision precision, std::uint64_t seed) {
    RenderSettings seeded = settings;
    seeded.seed = seed;
    return render_in({Search::All, precision, backend}, scene, seeded);
  };
  const render::RenderResult rounded = in(Precision::Float, 1);
  EXPECT_EQ(rounded.kernel.precision, expected);
  EXPECT_TRUE(judge_float(scene, scene.camera, settings).is_accepted);
  const render::RenderResult right = in(Precision::Double, 2);
  EstimateBuilder differences;
  for (std::size_t i = 0; i < right.picture.pixels.size(); ++i) {
    differences.add(rounded.picture.pixels[i] - right.picture.pixels[i]);
  }
  return agrees(differences.estimate(), LinearRgb{}, 1e-4);
}

/// The ground below a sphere of radius 0.25 that hovers `gap` above it.
Scene hovering(double ground, double gap, const render::Material& material) {
  Scene scene = beam_scene({0, 0.3, 1.5}, {0, 0, 0.06}, LinearRgb{1});
  scene.background = {};
  scene.camera.plane_height = 0.1;
  add_sphere(scene, {0, -ground, 0}, ground, diffuse(LinearRgb{0.8}));
  add_sphere(scene, {0, 0.25 + gap, 0}, 0.25, material);
  return scene;
}

// For any width of the gap: the region where points on the ground are nearer to the sphere than
// their rounding error is negligible.
TEST_F(ChosenPrecision, IsRightForSpheresThatHoverAboveAGroundMetInDouble) {
  RenderSettings settings{.width = 64, .height = 64, .samples = 64, .depth = 20};
  if (const char* samples = std::getenv("SDLC_SAMPLES")) settings.samples = std::atoi(samples);
  for (const double ground : {100.0, 1000.0, 5000.0}) {
    const double rounding = 4 * 0x1p-24 * 2 * ground;
    for (const auto& material : {diffuse(LinearRgb{0.8}), transmissive(LinearRgb{0.9}, 1.5),
                                 specular(LinearRgb{0.9}, 0.1)}) {
      for (const double gap : {0.0, 1e-3 * rounding, 0.3 * rounding, 2 * rounding}) {
        const Scene scene = hovering(ground, gap, material);
        const bool is_mixed = !judge_float(scene, scene.camera, settings).exact_spheres.empty();
        EXPECT_TRUE(is_mixed || gap == 0);
        EXPECT_TRUE(agree(scene, settings, is_mixed ? Precision::Mixed : Precision::Float))
            << "ground " << ground << ", gap " << gap << ", material "
            << static_cast<int>(material.type);
      }
    }
  }
}

/// A glass shell of thickness `wall`, `distance` away.
Scene shell(double wall, double distance) {
  Scene scene = beam_scene({0, 0, distance}, {0, 0, 0}, LinearRgb{1});
  scene.background = {};
  scene.camera.plane_height = 3 / distance;
  add_sphere(scene, {0, 0, 0}, 1, transmissive({0.9, 0.8, 0.7}, 1.5));
  add_sphere(scene, {0, 0, 0}, 1 - wall, transmissive({0.7, 0.8, 0.9}, 1 / 1.5));
  return scene;
}

TEST_F(ChosenPrecision, IsRightForTheThinnestShellsThatFloatTakes) {
  const RenderSettings settings{.width = 64, .height = 64, .samples = 256, .depth = 30};
  for (const double distance : {3.0, 50.0, 1000.0, 5000.0}) {
    double wall = 0.1;
    while (true) {
      const Scene thinner = shell(wall * 0.8, distance);
      if (!judge_float(thinner, thinner.camera, settings, 0).is_accepted) break;
      wall *= 0.8;
    }
    EXPECT_TRUE(agree(shell(wall, distance), settings, Precision::Float))
        << "a wall of " << wall << " at " << distance;
  }
}

TEST_F(ChosenPrecision, IsRightForTheSmallestSpheresThatFloatTakes) {
  const RenderSettings settings{.width = 64, .height = 64, .samples = 256, .depth = 20};
  for (const double far : {10.0, 300.0}) {
    const auto scene_with = [&](double radius) {
      Scene scene = beam_scene({0, 0, 8 * radius}, {0, 0, 0}, LinearRgb{1});
      scene.background = {};
      scene.camera.plane_height = 0.4;
      add_sphere(scene, {0, 0, 0}, radius, transmissive({0.9, 0.8, 0.7}, 1.5));
      add_sphere(scene, {2 * radius, 0, 0}, radius, diffuse({0.9, 0.8, 0.7}));
      add_sphere(scene, {0, 0, -far}, far / 2, diffuse({0.2, 0.9, 0.4}));
      return scene;
    };
    double radius = far / 10;
    while (true) {
      const Scene smaller = scene_with(radius * 0.9);
      if (!judge_float(smaller, smaller.camera, settings, 0).is_accepted) break;
      radius *= 0.9;
    }
    EXPECT_TRUE(agree(scene_with(radius), settings, Precision::Float)) << "radius " << radius;
  }
}

}  // namespace
}  // namespace sdlc::test
