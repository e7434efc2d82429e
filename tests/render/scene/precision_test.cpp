#include "render/scene/precision.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kHeight = 540;

/// Three spheres of radius 1 before the camera, 4 from each other.
Scene plain_scene() {
  Scene scene;
  scene.camera = {.from = {0, 0, 10}, .at = {0, 0, 0}, .plane_height = 1};
  scene.materials = {Material{.color = LinearRgb{0.5}}};
  scene.spheres = {{.center = {-4, 0, 0}, .radius = 1},
                   {.center = {0, 0, 0}, .radius = 1},
                   {.center = {4, 0, 0}, .radius = 1}};
  return scene;
}

FloatVerdict judge(const Scene& scene, int height = kHeight) {
  return judge_float(scene, height, 2);
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
  EXPECT_THAT(judge(scene).reason, HasSubstr("too large for its smallest sphere"));
}

TEST(FloatVerdict, TakesLargeSpheresOutOfTheBounds) {
  Scene scene = plain_scene();
  scene.spheres.push_back({.center = {0, -10002, 0}, .radius = 10000});
  EXPECT_TRUE(judge(scene).is_accepted);
  EXPECT_THAT(judge(scene).exact_spheres, ElementsAre(3));
  // Two of that size are as many as may be; where even points on them are too coarse, none.
  scene.spheres.push_back({.center = {0, 10002, 0}, .radius = 10000});
  EXPECT_THAT(judge(scene).exact_spheres, ElementsAre(3, 4));
  scene.spheres.push_back({.center = {0, 0, -10010}, .radius = 10000});
  EXPECT_FALSE(judge(scene).is_accepted);
  // Points on one: 2 u E ≤ r / 100 with r = 1: E, which is 2 R + 2, at most 83886.
  Scene large = plain_scene();
  large.spheres.push_back({.center = {0, -41002, 0}, .radius = 41000});
  EXPECT_THAT(judge(large).exact_spheres, ElementsAre(3));
  large.spheres[3] = {.center = {0, -43002, 0}, .radius = 43000};
  EXPECT_FALSE(judge(large).is_accepted);
  Scene earth = plain_scene();
  earth.spheres.push_back({.center = {0, -6.371e6 - 2, 0}, .radius = 6.371e6});
  EXPECT_FALSE(judge(earth).is_accepted);
}

// Across the view: 2 u E ≤ d · pixel / 16 with E = 5.1 and a pixel of 1/540: d ≥ 0.0053.
TEST(FloatVerdict, RefusesSurfacesThatAreTooNear) {
  Scene scene = plain_scene();
  scene.camera.from = {0, 0, 1.006};
  EXPECT_TRUE(judge_float(scene, kHeight, 0).is_accepted);
  scene.camera.from = {0, 0, 1.0045};
  EXPECT_FALSE(judge_float(scene, kHeight, 0).is_accepted);
  EXPECT_THAT(judge_float(scene, kHeight, 0).reason, HasSubstr("near"));
  scene.camera.from = {0, 0, 1};  // on it: it counts as left
  EXPECT_TRUE(judge(scene).is_accepted);
}

TEST(FloatVerdict, RefusesNarrowPixels) {
  EXPECT_TRUE(judge(plain_scene(), 40000).is_accepted);
  EXPECT_FALSE(judge(plain_scene(), 2'000'000).is_accepted);
  EXPECT_THAT(judge(plain_scene(), 2'000'000).reason, HasSubstr("narrower"));
  // 16 u is a part in 1048576. What is not on the camera's own surface is too near long before.
  Scene on_sphere = plain_scene();
  on_sphere.spheres = {{.center = {0, 0, 9}, .radius = 1}};
  EXPECT_TRUE(judge(on_sphere, 1'000'000).is_accepted);
  EXPECT_THAT(judge(on_sphere, 1'100'000).reason, HasSubstr("narrower"));
}

TEST(FloatVerdict, RefusesViewsOfNearlyHalfTheSphere) {
  Scene scene = plain_scene();
  scene.camera.plane_height = 9e5;
  scene.camera.aspect = 1;
  EXPECT_TRUE(judge(scene).is_accepted);
  scene.camera.plane_height = 1.1e6;
  EXPECT_THAT(judge(scene).reason, HasSubstr("too wide"));
  scene.camera.plane_height = 9e4;
  scene.camera.aspect = 16;
  EXPECT_THAT(judge(scene).reason, HasSubstr("too wide"));
}

// Gaps below 2^-16 of the larger radius; touching spheres are fine, outside and inside.
TEST(FloatVerdict, RefusesNarrowGaps) {
  const auto with_gap = [](double gap) {
    Scene scene = plain_scene();
    scene.spheres[2] = {.center = {2 + gap, 0, 0}, .radius = 1};
    return judge(scene);
  };
  EXPECT_TRUE(with_gap(0).is_accepted);
  EXPECT_TRUE(with_gap(2e-5).is_accepted);
  EXPECT_THAT(with_gap(2e-5).exact_spheres, IsEmpty());
  EXPECT_THAT(with_gap(1e-7).reason, HasSubstr("close"));
  Scene bubble = plain_scene();
  bubble.spheres.push_back({.center = {0, 0, 0}, .radius = 1 - 1e-7});
  EXPECT_FALSE(judge(bubble).is_accepted);
}

TEST(FloatVerdict, LooksAtBothEndsOfTheShutter) {
  Scene scene = plain_scene();
  scene.shifts = {Vec3{}, Vec3{}, Vec3{-2 + 1e-7, 0, 0}};
  EXPECT_FALSE(judge(scene).is_accepted);
  scene.shifts[2] = {0, 0, 1e6};
  EXPECT_FALSE(judge(scene).is_accepted);
}

TEST(FloatVerdict, RefusesRadianceThatFloatCannotHold) {
  Scene scene = plain_scene();
  scene.materials[0] = {
      .color = LinearRgb{1e20}, .parameter = 1e20, .type = MaterialType::Emissive};
  EXPECT_FALSE(judge(scene).is_accepted);
}

}  // namespace
}  // namespace sdlc::render
