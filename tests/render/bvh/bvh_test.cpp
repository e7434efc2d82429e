#include "render/bvh/bvh.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/statistics/random.hpp"

namespace sdlc::render {
namespace {

using test::Random;

/// Spheres of a rebased scene: everything within 2 of the origin.
struct TestScene {
  std::string name;
  std::vector<Sphere> spheres;
  std::vector<Vec3> shifts;
};

std::vector<TestScene> test_scenes() {
  Random random(1);
  std::vector<TestScene> scenes;
  const auto add = [&](std::string name, int count, auto&& make) {
    TestScene scene{.name = std::move(name), .spheres = {}, .shifts = {}};
    for (int i = 0; i < count; ++i) scene.spheres.push_back(make(i));
    scenes.push_back(std::move(scene));
  };
  add("none", 0, [&](int) { return Sphere{}; });
  add("one", 1, [&](int) { return Sphere{{0.1, 0.2, 0.3}, 0.5}; });
  add("random", 1000, [&](int) { return Sphere{random.in_box(0.9), random.between(0.001, 0.1)}; });
  add("nested", 60, [&](int i) { return Sphere{{0, 0, 0}, 0.02 * (i + 1)}; });
  add("one centre", 500, [&](int) { return Sphere{{0.5, 0, 0}, random.between(0.01, 0.9)}; });
  add("equal", 300, [&](int) { return Sphere{{0.25, 0.5, 0}, 0.25}; });
  add("on a line", 400, [&](int i) { return Sphere{{i * 0.004 - 0.8, 0, 0}, 0.002}; });
  add("twelve decades", 500, [&](int) {
    return Sphere{random.in_box(0.7), std::pow(10.0, random.between(-12, -0.3))};
  });
  add("ground", 500, [&](int i) {
    return i == 0 ? Sphere{{0, -1, 0}, 1}
                  : Sphere{{random.between(-0.1, 0.1), 0.001, random.between(-0.1, 0.1)}, 0.001};
  });
  TestScene moving{.name = "moving", .spheres = {}, .shifts = {}};
  for (int i = 0; i < 500; ++i) {
    moving.spheres.push_back({random.in_box(0.7), random.between(0.001, 0.1)});
    moving.shifts.push_back(i % 3 == 0 ? random.in_box(0.3) : Vec3{});
  }
  scenes.push_back(std::move(moving));
  return scenes;
}

/// The first hit found by testing every sphere, as (distance, index in the scene).
std::pair<double, std::uint32_t> brute_force(const TestScene& scene, const Ray& ray,
                                             std::uint32_t departed, Vec3 normal) {
  double nearest = kNoHit;
  std::uint32_t index = kNoSphere;
  for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) {
    Vec3 center = scene.spheres[i].center;
    if (!scene.shifts.empty()) center += scene.shifts[i] * ray.u;
    const double t =
        i == departed ? rehit_distance(ray.direction, normal, scene.spheres[i].radius)
                      : hit_distance(ray.origin - center, ray.direction, scene.spheres[i].radius);
    if (t < nearest) {
      nearest = t;
      index = i;
    }
  }
  return {nearest, index};
}

BvhHit intersect(const Bvh& bvh, const TestScene& scene, const Ray& ray,
                 const Departure& departure) {
  return scene.shifts.empty() ? bvh.intersect<false>(ray, departure)
                              : bvh.intersect<true>(ray, departure);
}

TEST(Bvh, FindsWhatTestingEverySphereFinds) {
  for (const TestScene& scene : test_scenes()) {
    const Bvh bvh(scene.spheres, scene.shifts);
    Random random(2);
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
      Ray ray{
          .origin = random.in_box(1), .direction = random.direction(), .u = random.between(0, 1)};
      if (i % 4 == 0) ray.direction = {0, 0, i % 8 == 0 ? 1.0 : -1.0};  // in the planes of boxes
      // Every other ray aims at a sphere, so that small ones are hit too.
      if (i % 2 == 1 && !scene.spheres.empty()) {
        const Sphere& target = scene.spheres[static_cast<std::size_t>(i) % scene.spheres.size()];
        ray.direction = unit(target.center + random.in_box(1) * target.radius - ray.origin);
      }
      const auto [t, index] = brute_force(scene, ray, kNoSphere, {});
      const BvhHit hit = intersect(bvh, scene, ray, {});
      ASSERT_EQ(hit.t, t) << scene.name;
      const std::uint32_t found =
          hit.sphere == kNoSphere ? kNoSphere : bvh.index_in_scene(hit.sphere);
      ASSERT_EQ(found, index) << scene.name;
      hits += index != kNoSphere;
    }
    if (!scene.spheres.empty()) {
      EXPECT_GT(hits, 100) << scene.name << ": the rays test nothing";
    }
  }
}

TEST(Bvh, TreatsTheSphereThatARayLeavesApart) {
  for (const TestScene& scene : test_scenes()) {
    const Bvh bvh(scene.spheres, scene.shifts);
    Random random(3);
    for (int i = 0; i < 5000 && bvh.size() > 0; ++i) {
      const auto slot = static_cast<std::uint32_t>(i) % static_cast<std::uint32_t>(bvh.size());
      const Vec3 normal = random.direction();
      Ray ray{.origin = {}, .direction = random.direction(), .u = random.between(0, 1)};
      const Vec3 center =
          scene.shifts.empty() ? bvh.center<false>(slot, ray.u) : bvh.center<true>(slot, ray.u);
      ray.origin = center + normal * bvh.sphere(slot).radius;
      const auto [t, index] = brute_force(scene, ray, bvh.index_in_scene(slot), normal);
      const BvhHit hit = intersect(bvh, scene, ray, {.sphere = slot, .normal = normal});
      ASSERT_EQ(hit.t, t) << scene.name;
    }
  }
}

TEST(Bvh, GivesEqualDistancesToTheLowerIndex) {
  const std::vector<Sphere> spheres(40, Sphere{{0, 0, 0}, 0.5});
  const Bvh bvh(spheres, {});
  const BvhHit hit = bvh.intersect<false>({.origin = {0, 0, 1}, .direction = {0, 0, -1}}, {});
  ASSERT_NE(hit.sphere, kNoSphere);
  EXPECT_EQ(bvh.index_in_scene(hit.sphere), 0u);
}

TEST(Bvh, TakesAboutAsManyBytesAsEstimated) {
  Random random(2);
  constexpr std::size_t kCount = 20'000;
  for (const double radius : {1e-5, 0.02, 0.3}) {
    for (const bool is_moving : {false, true}) {
      std::vector<Sphere> spheres;
      for (std::size_t i = 0; i < kCount; ++i) spheres.push_back({random.in_box(0.7), radius});
      const std::vector<Vec3> shifts(is_moving ? kCount : 0, Vec3{0.001, 0, 0});
      const auto built = static_cast<double>(Bvh(spheres, shifts).memory_bytes());
      const auto estimated = static_cast<double>(Bvh::estimated_bytes(kCount, is_moving));
      EXPECT_GT(estimated, built / 2) << radius << (is_moving ? ", moving" : "");
      EXPECT_LT(estimated, built * 2) << radius << (is_moving ? ", moving" : "");
    }
  }
}

}  // namespace
}  // namespace sdlc::render
