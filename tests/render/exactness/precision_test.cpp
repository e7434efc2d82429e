#include "render/exactness/precision.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr int kHeight = 540;

/// Three spheres of radius 1 in view of the camera, 4 from each other.
Scene plain_scene() {
  Scene scene;
  scene.camera = {.from = {0, 0, 10}, .at = {0, 0, 0}, .plane_height = 1};
  scene.materials = {Material{.color = LinearRgb{0.5}}};
  scene.spheres = {{.center = {-4, 0, 0}, .radius = 1},
                   {.center = {0, 0, 0}, .radius = 1},
                   {.center = {4, 0, 0}, .radius = 1}};
  return scene;
}

FloatVerdict judge(const Scene& scene, int height = kHeight, std::size_t max_exact = 2) {
  return judge_float(scene, scene.camera, {.width = 960, .height = height}, max_exact);
}

/// The deciding criterion with everything in float, and its spheres.
PrecisionClause clause_of(const Scene& scene, int height = kHeight) {
  return judge(scene, height).in_float.deciding();
}

TEST(FloatVerdict, AcceptsWhatIsOfOneSize) {
  const FloatVerdict verdict = judge(plain_scene());
  EXPECT_TRUE(verdict.is_accepted);
  EXPECT_THAT(verdict.exact_spheres, IsEmpty());
}

TEST(FloatVerdict, DoesNotDependOnPlaceAndScale) {
  for (const double scale : {1e-30, 1.0, 1e30}) {
    for (const Vec3 offset : {Vec3{}, Vec3{1e6, 0, -1e6}}) {
      Scene scene = plain_scene();
      scene.camera.from = (scene.camera.from + offset) * scale;
      scene.camera.at = (scene.camera.at + offset) * scale;
      for (Sphere& sphere : scene.spheres) {
        sphere.center = (sphere.center + offset) * scale;
        sphere.radius *= scale;
      }
      EXPECT_TRUE(judge(scene).is_accepted);
    }
  }
}

// 25 u E ≤ r / 100 with E = 11.8: r may be as small as 0.00176.
TEST(FloatVerdict, RefusesSpheresThatAreSmallForTheScene) {
  Scene scene = plain_scene();
  scene.spheres.push_back({.center = {0, 4, 0}, .radius = 0.002});
  EXPECT_TRUE(judge(scene).is_accepted);
  scene.spheres.back().radius = 0.0015;
  EXPECT_FALSE(judge(scene).is_accepted);
  const FloatVerdict verdict = judge(scene);
  EXPECT_EQ(verdict.in_float.deciding(), PrecisionClause::Hit);
  const PrecisionBound& hit = verdict.in_float[PrecisionClause::Hit];
  EXPECT_EQ(hit.sphere, 3u);
  EXPECT_EQ(hit.other, 0u) << "the first of the farthest";
  EXPECT_NEAR(hit.value, 25 * 0x1p-24 * (std::sqrt(116.0) + 1) / 0.0015, 1e-12);
  EXPECT_DOUBLE_EQ(hit.share, hit.value * 100);
  EXPECT_EQ(describe(PrecisionClause::Hit, hit),
            "a hit is off by 0.0117 of the smallest radius, where 0.01 is allowed");
}

TEST(FloatVerdict, TakesLargeSpheresOutOfTheBounds) {
  Scene scene = plain_scene();
  scene.spheres.push_back({.center = {0, -10002, 0}, .radius = 10000});
  EXPECT_TRUE(judge(scene).is_accepted);
  EXPECT_THAT(judge(scene).exact_spheres, ElementsAre(3));
  // Their number matters, not their size.
  scene.spheres[3] = {.center = {0, -6.371e6 - 2, 0}, .radius = 6.371e6};
  EXPECT_THAT(judge(scene).exact_spheres, ElementsAre(3));
  scene.spheres.push_back({.center = {0, 10002, 0}, .radius = 10000});
  EXPECT_THAT(judge(scene).exact_spheres, ElementsAre(3, 4));
  scene.spheres.push_back({.center = {0, 0, -10010}, .radius = 10000});
  EXPECT_FALSE(judge(scene).is_accepted);
  EXPECT_THAT(judge(scene, kHeight, 3).exact_spheres, ElementsAre(3, 4, 5));
}

