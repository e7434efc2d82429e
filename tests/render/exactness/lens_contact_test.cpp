#include "render/exactness/lens_contact.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "render/exactness/camera_view.hpp"
#include "render/exactness/instance_extremes.hpp"
#include "render/exactness/lens_disc.hpp"
#include "render/exactness/precision.hpp"
#include "tests/support/statistics/random.hpp"
#include "tests/support/statistics/scenes.hpp"

namespace sdlc::render {
namespace {

using test::add_sphere;
using test::diffuse;
using test::Random;

/// A lens of radius 1 at the origin that looks along −z.
Scene lens_scene() {
  Scene scene = test::beam_scene({0, 0, 0}, {0, 0, -1}, LinearRgb{1});
  scene.camera.aperture = 2;
  scene.camera.focus = 5;
  return scene;
}

Scene with_sphere(Vec3 center, double radius, Vec3 shift = {}) {
  Scene scene = lens_scene();
  add_sphere(scene, center, radius, diffuse({0.5, 0.5, 0.5}));
  if (shift != Vec3{}) scene.shifts = {shift};
  return scene;
}

bool touches(const Scene& scene) { return find_lens_contact(scene, scene.camera).has_value(); }

TEST(LensDisc, HasTheDistancesOfItsPoints) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 axis = unit(random.in_box(1) + Vec3{0, 0, 2});
    const Vec3 right = unit(cross(axis, {1, 0.1, 0})), up = cross(right, axis);
    const double radius = random.between(0.1, 2);
    const Vec3 point = random.in_box(3);
    double nearest = 1e300, farthest = 0;
    for (int turn = 0; turn < 720; ++turn) {
      for (int step = 0; step <= 40; ++step) {
        const double angle = turn * M_PI / 360, r = radius * step / 40;
        const Vec3 on_lens = right * (r * std::cos(angle)) + up * (r * std::sin(angle));
        nearest = std::min(nearest, length(point - on_lens));
        farthest = std::max(farthest, length(point - on_lens));
      }
    }
    const LensDisc lens(axis, radius);
    EXPECT_LE(lens.nearest(point), nearest + 1e-12);
    EXPECT_NEAR(lens.nearest(point), nearest, 0.05);
    EXPECT_GE(lens.farthest(point), farthest - 1e-12);
    EXPECT_NEAR(lens.farthest(point), farthest, 0.01);
  }
}

TEST(LensDisc, IsClearOfAMovingSphereByTheSmallestDistance) {
  const LensDisc lens({0, 0, -1}, 1);
  EXPECT_NEAR(lens.clearance({-5, 0, -3}, {10, 0, 0}, 1), 2, 1e-12);  // passes in front
  EXPECT_NEAR(lens.clearance({0, 0, -3}, {0, 0, -4}, 1), 2, 1e-12);   // leaves
  EXPECT_NEAR(lens.clearance({3, 0, 0}, {}, 1), 1, 1e-12);            // beside
  EXPECT_NEAR(lens.clearance({1, 0, 0}, {2, 0, 0}, 10), 6, 1e-12);    // inside all the time
  EXPECT_LT(lens.clearance({-5, 0, 0}, {10, 0, 0}, 1), 0);            // passes through
  EXPECT_LT(lens.clearance({-50, 0, 0}, {100, 0, 0}, 0.01), 0);
}

/// A grid of times, refined around the smallest distance.
double nearest_by_search(const LensDisc& lens, Vec3 opening, Vec3 displacement) {
  double from = 0, to = 1, least = 1e300, best = 0;
  for (int round = 0; round < 10; ++round) {
    constexpr int kTimes = 100;
    for (int i = 0; i <= kTimes; ++i) {
      const double u = from + (to - from) * i / kTimes;
      const double distance = lens.nearest(opening + displacement * u);
      if (distance < least) least = distance, best = u;
    }
    const double step = (to - from) / kTimes;
    from = std::max(0.0, best - step), to = std::min(1.0, best + step);
  }
  return least;
}

TEST(LensDisc, NeverExceedsTheDistanceOfAMovingSphereAndIsTight) {
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const LensDisc lens(unit(random.in_box(1) + Vec3{0, 0, 2}), random.between(0.1, 2));
    const double size = std::pow(10, random.between(-2, 6));
    const Vec3 passed = random.in_box(3), way = random.in_box(size), opening = passed - way * 0.37;
    const double found = lens.clearance(opening, way, 0);
    const double expected = nearest_by_search(lens, opening, way);
    EXPECT_LE(found, expected);
    EXPECT_NEAR(found, expected, 1e-11 * expected + 1e-12 * size + 1e-13) << i << ", way " << size;
  }
}

