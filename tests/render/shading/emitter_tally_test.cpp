#include "render/shading/emitter_tally.hpp"

#include <cmath>
#include <cstdint>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/statistics/scenes.hpp"

namespace sdlc::render {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using enum LightPath;

/// Spheres 1 and 3 emit light.
Scene two_emitters() {
  Scene scene = test::beam_scene({0, 0, 4}, {0, 0, 0}, LinearRgb{});
  test::add_sphere(scene, {0, 0, 0}, 1, test::diffuse(LinearRgb{1}));
  test::add_sphere(scene, {2, 0, 0}, 1, test::emissive(LinearRgb{1}, 2));
  test::add_sphere(scene, {4, 0, 0}, 1, test::unlit(LinearRgb{1}));
  test::add_sphere(scene, {6, 0, 0}, 1, test::emissive(LinearRgb{1}, 2));
  test::add_sphere(scene, {8, 0, 0}, 0, test::emissive(LinearRgb{1}, 2));
  return scene;
}

constexpr int kDepth = 4;

void count(EmitterTally& tally, std::uint32_t sphere, int times,
           LightPath kind = LightPath::Direct) {
  for (int i = 0; i < times; ++i) tally.count(sphere, kind);
}

/// The rare kinds of path, for the class of one sphere.
std::vector<LightPath> rare_kinds(const EmitterTally& tally, std::uint32_t sphere) {
  std::vector<LightPath> kinds;
  for (const RarePath& path : tally.rare()) {
    if (path.sphere == sphere) kinds.push_back(path.kind);
  }
  return kinds;
}

TEST(EmitterTally, TellsWhichEmittersFewPathsReached) {
  const EmitterClasses classes(two_emitters(), {});
  EmitterTally tally(classes, kDepth);
  EXPECT_THAT(tally.scarce(), ElementsAre(ReachedEmitter{1, 0}, ReachedEmitter{3, 0}));
  count(tally, 0, 50);
  count(tally, 1, 29);
  count(tally, 3, 300);
  EXPECT_TRUE(tally.is_counting());
  EXPECT_THAT(tally.scarce(), ElementsAre(ReachedEmitter{1, 29}));
  count(tally, 1, 1);
  EXPECT_THAT(tally.scarce(), IsEmpty());
}

TEST(EmitterTally, HasNothingToCountWithoutEmitters) {
  const Scene scene = test::beam_scene({0, 0, 4}, {0, 0, 0}, LinearRgb{});
  EXPECT_FALSE(EmitterTally(EmitterClasses(scene, {}), kDepth).is_counting());
}

/// Seen along −z through a narrow beam: a diffuse ball, and lights in front of and behind the
/// camera.
Scene lights_around(const Material& ball) {
  Scene scene = test::beam_scene({0, 0, 4}, {0, 0, 0}, LinearRgb{});
  test::add_sphere(scene, {0, 0, 0}, 1, test::diffuse(LinearRgb{1}));
  test::add_sphere(scene, {0, 3, 0}, 1, ball);
  test::add_sphere(scene, {0, 0, 9}, 1, test::emissive(LinearRgb{1}, 2));
  test::add_sphere(scene, {0, 0, -9}, 1, test::emissive(LinearRgb{1}, 64));
  test::add_sphere(scene, {0, 9, 9}, 1, test::unlit(LinearRgb{1.5}));
  return scene;
}

TEST(EmitterTally, CountsTheKindsOfPathThatTheSceneMakesPossible) {
  const Scene matt = lights_around(test::diffuse(LinearRgb{1}));
  EXPECT_THAT(rare_kinds(EmitterTally(EmitterClasses(matt, {}), kDepth), 2), ElementsAre(Direct));
  EXPECT_THAT(rare_kinds(EmitterTally(EmitterClasses(matt, {}), kDepth), 3),
              ElementsAre(Visible, Direct));
  EXPECT_THAT(rare_kinds(EmitterTally(EmitterClasses(matt, {}), 1), 3), ElementsAre(Visible));
  // Unlit ones emit too; this one belongs to the class of sphere 2.
  EXPECT_EQ(EmitterTally(EmitterClasses(matt, {}), kDepth).rare().size(), 3u);

  const Scene glass = lights_around(test::transmissive(LinearRgb{1}, 1.5));
  EXPECT_THAT(rare_kinds(EmitterTally(EmitterClasses(glass, {}), kDepth), 3),
              ElementsAre(Visible, Reflected, Direct, Caustic));
  EXPECT_THAT(rare_kinds(EmitterTally(EmitterClasses(glass, {}), 2), 3),
              ElementsAre(Visible, Reflected, Direct));
  // Wide metal at which lights are sampled is like a diffuse surface.
  const auto of_ball = [](double fuzz, bool samples_at_metal) {
    const Scene metal = lights_around(test::specular(LinearRgb{1}, fuzz));
    const EmitterClasses classes(metal, {}, {}, false, samples_at_metal);
    return rare_kinds(EmitterTally(classes, kDepth), 3);
  };
  EXPECT_THAT(of_ball(0.25, true), ElementsAre(Visible, Direct));
  EXPECT_THAT(of_ball(0.24, true), ElementsAre(Visible, Reflected, Direct, Caustic));
  EXPECT_THAT(of_ball(0.25, false), ElementsAre(Visible, Reflected, Direct, Caustic));
  // Connections find sampled lights.
  const std::vector<std::uint32_t> lights{2, 3};
  EXPECT_THAT(rare_kinds(EmitterTally(EmitterClasses(glass, lights), kDepth), 3),
              ElementsAre(Visible, Reflected, Caustic));
  EXPECT_THAT(rare_kinds(EmitterTally(EmitterClasses(glass, lights), kDepth), 4),
              ElementsAre(Reflected, Direct, Caustic));
}

// The lamp is beside the view of a pinhole, and within the blur of a lens.
TEST(EmitterTally, CountsWhatOnlyALensShows) {
  Scene scene = test::beam_scene({0, 0, 4}, {0, 0, 0}, LinearRgb{});
  scene.camera.plane_height = 0.1;
  test::add_sphere(scene, {0, 0, 0}, 0.5, test::diffuse(LinearRgb{1}));
  test::add_sphere(scene, {2, 0, 0}, 1, test::emissive(LinearRgb{1}, 2));
  EXPECT_THAT(rare_kinds(EmitterTally(EmitterClasses(scene, {}), kDepth), 1), ElementsAre(Direct));
  scene.camera.aperture = 2.5;
  scene.camera.focus = 8;
  EXPECT_THAT(rare_kinds(EmitterTally(EmitterClasses(scene, {}), kDepth), 1),
              ElementsAre(Visible, Direct));
}

// A lamp that connections have reached a thousand times may cause a caustic that nothing found.
TEST(EmitterTally, CountsKindsOfPathApart) {
  const std::vector<std::uint32_t> lights{2, 3};
  const Scene scene = lights_around(test::transmissive(LinearRgb{1}, 1.5));
  const EmitterClasses classes(scene, lights);
  EmitterTally tally(classes, kDepth);
  count(tally, 3, 1000, Direct);
  count(tally, 3, 1000, Visible);
  count(tally, 3, 255, Reflected);
  count(tally, 3, 1, Caustic);
  EXPECT_THAT(rare_kinds(tally, 3), ElementsAre(Caustic));
  EXPECT_THAT(tally.scarce(), ElementsAre(ReachedEmitter{2, 0}));
  count(tally, 3, 1, Caustic);
  EXPECT_THAT(rare_kinds(tally, 3), IsEmpty());
}

/// The kinds of path to sphere 3 that are rare before any path was found, with one ball as caster.
std::vector<LightPath> rare_with_caster(const Scene& scene, bool has_all_glints,
                                        bool samples_at_metal = false) {
  const std::vector<std::uint32_t> lights{2, 3}, casters{1};
  const EmitterClasses classes(scene, lights, casters, has_all_glints, samples_at_metal);
  return rare_kinds(EmitterTally(classes, kDepth), 3);
}

TEST(EmitterTally, CountsOnlyTheSpecularPathsThatConnectionsCannotFind) {
  Scene scene = lights_around(test::transmissive(LinearRgb{1}, 1.5));
  EXPECT_THAT(rare_with_caster(scene, true), ElementsAre(Visible));
  EXPECT_THAT(rare_with_caster(scene, false), ElementsAre(Visible, Reflected));
  // A second ball: light comes by way of both.
  Scene with_two = scene;
  test::add_sphere(with_two, {3, 3, 0}, 1, test::specular(LinearRgb{1}, 0));
  EXPECT_THAT(rare_with_caster(with_two, true), ElementsAre(Visible, Reflected, Caustic));
  // From wide metal no connection is made by way of the ball.
  Scene with_metal = scene;
  test::add_sphere(with_metal, {3, 3, 0}, 1, test::specular(LinearRgb{1}, 0.5));
  EXPECT_THAT(rare_with_caster(with_metal, true, true), ElementsAre(Visible, Reflected, Caustic));
  // Something in the glass, and a lamp there.
  Scene with_core = scene;
  test::add_sphere(with_core, {0, 3, 0}, 0.5, test::diffuse(LinearRgb{1}));
  EXPECT_THAT(rare_with_caster(with_core, true), ElementsAre(Visible, Reflected, Caustic));
  Scene with_lamp = scene;
  with_lamp.spheres[3] = {.center = {0, 3, 0.5}, .radius = 0.1, .material = 3};
  EXPECT_THAT(rare_with_caster(with_lamp, true), ElementsAre(Reflected, Caustic));
  // A lamp that moves into it.
  Scene moving = scene;
  moving.shifts.assign(moving.spheres.size(), Vec3{});
  moving.shifts[3] = {0, 3, 18};
  EXPECT_THAT(rare_with_caster(moving, false), ElementsAre(Visible, Reflected, Caustic));
}

// A path that no connection could have found shows that there are others.
TEST(EmitterTally, ReportsPathsThatWereNotExpected) {
  const std::vector<std::uint32_t> lights{2, 3}, casters{1};
  const EmitterClasses classes(lights_around(test::transmissive(LinearRgb{1}, 1.5)), lights,
                               casters, true);
  EmitterTally tally(classes, kDepth);
  count(tally, 3, 255, Visible);
  EXPECT_THAT(rare_kinds(tally, 3), IsEmpty());
  EXPECT_TRUE(tally.is_counting());
  count(tally, 3, 1, Caustic);
  EXPECT_THAT(rare_kinds(tally, 3), ElementsAre(Caustic));
  EmitterTally restored(classes, kDepth);
  restored.restore(tally.counts());
  EXPECT_THAT(rare_kinds(restored, 3), ElementsAre(Caustic));
  count(tally, 3, 1, Caustic);
  EXPECT_THAT(rare_kinds(tally, 3), IsEmpty());
}

TEST(LightPath, IsNamedAfterWhatThePathMet) {
  EXPECT_EQ(light_path({}), Visible);
  EXPECT_EQ(light_path({.has_scattered = true}), Reflected);
  EXPECT_EQ(light_path({true, true, true}), Direct);
  EXPECT_EQ(light_path({true, true, false}), Caustic);
}

// 95 % limits of the Poisson distribution, from tables: 2.996 and 4.744 for 0 and 1.
TEST(UnseenError, IsThatOfAsManyPathsAsMayHaveBeenMissed) {
  const auto error = [](std::uint32_t paths) {
    const std::vector<RarePath> rare{{Caustic, paths, 0, 3.0}};
    return unseen_error(rare, 0.5, 100, 8);
  };
  EXPECT_NEAR(error(0), 3 * 2.996 / (10 * 8) / 0.5, 3e-3);
  EXPECT_NEAR(error(1), 3 * 4.744 / (10 * 8) / 0.5, 3e-3);
  EXPECT_NEAR(error(2), 3.0 / (10 * 8) / 0.5, 1e-12);  // one path more or less
  EXPECT_EQ(unseen_error({}, 0, 100, 8), 0);
}

TEST(EmitterTally, LosesNothingThatSeveralThreadsCount) {
  for (int round = 0; round < 50; ++round) {
    const EmitterClasses classes(two_emitters(), {});
    EmitterTally tally(classes, kDepth);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&] {
        count(tally, 1, 7);
        count(tally, 3, 100);
      });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_THAT(tally.scarce(), ElementsAre(ReachedEmitter{1, 28}));
  }
}

}  // namespace
}  // namespace sdlc::render