// Across the view: 2 u E ≤ d · pixel / 16 with E = 5.1 and a pixel of 1/540: d ≥ 0.0053.
TEST(FloatVerdict, RefusesSurfacesThatAreTooNear) {
  Scene scene = plain_scene();
  scene.camera.from = {0, 0, 1.006};
  EXPECT_TRUE(judge(scene).is_accepted);
  scene.camera.from = {0, 0, 1.0045};
  EXPECT_FALSE(judge(scene, kHeight, 0).is_accepted);
  EXPECT_EQ(clause_of(scene), PrecisionClause::Across);
  EXPECT_EQ(judge(scene).in_float[PrecisionClause::Across].sphere, 1u);
  scene.camera.from = {0, 0, 1};  // on it: it counts as left
  EXPECT_TRUE(judge(scene).is_accepted);
}

TEST(FloatVerdict, RefusesNarrowPixels) {
  EXPECT_TRUE(judge(plain_scene(), 40000).is_accepted);
  EXPECT_FALSE(judge(plain_scene(), 2'000'000).is_accepted);
  EXPECT_GT(judge(plain_scene(), 2'000'000).in_float[PrecisionClause::Pixel].share, 1);
  // 16 u is 1/1048576. Surfaces other than the camera's own are too near long before that.
  Scene on_sphere = plain_scene();
  on_sphere.spheres = {{.center = {0, 0, 9}, .radius = 1}};
  EXPECT_TRUE(judge(on_sphere, 1'000'000).is_accepted);
  EXPECT_FALSE(judge(on_sphere, 1'100'000).is_accepted);
}

TEST(FloatVerdict, RefusesViewsOfNearlyHalfTheSphere) {
  Scene scene = plain_scene();
  scene.camera.plane_height = 90;
  scene.camera.aspect = 1;
  EXPECT_TRUE(judge(scene).is_accepted);
  scene.camera.plane_height = 110;
  EXPECT_EQ(clause_of(scene), PrecisionClause::View);
  scene.camera.plane_height = 9;
  scene.camera.aspect = 16;
  EXPECT_EQ(clause_of(scene), PrecisionClause::View);
}

// Gaps below 2^-16 of the larger radius; touching spheres are fine, outside and inside.
TEST(FloatVerdict, RefusesNarrowGaps) {
  const auto with_gap = [](double gap) {
    Scene scene = plain_scene();
    scene.spheres[2] = {.center = {2 + gap, 0, 0}, .radius = 1};
    return judge(scene, kHeight, 0);
  };
  EXPECT_TRUE(with_gap(0).is_accepted);
  EXPECT_TRUE(with_gap(2e-5).is_accepted);
  EXPECT_FALSE(with_gap(1e-5).is_accepted);
  EXPECT_EQ(with_gap(1e-7).bounds.deciding(), PrecisionClause::Gap);
  EXPECT_EQ(with_gap(1e-7).bounds[PrecisionClause::Gap].sphere, 2u);
  EXPECT_EQ(with_gap(1e-7).bounds[PrecisionClause::Gap].other, 1u);
  EXPECT_NEAR(with_gap(1e-7).bounds[PrecisionClause::Gap].value, 1e-7, 1e-15);
  Scene bubble = plain_scene();
  bubble.spheres.push_back({.center = {0, 0, 0}, .radius = 1 - 1e-7});
  EXPECT_FALSE(judge(bubble).is_accepted);
}

// Points on both walls have an error of 2 u of their distance, so 4 u of it is too thin.
TEST(FloatVerdict, RefusesThinShellsFarAway) {
  const auto shell = [](double distance, double wall) {
    Scene scene = plain_scene();
    scene.camera.from = {0, 0, distance};
    scene.spheres = {{.center = {0, 0, 0}, .radius = 1}, {.center = {0, 0, 0}, .radius = 1 - wall}};
    return judge(scene).is_accepted;
  };
  EXPECT_TRUE(shell(10, 2e-5));
  EXPECT_FALSE(shell(1000, 2e-5));
  EXPECT_TRUE(shell(1000, 1e-3));
}

// Spheres that touch from inside, or cross, with hardly any distance anywhere, are one surface for
// most rays.
TEST(FloatVerdict, RefusesSurfacesThatNearlyCoincide) {
  const auto with = [](double x, double radius) {
    Scene scene = plain_scene();
    scene.spheres.push_back({.center = {x, 0, 0}, .radius = radius});
    return judge(scene).is_accepted;
  };
  EXPECT_FALSE(with(1e-5, 1 - 1e-5)) << "touches from inside";
  EXPECT_FALSE(with(1e-5, 1)) << "crosses";
  EXPECT_TRUE(with(0.1, 0.9));
  EXPECT_TRUE(with(0.1, 1));
}

