#include "lang/lower/placement.hpp"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/compilation/compilation.hpp"

// p' = translate + Rz Ry Rx (scale p), right-handed.
namespace sdlc::lang {
namespace {

using render::Vec3;
using testing::DoubleNear;
using testing::ElementsAre;

constexpr double kRounding = 1e-13;  // of coordinates up to 100

testing::Matcher<Vec3> is_near(Vec3 expected) {
  return testing::AllOf(testing::Field("x", &Vec3::x, DoubleNear(expected.x, kRounding)),
                        testing::Field("y", &Vec3::y, DoubleNear(expected.y, kRounding)),
                        testing::Field("z", &Vec3::z, DoubleNear(expected.z, kRounding)));
}

TEST(Placement, LeavesThingsWhereTheyAre) {
  EXPECT_EQ(render::Placement().apply({1, 2, 3}), (Vec3{1, 2, 3}));
  EXPECT_EQ(placement_of({}, {}, 1).apply({1, 2, 3}), (Vec3{1, 2, 3}));
}

TEST(Placement, TurnsByQuartersExactly) {
  struct Quarter {
    Vec3 degrees, of_x, of_y, of_z;
  };
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  for (const Quarter& quarter : std::vector<Quarter>{{{90, 0, 0}, x, z, -y},
                                                     {{0, 90, 0}, -z, y, x},
                                                     {{0, 0, 90}, y, -x, z},
                                                     {{-90, 0, 0}, x, -z, y},
                                                     {{180, 0, 0}, x, -y, -z},
                                                     {{0, 180, 0}, -x, y, -z},
                                                     {{0, 0, 180}, -x, -y, z},
                                                     {{90, 90, 0}, -z, x, -y},
                                                     {{90, 0, 90}, y, z, x},
                                                     {{0, 90, 90}, -z, -x, y},
                                                     {{360, -360, 720}, x, y, z}}) {
    const render::Placement placement = placement_of({}, quarter.degrees, 1);
    EXPECT_EQ(placement.apply(x), quarter.of_x) << quarter.degrees.x << " " << quarter.degrees.y;
    EXPECT_EQ(placement.apply(y), quarter.of_y) << quarter.degrees.x << " " << quarter.degrees.y;
    EXPECT_EQ(placement.apply(z), quarter.of_z) << quarter.degrees.x << " " << quarter.degrees.y;
  }
}

TEST(Placement, ScalesThenTurnsAboutXThenYThenZThenMoves) {
  const render::Placement placement = placement_of({10, 20, 30}, {30, 45, 60}, 2);
  // The product of the three matrices, by hand.
  EXPECT_THAT(placement.apply({1, 2, 3}),
              is_near({12.849407080813794, 25.86352106569152, 33.674234614174765}));
  EXPECT_EQ(placement.scale, 2);
  EXPECT_EQ(placement.apply({}), (Vec3{10, 20, 30}));
}

TEST(Placement, KeepsLengthsAndOrientation) {
  for (const Vec3 degrees : {Vec3{10, 20, 30}, Vec3{-77, 123, 245}, Vec3{0.5, 89, 91}}) {
    const render::Placement p = placement_of({}, degrees, 1);
    for (const Vec3 column : {p.x, p.y, p.z}) EXPECT_NEAR(length(column), 1, 1e-15);
    EXPECT_THAT(cross(p.x, p.y), is_near(p.z)) << "right-handed";
  }
}

TEST(Placement, AroundAnotherIsTheSameAsOneAfterTheOther) {
  const render::Placement outer = placement_of({1, -2, 3}, {10, 20, 30}, 2);
  const render::Placement inner = placement_of({-4, 5, 0.5}, {-70, 15, 100}, 0.25);
  const render::Placement both = outer.around(inner);
  for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{1, 2, 3}, Vec3{-7, 0.1, 4}}) {
    EXPECT_THAT(both.apply(p), is_near(outer.apply(inner.apply(p))));
  }
  EXPECT_EQ(both.scale, 0.5);
}

const std::string kCamera = "camera { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n";

std::vector<render::Sphere> spheres_of(const std::string& text) {
  return test::scene_of({.root = kCamera + text}).scene.spheres;
}

std::vector<Vec3> centers_of(const std::string& text) {
  std::vector<Vec3> centers;
  for (const render::Sphere& sphere : spheres_of(text)) centers.push_back(sphere.center);
  return centers;
}

std::string ball(const std::string& center) {
  return "sphere { center: " + center + ", radius: 0.5, material: unlit(red) } ";
}

TEST(Groups, NestAsDeepAsTheyAreWritten) {
  // Inside out: 1 is doubled to 2, turned to y, moved to (3, 2, 0), turned about x to (3, 0, 2).
  const auto spheres = spheres_of(
      "group { rotate: (90deg, 0deg, 0deg) group { translate: (3, 0, 0) group { rotate: (0deg, "
      "0deg, 90deg) group { scale: 2 " +
      ball("(1, 0, 0)") + "} } } " + ball("(0, 1, 0)") + "}" + ball("(7, 8, 9)"));
  ASSERT_EQ(spheres.size(), 3u);
  EXPECT_EQ(spheres.at(0).center, (Vec3{3, 0, 2}));
  EXPECT_EQ(spheres.at(0).radius, 1);
  EXPECT_EQ(spheres.at(1).center, (Vec3{0, 0, 1}));
  EXPECT_EQ(spheres.at(1).radius, 0.5);
  EXPECT_EQ(spheres.at(2).center, (Vec3{7, 8, 9})) << "after the groups";
}