TEST(LensContact, IsFoundWhereATinySpherePassesFarAndFast) {
  const LensDisc lens({0, 0, -1}, 1);
  const double radius = 1e-6;
  const auto crosses = [&](Vec3 at, Vec3 way) {
    return lens.clearance(at - way * 0.618, way, radius) <= 0;
  };
  EXPECT_TRUE(crosses({0.3, 0, 0}, {0, 0, 1e7}));
  EXPECT_TRUE(crosses({0.3, 0.4, 0}, {1e7, 3e6, 1e6}));
  EXPECT_TRUE(crosses({1 + 1e-7, 0, 0}, {0, 1e7, 0}));     // touches the edge
  EXPECT_FALSE(crosses({1 + 2e-6, 0, 0}, {0, 1e3, 1e3}));  // beside the edge
}

TEST(LensContact, IsASurfaceThatCrossesTheDisc) {
  EXPECT_TRUE(touches(with_sphere({1.5, 0, 0}, 1)));    // in the edge
  EXPECT_TRUE(touches(with_sphere({0, 0, 0}, 0.5)));    // in the middle
  EXPECT_TRUE(touches(with_sphere({0, 0, -1}, 1)));     // touches the centre
  EXPECT_TRUE(touches(with_sphere({0, 0, 5}, 5.05)));   // around the centre, not the edge
  EXPECT_FALSE(touches(with_sphere({2.5, 0, 0}, 1)));   // beside
  EXPECT_FALSE(touches(with_sphere({0, 0, -1.5}, 1)));  // in front
  EXPECT_FALSE(touches(with_sphere({0, 0, 0}, 1.5)));   // around all of it
  EXPECT_FALSE(touches(with_sphere({0, 0, 5}, 5.2)));   // around all of it
  EXPECT_FALSE(touches(with_sphere({1.5, 0, 0}, 0)));
}

TEST(LensContact, IsFoundAtAnyTimeOfTheShutter) {
  EXPECT_TRUE(touches(with_sphere({-9, 0, 0}, 0.1, {18, 0, 0})));
  EXPECT_FALSE(touches(with_sphere({-9, 0, -2}, 0.1, {18, 0, 0})));
}

TEST(LensContact, NamesTheFirstSphere) {
  Scene scene = with_sphere({5, 0, 0}, 1);
  add_sphere(scene, {1, 0, 0}, 1, diffuse({0.5, 0.5, 0.5}));
  add_sphere(scene, {0, 1, 0}, 1, diffuse({0.5, 0.5, 0.5}));
  EXPECT_EQ(find_lens_contact(scene, scene.camera)->sphere, 1u);
}

TEST(LensContact, IsNoneForAPinhole) {
  Scene scene = with_sphere({0, 0, 0}, 0.5);
  scene.camera.aperture = 0;
  EXPECT_FALSE(touches(scene));
}

/// Two small spheres of an instance, which is moved by `translate` along x: they are then there,
/// and 2 nearer to the lens.
Scene with_instance(double translate) {
  Scene scene = lens_scene();
  scene.materials.push_back(diffuse({0.5, 0.5, 0.5}));
  scene.prototypes.push_back({.spheres = {{.center = {1, 0, 0}, .radius = 0.25, .material = 0},
                                          {.center = {-1, 0, 0}, .radius = 0.25, .material = 0}},
                              .shifts = {}});
  Instance instance;
  instance.placement.translate = {translate - 1, 0, 0};
  scene.instances = {instance};
  return scene;
}

TEST(LensContact, IsFoundInInstances) {
  Scene scene = with_instance(3);  // at x = 1 and 3
  ASSERT_TRUE(touches(scene));
  EXPECT_FALSE(find_lens_contact(scene, scene.camera)->sphere);
  scene = with_instance(3.5);
  EXPECT_FALSE(touches(scene));
  scene.instances[0].shift = {-1, 0, 0};
  EXPECT_TRUE(touches(scene));
}