TEST(FloatVerdict, AllowsAnyGapAboveAGroundMetInDouble) {
  for (const double gap : {0.0, 1e-9, 1e-6, 1e-4}) {
    Scene scene = plain_scene();
    scene.spheres.push_back({.center = {0, -1001 - gap, 0}, .radius = 1000});
    EXPECT_THAT(judge(scene).exact_spheres, ElementsAre(3)) << gap;
  }
  Scene scene = plain_scene();
  scene.spheres.push_back({.center = {0, -1002, 0}, .radius = 1000});
  scene.spheres.push_back({.center = {0, -1002, 0}, .radius = 1000 - 1e-4});
  EXPECT_FALSE(judge(scene).is_accepted) << "two grounds";
}

TEST(FloatVerdict, LooksAtBothEndsOfTheShutter) {
  Scene scene = plain_scene();
  scene.spheres[2].center.x = 2 + 3e-5;
  scene.shifts = {Vec3{}, Vec3{}, Vec3{-3e-5 + 1e-7, 0, 0}};
  EXPECT_EQ(clause_of(scene), PrecisionClause::Gap);
  EXPECT_FALSE(judge(scene, kHeight, 0).is_accepted);
  scene.shifts[2] = {0, 0, 1e6};
  EXPECT_FALSE(judge(scene, kHeight, 0).is_accepted);
}

// Nearly coinciding for a moment is accepted.
TEST(FloatVerdict, AllowsSpheresThatMeetForAMoment) {
  Scene scene = plain_scene();
  scene.spheres[2] = scene.spheres[1];
  scene.shifts = {Vec3{}, Vec3{}, Vec3{0, 1, 0}};
  EXPECT_TRUE(judge(scene).is_accepted);
  scene.shifts[2] = {0, 1e-4, 0};
  EXPECT_FALSE(judge(scene).is_accepted);
}

// Between the ends of the shutter it comes nearer than at either.
TEST(FloatVerdict, LooksAtTheNearestMomentOfAMovement) {
  Scene scene = plain_scene();
  scene.spheres[2] = {.center = {-20, 1.001, 10}, .radius = 1};
  scene.shifts = {Vec3{}, Vec3{}, Vec3{40, 0, 0}};
  EXPECT_EQ(clause_of(scene), PrecisionClause::Across);
  EXPECT_EQ(judge(scene).in_float[PrecisionClause::Across].sphere, 2u);
  scene.spheres[2].center.y = 3;
  EXPECT_TRUE(judge(scene).is_accepted);
}

TEST(FloatVerdict, RefusesRadianceThatFloatCannotHold) {
  Scene scene = plain_scene();
  scene.materials[0] = {
      .color = LinearRgb{1e20}, .parameter = 1e20, .type = MaterialType::Emissive};
  EXPECT_FALSE(judge(scene).is_accepted);
  // The light that a surface absorbs of such a bright sky underflows in float along the path, but
  // counts.
  scene.materials[0] = {
      .color = LinearRgb{1e-19}, .parameter = 1, .type = MaterialType::Transmissive};
  scene.background = {.bottom = LinearRgb{1e19}, .top = LinearRgb{1e19}};
  EXPECT_TRUE(judge(scene).is_accepted);
  scene.background = {.bottom = LinearRgb{1e21}, .top = LinearRgb{1e21}};
  EXPECT_EQ(clause_of(scene), PrecisionClause::Radiance);
}

// Points on a ground in double have an error relative to their own distance.
TEST(FloatVerdict, TakesCamerasRightAboveAGroundMetInDouble) {
  Scene scene = plain_scene();
  scene.camera.from = {0, 1e-6, 0};
  scene.camera.at = {0, 0, -4};
  for (Sphere& sphere : scene.spheres) sphere.center = sphere.center + Vec3{0, 1, -9};
  scene.spheres.push_back({.center = {0, -1000, 0}, .radius = 1000});
  EXPECT_THAT(judge(scene).exact_spheres, ElementsAre(3));
}

// Surfaces that reflect more than they receive multiply the light along a path.
TEST(FloatVerdict, RefusesRadianceThatGrowsPastFloatAlongAPath) {
  Scene scene = plain_scene();
  scene.materials[0].color = LinearRgb{2};
  const auto accepted = [&](int depth) {
    return judge_float(scene, scene.camera, {.depth = depth}).is_accepted;
  };
  EXPECT_TRUE(accepted(50));
  EXPECT_FALSE(accepted(200));
  scene.materials[0].color = LinearRgb{1e-40};
  EXPECT_FALSE(accepted(50));
}

