#include "render/exactness/near_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "render/parallel/workers.hpp"
#include "tests/support/statistics/random.hpp"

namespace sdlc::render {
namespace {

using test::Random;

constexpr Nearness kNearness{
    .gap_of_extent = 1e-3, .gap_of_radius = 0.01, .spread_of_extent = 0.02};

std::vector<SpherePair> near_pairs(const Scene& scene, const Nearness& nearness,
                                   std::span<const std::uint32_t> left_out = {}) {
  const auto pairs = find_near_pairs(scene, scene.camera.from, nearness, left_out);
  EXPECT_TRUE(pairs) << "too much";
  return pairs.value_or(std::vector<SpherePair>{});
}

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Pairs as_set(const std::vector<SpherePair>& pairs) {
  Pairs set;
  for (const SpherePair& pair : pairs) {
    EXPECT_LT(pair.first, pair.second);
    EXPECT_TRUE(set.insert({pair.first, pair.second}).second) << "twice";
  }
  return set;
}

double extent_of(const Scene& scene) {
  double extent = 0;
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
    const Vec3 opening = scene.spheres[i].center - scene.camera.from;
    const Vec3 closing = scene.shifts.empty() ? opening : opening + scene.shifts[i];
    extent = std::max(extent, std::max(length(opening), length(closing)) + scene.spheres[i].radius);
  }
  return extent;
}

/// By the definition, at a hundred moments: some that are near only for a moment may be missing.
Pairs near_at_moments(const Scene& scene) {
  const double extent = extent_of(scene);
  Pairs pairs;
  for (std::uint32_t a = 0; a < scene.spheres.size(); ++a) {
    for (std::uint32_t b = a + 1; b < scene.spheres.size(); ++b) {
      const Sphere &s = scene.spheres[a], &t = scene.spheres[b];
      const double sum = s.radius + t.radius, difference = std::fabs(s.radius - t.radius);
      const double gap = std::max(kNearness.gap_of_extent * extent,
                                  kNearness.gap_of_radius * std::max(s.radius, t.radius));
      for (int moment = 0; moment <= (scene.shifts.empty() ? 0 : 100); ++moment) {
        const Vec3 way = scene.shifts.empty() ? Vec3{} : scene.shifts[a] - scene.shifts[b];
        const double apart = length(s.center - t.center + way * (moment / 100.0));
        if (std::fabs(apart - sum) <= gap || std::fabs(apart - difference) <= gap ||
            (apart <= sum && apart + difference <= kNearness.spread_of_extent * extent)) {
          pairs.insert({a, b});
        }
      }
    }
  }
  return pairs;
}

/// More than are compared pairwise, many of them near each other, with radii over `decades`.
Scene crowd(std::size_t count, double decades) {
  Scene scene;
  scene.camera.from = {3, 1, -7};
  Random random(11);
  const auto place = [&] {
    return Vec3{random.between(-9, 9), random.between(-1, 1), random.between(-9, 9)};
  };
  for (std::size_t i = 0; i < count; ++i) {
    scene.spheres.push_back({place(), 0.5 * std::pow(10, -random.between(0, decades))});
  }
  return scene;
}

TEST(NearPairs, AreAllPairsOfFewSpheres) {
  Scene scene = crowd(5, 1);
  scene.spheres[1].radius = 0;
  const auto pairs = as_set(near_pairs(scene, kNearness));
  EXPECT_EQ(pairs, (Pairs{{0, 2}, {0, 3}, {0, 4}, {2, 3}, {2, 4}, {3, 4}}));
}

TEST(NearPairs, AreThoseThatTouchOrNearlyCoincide) {
  for (const double decades : {0.0, 0.3, 3.0, 12.0}) {
    const Scene scene = crowd(1500, decades);
    const Pairs expected = near_at_moments(scene);
    EXPECT_GT(expected.size(), 5u) << decades;
    EXPECT_EQ(as_set(near_pairs(scene, kNearness)), expected) << decades;
  }
}

// Spheres that pass each other, by a hundred times the limit for near pairs, are left out.
TEST(NearPairs, AreThoseThatGoTogetherWhileTheShutterIsOpen) {
  Scene scene = crowd(1000, 1);
  scene.shifts.assign(scene.spheres.size(), Vec3{5, 0, 1});
  const auto camera = scene.camera.from;
  scene.camera.from = camera + Vec3{2.5, 0, 0.5};
  EXPECT_EQ(as_set(near_pairs(scene, kNearness)), near_at_moments(scene));
  Random random(3);
  for (Vec3& shift : scene.shifts) shift = shift + random.in_box(0.01);
  const Pairs found = as_set(near_pairs(scene, kNearness)), moments = near_at_moments(scene);
  EXPECT_TRUE(std::ranges::includes(found, moments));
  EXPECT_LT(found.size(), 1.1 * static_cast<double>(moments.size()));
  for (Vec3& shift : scene.shifts) shift = random.in_box(9);
  EXPECT_TRUE(near_pairs(scene, {.gap_of_extent = 1e-6, .spread_of_extent = 1e-4}).empty());
}

TEST(NearPairs, AreNotLookedForWhereTooManySpheresHeapUp) {
  Scene scene;
  scene.camera.from = {0, 0, 9};
  Random random(5);
  for (int i = 0; i < 50000; ++i) scene.spheres.push_back({random.in_box(0.5), 1});
  EXPECT_FALSE(find_near_pairs(scene, scene.camera.from, kNearness));
}

TEST(NearPairs, DoNotDependOnPlaceScaleAndThreads) {
  Scene scene = crowd(20000, 2);
  const auto pairs = near_pairs(scene, kNearness);
  EXPECT_EQ(Workers(1).run([&] { return near_pairs(scene, kNearness); }), pairs);
  for (Sphere& sphere : scene.spheres) {
    sphere.center = sphere.center * 0x1p-700;
    sphere.radius *= 0x1p-700;
  }
  scene.camera.from = scene.camera.from * 0x1p-700;
  EXPECT_EQ(near_pairs(scene, kNearness), pairs);
}

TEST(NearPairs, LeaveOutAHugeGround) {
  Scene scene = crowd(1500, 1);
  const auto alone = as_set(near_pairs(scene, kNearness));
  scene.spheres.push_back({.center = {0, -1e6, 0}, .radius = 1e6});
  const std::vector<std::uint32_t> ground{1500};
  EXPECT_EQ(as_set(near_pairs(scene, kNearness, ground)), alone);
}

// All in one place, or along a line.
TEST(NearPairs, AreFoundAmongSpheresThatHeapUp) {
  for (const Vec3 step : {Vec3{}, Vec3{1e-3, 0, 0}}) {
    Scene scene;
    scene.camera.from = {0, 0, 9};
    for (int i = 0; i < 1000; ++i) scene.spheres.push_back({step * i, 0.1 + 1e-3 * i});
    EXPECT_EQ(as_set(near_pairs(scene, kNearness)), near_at_moments(scene));
  }
}

// Nested shells each have two neighbours; all boxes overlap.
TEST(NearPairs, AreFoundAmongNestedShells) {
  Scene scene;
  scene.camera.from = {0, 0, 9};
  constexpr std::uint32_t kShells = 30000;
  for (std::uint32_t i = 0; i < kShells; ++i) {
    scene.spheres.push_back({{}, 0.1 + 1e-5 * static_cast<double>(i * 7919ULL % kShells)});
  }
  const Nearness nearness{.gap_of_extent = 1.5e-5 / 9.4, .gap_of_radius = 0, .spread_of_extent = 0};
  EXPECT_EQ(as_set(near_pairs(scene, nearness)).size(), kShells - 1);
}

}  // namespace
}  // namespace sdlc::render