TEST(LensContact, IsFoundWhereASphereMovesInsideAnInstance) {
  Scene scene = with_instance(3.5);
  scene.prototypes[0].shifts = {Vec3{}, {0, 0, -1}};
  EXPECT_FALSE(touches(scene));
  scene.prototypes[0].shifts = {Vec3{}, {-1, 0, 0}};
  EXPECT_TRUE(touches(scene));
  scene.instances[0].shift = {1, 0, 0};  // compensates
  EXPECT_FALSE(touches(scene));
}

TEST(NearestToLens, IsMeasuredFromTheDisc) {
  Scene scene = with_sphere({0, 0, -10}, 1);
  add_sphere(scene, {8, 0, 0}, 1, diffuse({0.5, 0.5, 0.5}));
  const auto nearest = find_nearest_to_lens(scene, scene.camera, 7);
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->sphere, 1u);
  EXPECT_NEAR(nearest->distance, 6, 1e-12);
  EXPECT_FALSE(find_nearest_to_lens(scene, scene.camera, 5.9));
}

TEST(NearestToLens, MayBeInAnInstance) {
  Scene scene = with_instance(7);  // at x = 5 and 7
  add_sphere(scene, {0, 0, -10}, 1, diffuse({0.5, 0.5, 0.5}));
  const auto nearest = find_nearest_to_lens(scene, scene.camera, 20);
  ASSERT_TRUE(nearest);
  EXPECT_FALSE(nearest->sphere);
  EXPECT_NEAR(nearest->distance, 3.75, 1e-12);
  EXPECT_FALSE(find_nearest_to_lens(scene, scene.camera, 3.7));
  scene.instances[0].placement.translate = {99, 0, 0};
  EXPECT_EQ(find_nearest_to_lens(scene, scene.camera, 20)->sphere, 0u);
}

/// E grows by the radius of the lens, and distances are those from its nearest point.
TEST(LensPrecision, HoldsForEveryOriginOnTheDisc) {
  const RenderSettings settings{.width = 100, .height = 100};
  const auto across = [&](const Scene& scene) {
    return judge_precision(scene, scene.camera, settings, Precision::Float)[PrecisionClause::Across]
        .value;
  };
  Scene lens = with_sphere({8, 0, 0}, 1), pinhole = lens;
  pinhole.camera.aperture = 0;
  EXPECT_NEAR(across(lens) / across(pinhole), (10.0 / 9) * (7.0 / 6), 1e-12);
  const auto hit = [&](const Scene& scene) {
    return judge_precision(scene, scene.camera, settings, Precision::Float)[PrecisionClause::Hit]
        .value;
  };
  EXPECT_NEAR(hit(lens) / hit(pinhole), 10.0 / 9, 1e-12);
}

TEST(LensPrecision, LimitsTheSlopeOfRays) {
  const RenderSettings settings{.width = 100, .height = 100};
  Scene scene = with_sphere({8, 0, 0}, 1);
  scene.camera.focus = 0.01;
  const auto bounds = judge_precision(scene, scene.camera, settings, Precision::Float);
  EXPECT_EQ(bounds[PrecisionClause::View].value, 200);
  EXPECT_FALSE(bounds.is_accepted());
}

/// As from the worst point of the lens, in the unit of the scene.
InstanceExtremes extremes_of(const Scene& scene) {
  const CameraView view(scene, scene.camera);
  InstanceExtremes extremes = extremes_of_instances(scene, view.frame(), view.lens());
  extremes.extent = view.frame().length_in_scene(extremes.extent);
  extremes.distance = view.frame().length_in_scene(extremes.distance);
  return extremes;
}

TEST(LensPrecision, HoldsForInstancesOutside) {
  Scene scene = with_instance(7);  // around x = 6, radius 1.25
  EXPECT_NEAR(extremes_of(scene).extent, 8.25, 1e-12);
  EXPECT_NEAR(extremes_of(scene).distance, 3.75, 1e-12);
  scene.camera.aperture = 0;
  EXPECT_NEAR(extremes_of(scene).extent, 7.25, 1e-12);
  EXPECT_NEAR(extremes_of(scene).distance, 4.75, 1e-12);
}

TEST(LensPrecision, HoldsForAnInstanceThatOnlyTheEdgeIsIn) {
  Scene scene = with_instance(7);  // around x = 6, radius 5.25
  scene.prototypes[0].spheres[0].center = {0, 5, 0};
  scene.prototypes[0].spheres[1].center = {0, -5, 0};
  EXPECT_NEAR(extremes_of(scene).distance, std::hypot(6, 5) - 1 - 0.25, 1e-12);
}

}  // namespace
}  // namespace sdlc::render