TEST(PrecisionBounds, InDoubleAreThoseOfItsRounding) {
  Scene scene = plain_scene();
  const auto bounds = [&] {
    return judge_precision(scene, scene.camera, {.height = kHeight}, Precision::Double);
  };
  EXPECT_TRUE(bounds().is_accepted());
  EXPECT_NEAR(bounds()[PrecisionClause::Hit].value, 25 * 0x1p-53 * (std::sqrt(116.0) + 1), 1e-20);
  scene.spheres[1].radius = 1e-11;
  EXPECT_TRUE(bounds().is_accepted());
  scene.spheres[1].radius = 1e-13;
  EXPECT_FALSE(bounds().is_accepted());
  EXPECT_EQ(bounds().deciding(), PrecisionClause::Hit);
  EXPECT_EQ(bounds()[PrecisionClause::Hit].sphere, 1u);
}

TEST(PrecisionBounds, LookForGapsAmongManySpheresWhereNothingElseIsBroken) {
  Scene scene = plain_scene();
  while (scene.spheres.size() < 1000) {
    const auto i = static_cast<double>(scene.spheres.size());
    scene.spheres.push_back({.center = {4 * i, 0, 0}, .radius = 1});
  }
  EXPECT_TRUE(judge(scene).is_accepted);
  Scene on_ground = scene;
  on_ground.spheres.push_back({.center = {0, -6.371e6 - 1, 0}, .radius = 6.371e6});
  EXPECT_THAT(judge(on_ground).exact_spheres, ElementsAre(1000));
  scene.spheres.push_back({.center = {0, 9, 0}, .radius = 1});
  scene.spheres.push_back({.center = {0, 9, 0}, .radius = 1 - 1e-6});
  const PrecisionBounds of_shell = judge_precision(scene, scene.camera, {}, Precision::Float);
  EXPECT_TRUE(of_shell.near_pairs);
  EXPECT_EQ(of_shell.deciding(), PrecisionClause::Gap);
  EXPECT_EQ(of_shell[PrecisionClause::Gap].sphere, 1001u);
  EXPECT_EQ(of_shell[PrecisionClause::Gap].other, 1000u);
  scene.spheres.push_back({.center = {0, 20, 0}, .radius = 1e-3});
  EXPECT_FALSE(judge_precision(scene, scene.camera, {}, Precision::Float).near_pairs);
  EXPECT_TRUE(judge_precision(scene, scene.camera, {}, Precision::Double).is_accepted());
}

TEST(PrecisionBounds, HoldAtTheMomentWhenCentresAreNearest) {
  Scene scene = plain_scene();
  scene.spheres = {{.center = {0, -0.005, -4}, .radius = 1},
                   {.center = {0, 0.005, -4}, .radius = 1}};
  scene.shifts = {{0, 0.01, 0}, {0, -0.01, 0}};
  EXPECT_EQ(clause_of(scene), PrecisionClause::Gap);
  EXPECT_FALSE(judge(scene).is_accepted);
  scene.shifts = {{0, -0.01, 0}, {0, 0.01, 0}};
  EXPECT_TRUE(judge(scene).is_accepted);
}

TEST(ScaleRatio, IsTheReachInRadiiOfTheSmallestSphere) {
  Scene scene = plain_scene();
  scene.spheres[1].radius = 0.5;
  for (const double scale : {1e-300, 1.0, 1e300}) {
    Scene scaled = scene;
    scaled.camera.from = scene.camera.from * scale;
    for (Sphere& sphere : scaled.spheres) {
      sphere.center = sphere.center * scale;
      sphere.radius *= scale;
    }
    const ScaleRatio ratio = measure_scale(scaled, scaled.camera);
    EXPECT_NEAR(ratio.ratio, (std::sqrt(116.0) + 1) / 0.5, 1e-9) << scale;
    EXPECT_EQ(ratio.smallest, 1u);
    EXPECT_EQ(ratio.farthest, 0u);
  }
  // A sphere that underflows in the others' unit still counts.
  scene.spheres[1].radius = 1e-320;
  scene.spheres[2].center.x = 1e300;
  EXPECT_GT(measure_scale(scene, scene.camera).ratio, 1e300);
}

}  // namespace
}  // namespace sdlc::render
