#include "render/light/emitter_tally.hpp"

#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/statistics/scenes.hpp"

namespace sdlc::render {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Spheres 1 and 3 shine.
Scene two_emitters() {
  Scene scene = test::beam_scene({0, 0, 4}, {0, 0, 0}, LinearRgb{});
  test::add_sphere(scene, {0, 0, 0}, 1, test::diffuse(LinearRgb{1}));
  test::add_sphere(scene, {2, 0, 0}, 1, test::emissive(LinearRgb{1}, 2));
  test::add_sphere(scene, {4, 0, 0}, 1, test::unlit(LinearRgb{1}));
  test::add_sphere(scene, {6, 0, 0}, 1, test::emissive(LinearRgb{1}, 2));
  test::add_sphere(scene, {8, 0, 0}, 0, test::emissive(LinearRgb{1}, 2));
  return scene;
}

void count(EmitterTally& tally, std::uint32_t sphere, int times) {
  for (int i = 0; i < times; ++i) tally.count(sphere);
}

TEST(EmitterTally, TellsWhichEmittersFewPathsReached) {
  EmitterTally tally(two_emitters());
  EXPECT_THAT(tally.scarce(), ElementsAre(ReachedEmitter{1, 0}, ReachedEmitter{3, 0}));
  count(tally, 0, 50);
  count(tally, 1, 29);
  count(tally, 3, 300);
  EXPECT_TRUE(tally.is_counting());
  EXPECT_THAT(tally.scarce(), ElementsAre(ReachedEmitter{1, 29}));
  count(tally, 1, 1);
  EXPECT_FALSE(tally.is_counting());
  EXPECT_THAT(tally.scarce(), IsEmpty());
}

TEST(EmitterTally, HasNothingToCountWithoutEmitters) {
  EXPECT_FALSE(EmitterTally(test::beam_scene({0, 0, 4}, {0, 0, 0}, LinearRgb{})).is_counting());
}

TEST(EmitterTally, LosesNothingThatSeveralThreadsCount) {
  for (int round = 0; round < 50; ++round) {
    EmitterTally tally(two_emitters());
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
