#include "render/shading/choose_lights.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/statistics/random.hpp"
#include "tests/support/statistics/scaled_scene.hpp"
#include "tests/support/statistics/scenes.hpp"

namespace sdlc::render {
namespace {

using test::add_sphere;
using test::diffuse;
using test::emissive;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr LinearRgb kWhite{1};

/// A few spheres on a ground under a dark sky, in view of the camera.
Scene still_life() {
  Scene scene = test::beam_scene({0, 1, 4}, {0, 0, 0}, LinearRgb{});
  add_sphere(scene, {0, -100.5, 0}, 100, diffuse({0.5, 0.6, 0.3}));
  add_sphere(scene, {-1, 0, 0}, 0.5, diffuse({0.8, 0.2, 0.3}));
  add_sphere(scene, {1, 0, 0}, 0.5, test::specular({0.8, 0.9, 0.3}, 0.3));
  return scene;
}

/// Lights around the point (0, 30, 0), some of them far from each other.
void add_lights(Scene& scene, int count, double radius, double intensity) {
  test::Random random(1);
  for (int i = 0; i < count; ++i) {
    const Vec3 place = Vec3{0, 30, 0} + random.in_box(20);
    add_sphere(scene, place, radius, emissive(kWhite, intensity));
  }
}

std::size_t sampled(const Scene& scene) { return choose_lights(scene, LightSampling::Auto).size(); }

TEST(ChooseLights, OnTakesAllThatShineAndCanBeHitAndOffNone) {
  Scene scene = still_life();
  add_sphere(scene, {0, 3, 0}, 2, emissive(kWhite, 1));
  add_sphere(scene, {0, 5, 0}, 0, emissive(kWhite, 1));
  add_sphere(scene, {0, 6, 0}, 1, emissive(kWhite, 0));
  add_sphere(scene, {0, 7, 0}, 1, emissive(LinearRgb{}, 1));
  add_sphere(scene, {0, 8, 0}, 1, test::unlit(kWhite));
  add_sphere(scene, {0, 9, 0}, 0.1, emissive({0, 0, 1}, 1));
  EXPECT_THAT(choose_lights(scene, LightSampling::On), ElementsAre(3, 8));
  EXPECT_THAT(choose_lights(scene, LightSampling::Off), IsEmpty());
}

TEST(ChooseLights, AutoTakesSmallBrightOnesInTheDark) {
  for (const int count : {1, 8, 3000}) {
    Scene scene = still_life();
    add_lights(scene, count, 0.3, 500.0 / count);
    EXPECT_EQ(sampled(scene), static_cast<std::size_t>(count));
  }
}

TEST(ChooseLights, AutoLeavesSmallOnesOutWhereALargeOneShinesAsBright) {
  Scene scene = still_life();
  add_lights(scene, 8, 0.5, 1);
  add_sphere(scene, {0, 110, 0}, 100, emissive(kWhite, 1));
  EXPECT_EQ(sampled(scene), 0u);
}

TEST(ChooseLights, AutoTakesSmallOnesAloneWhereALargeOneIsDim) {
  Scene scene = still_life();
  add_lights(scene, 8, 0.5, 500);
  add_sphere(scene, {0, 110, 0}, 100, emissive(kWhite, 0.01));
  EXPECT_THAT(choose_lights(scene, LightSampling::Auto), ElementsAre(3, 4, 5, 6, 7, 8, 9, 10));
}

TEST(ChooseLights, AutoTakesNoneThatTheSkyOutshines) {
  Scene scene = still_life();
  add_lights(scene, 3, 0.3, 20);
  EXPECT_EQ(sampled(scene), 3u);
  scene.background = {};
  EXPECT_EQ(sampled(scene), 0u);
}

TEST(ChooseLights, AutoKnowsThatNoSkyIsSeenFromAClosedRoom) {
  Scene scene = still_life();
  add_lights(scene, 3, 0.3, 20);
  scene.background = {};
  add_sphere(scene, {0, 0, 0}, 300, diffuse(kWhite));
  EXPECT_EQ(sampled(scene), 3u);
}

TEST(ChooseLights, AutoTakesNoneWhereNothingIsDiffuse) {
  Scene scene = test::beam_scene({0, 1, 4}, {0, 0, 0}, LinearRgb{});
  add_sphere(scene, {0, 0, 0}, 1, test::specular(kWhite, 0.1));
  add_sphere(scene, {0, 3, 0}, 0.1, emissive(kWhite, 1000));
  EXPECT_EQ(sampled(scene), 0u);
}

TEST(ChooseLights, AutoDoesNotDependOnUnitsOfLengthOrLight) {
  for (const double sky : {0.0, 0.2, 0.4, 0.8, 1.6}) {
    Scene scene = still_life();
    add_lights(scene, 3, 0.3, 50);
    scene.background = {.bottom = LinearRgb{sky}, .top = LinearRgb{sky}};
    const std::size_t expected = sampled(scene);
    for (const int exponent : {600, 60, -60, -600}) {
      EXPECT_EQ(sampled(test::scaled(scene, exponent)), expected);
    }
    const double factor = 0x1p900;
    scene.background = {.bottom = LinearRgb{sky * factor}, .top = LinearRgb{sky * factor}};
    for (std::size_t i = 3; i < scene.materials.size(); ++i) {
      scene.materials[i].parameter *= factor;
    }
    EXPECT_EQ(sampled(scene), expected);
  }
}

}  // namespace
}  // namespace sdlc::render