TEST(Groups, MultiplyTheirScalesIntoRadii) {
  const auto spheres = spheres_of("group { scale: 3 group { scale: 0.5 " + ball("(1, 0, 0)") +
                                  "} " + ball("(2, 0, 0)") + "}");
  ASSERT_EQ(spheres.size(), 2u);
  EXPECT_EQ(spheres.at(0).radius, 0.75);
  EXPECT_EQ(spheres.at(0).center, (Vec3{1.5, 0, 0}));
  EXPECT_EQ(spheres.at(1).radius, 1.5);
}

TEST(Groups, PlaceInstancesAndIncludedFilesTheSameWay) {
  const std::string placed = "{ translate: (1, 2, 3), rotate: (0deg, 90deg, 0deg), scale: 2 ";
  const std::vector<Vec3> expected{{1, 2, 1}};
  EXPECT_EQ(centers_of("group " + placed + ball("(1, 0, 0)") + "}"), expected);
  EXPECT_EQ(centers_of("def one() { " + ball("(1, 0, 0)") + "} one " + placed + "}"), expected);
  const auto included =
      test::scene_of({.root = kCamera + "group " + placed + "include \"a.scene\" }",
                      .files = {{"a.scene", ball("(1, 0, 0)")}}});
  EXPECT_EQ(included.scene.spheres.at(0).center, expected[0]);
}

TEST(Groups, OfAnInstanceEncloseItsBodyOnly) {
  EXPECT_THAT(centers_of("def pair(x) { " + ball("(x, 0, 0)") + " group { translate: (0, x, 0) " +
                         ball("(x, 0, 0)") +
                         "} }\npair { x: 1, translate: (0, 0, 5) } pair { x: 2 "
                         "}"),
              ElementsAre(Vec3{1, 0, 5}, Vec3{1, 1, 5}, Vec3{2, 0, 0}, Vec3{2, 2, 0}));
}

TEST(Groups, MayUseTheirOwnLets) {
  const auto spheres =
      spheres_of("group { let s = 3 scale: s, translate: (s, 0, 0) " + ball("(s, 0, 0)") + "}");
  ASSERT_EQ(spheres.size(), 1u);
  EXPECT_EQ(spheres[0].center, (Vec3{12, 0, 0}));
  EXPECT_EQ(spheres[0].radius, 1.5);
}

TEST(Groups, LeaveNoTraceWhereTheyHoldNothing) {
  EXPECT_THAT(centers_of("group { translate: (1, 1, 1) } group { if false { " + ball("(0, 0, 0)") +
                         "} } " + ball("(2, 0, 0)")),
              ElementsAre(Vec3{2, 0, 0}));
}

/// The red components of the spheres' materials.
std::vector<double> reds_of(const std::string& text) {
  const LoweredScene lowered = test::scene_of({.root = kCamera + text});
  std::vector<double> reds;
  for (const render::Sphere& sphere : lowered.scene.spheres) {
    reds.push_back(lowered.scene.materials.at(sphere.material).color.r);
  }
  return reds;
}

std::string bare(int x) { return fmt::format("sphere {{ center: ({}, 0, 0), radius: 0.5 }} ", x); }
std::string of(int red) { return fmt::format("material: unlit(linear({}, 0, 0)) ", red); }

TEST(Materials, AreInheritedFromTheNearestGroupThatHasOne) {
  EXPECT_THAT(reds_of("group { " + of(1) + bare(0) + "group { " + bare(1) + "group { " + of(2) +
                      bare(2) + "} " + bare(3) + "} } group { " + of(3) + bare(4) + "}"),
              ElementsAre(1, 1, 2, 1, 3));
}

TEST(Materials, AreInheritedThroughInstances) {
  const std::string defs = "def inner() { " + bare(0) + "} def outer() { " + bare(1) +
                           "inner { translate: (5, 0, 0) } inner { translate: (9, 0, 0), " + of(2) +
                           "} }\n";
  EXPECT_THAT(reds_of(defs + "outer { " + of(1) + "} group { " + of(3) +
                      "outer { translate: (0, 5, 0) } }"),
              ElementsAre(1, 1, 2, 3, 3, 2));
}

TEST(Materials, AreInheritedByAnIncludedFile) {
  const auto lowered =
      test::scene_of({.root = kCamera + "group { " + of(4) + "include \"a.scene\" }",
                      .files = {{"a.scene", bare(0)}}});
  EXPECT_EQ(lowered.scene.materials.at(0).color.r, 4);
}

TEST(Materials, ThatAreWrongAreNotMissingToo) {
  EXPECT_THAT(test::codes_of({.root = kCamera + "group { material: red " + bare(0) + "}"}),
              ElementsAre("E201"));
  EXPECT_THAT(test::codes_of({.root = kCamera + "sphere { center: (0, 0, 0), radius: 1, material: "
                                                "red }"}),
              ElementsAre("E201"));
}

}  // namespace
}  // namespace sdlc::lang
