#include "render/shading/light_tree.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/reference/light_choice.hpp"
#include "tests/support/statistics/random.hpp"

namespace sdlc::render {
namespace {

using test::reference::choose_light;
using test::reference::LightChoice;
using test::reference::probability_of;

std::vector<LightSphere> random_balls(int count, unsigned seed) {
  test::Random random(seed);
  std::vector<LightSphere> balls;
  for (int i = 0; i < count; ++i) {
    balls.push_back({.center = random.in_box(1),
                     .shift = i % 3 == 0 ? random.in_box(0.2) : Vec3{},
                     .radius = std::exp(random.between(-9, -2)),
                     .power = std::exp(random.between(-5, 5))});
  }
  return balls;
}

/// Points near the lights and far from them, with every direction of the normal.
template <typename Body>
void for_places(const Body& body) {
  test::Random random(3);
  for (int i = 0; i < 50; ++i) body(random.in_box(i % 2 == 0 ? 1 : 3), random.direction());
}

TEST(LightTree, IsSureOfTheOnlyLight) {
  const LightTree tree(random_balls(1, 1));
  const LightChoice choice = choose_light(tree, {5, 5, 5}, {1, 0, 0}, {0.99, 0});
  EXPECT_EQ(choice.leaf, 0u);
  EXPECT_EQ(choice.probability, 1);
}

TEST(LightTree, GivesProbabilitiesThatAddUpToOneWhereAllIsAboveTheHorizon) {
  for (const int count : {1, 2, 3, 7, 64, 1000}) {
    const LightTree tree(random_balls(count, 2));
    double sum = 0;
    for (std::uint32_t leaf = 0; leaf < tree.lights_of_leaves().size(); ++leaf) {
      const double p = probability_of(tree, leaf, {0, -9, 0}, {0, 1, 0});
      EXPECT_GE(p, 0);
      EXPECT_EQ(p == 0, tree.lights_of_leaves()[leaf] == kNoLight);
      sum += p;
    }
    EXPECT_NEAR(sum, 1, 1e-12) << count;
  }
}

TEST(LightTree, HoldsEveryLightOnce) {
  const LightTree tree(random_balls(1000, 4));
  std::vector<std::uint32_t> found;
  for (const std::uint32_t ball : tree.lights_of_leaves()) {
    if (ball != kNoLight) found.push_back(ball);
  }
  std::ranges::sort(found);
  ASSERT_EQ(found.size(), 1000u);
  for (std::uint32_t i = 0; i < 1000; ++i) EXPECT_EQ(found[i], i);
}

// Both techniques of light sampling weigh with the same numbers, otherwise the weights do not add
// up to 1.
TEST(LightTree, ChoosesWithTheProbabilityThatItTellsOfALeafToTheBit) {
  test::Random random(5);
  for (const int count : {2, 5, 300, 5000}) {
    const LightTree tree(random_balls(count, 6));
    for_places([&](Vec3 x, Vec3 normal) {
      for (int i = 0; i < 20; ++i) {
        const auto choice =
            choose_light(tree, x, normal, {random.between(0, 1), random.between(0, 1)});
        if (choice.probability == 0) continue;
        EXPECT_EQ(choice.probability, probability_of(tree, choice.leaf, x, normal));
      }
    });
  }
}

// The unit interval of the random number is divided into one piece per leaf, with the length of its
// probability.
TEST(LightTree, ChoosesEachLeafAsOftenAsItSays) {
  const LightTree tree(random_balls(21, 7));
  for_places([&](Vec3 x, Vec3 normal) {
    constexpr int kSteps = 20000;
    std::vector<double> share(tree.lights_of_leaves().size());
    for (int i = 0; i < kSteps; ++i) {
      const auto choice = choose_light(tree, x, normal, {(i + 0.5) / kSteps, 0});
      if (choice.probability > 0) share[choice.leaf] += 1.0 / kSteps;
    }
    for (std::uint32_t leaf = 0; leaf < share.size(); ++leaf) {
      EXPECT_NEAR(share[leaf], probability_of(tree, leaf, x, normal), 2.0 / kSteps);
    }
  });
}

TEST(LightTree, NeverChoosesWhatIsBelowTheHorizonNorLeavesOutWhatIsAbove) {
  const std::vector<LightSphere> balls = random_balls(300, 8);
  const LightTree tree(balls);
  for_places([&](Vec3 x, Vec3 normal) {
    for (std::uint32_t leaf = 0; leaf < tree.lights_of_leaves().size(); ++leaf) {
      const std::uint32_t i = tree.lights_of_leaves()[leaf];
      if (i == kNoLight) continue;
      const double opening = dot(balls[i].center - x, normal);
      const double closing = dot(balls[i].center + balls[i].shift - x, normal);
      const double height = std::fmax(opening, closing) + balls[i].radius;
      const double p = probability_of(tree, leaf, x, normal);
      EXPECT_TRUE(p > 0 || height < 1e-12);
      // The bounding sphere of a moving one is larger than it is.
      EXPECT_TRUE(p == 0 || height > -1e-12 || balls[i].shift != Vec3{});
    }
  });
}

TEST(LightTree, PrefersWhatIsNearBrightAndUpright) {
  const auto share_of_first = [](const LightSphere& a, const LightSphere& b) {
    const LightTree tree({a, b});
    const std::uint32_t leaf = tree.lights_of_leaves()[0] == 0 ? 0 : 1;
    return probability_of(tree, leaf, {0, 0, 0}, {0, 1, 0});
  };
  const LightSphere up{.center = {0, 2, 0}, .shift = {}, .radius = 0.01, .power = 1};
  LightSphere other = up;
  other.center = {0, 4, 0};
  EXPECT_NEAR(share_of_first(up, other), 0.8, 0.01);
  other.center = {2 * std::sqrt(0.75), 1, 0};
  EXPECT_NEAR(share_of_first(up, other), 2.0 / 3, 0.01);
  other = up;
  other.center.x = 1e-6;
  other.power = 3;
  EXPECT_NEAR(share_of_first(up, other), 0.25, 0.01);
}

}  // namespace
}  // namespace sdlc::render
