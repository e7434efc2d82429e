#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/compilation/compilation.hpp"

// What moves while the shutter is open, and what stays as it was at the opening (rulings 28 to 30).
namespace sdlc::test {
namespace {

using render::Vec3;
using testing::ElementsAre;
using testing::IsEmpty;

/// A camera whose shutter is open for this long, and `t`, the time as a number.
std::string shutter(const std::string& interval) {
  return "camera { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg, shutter: " + interval +
         " }\nlet t = time / 1s\n";
}

std::string ball(const std::string& center, const std::string& radius = "1") {
  return "sphere { center: " + center + ", radius: " + radius + ", material: unlit(red) }\n";
}

using Path = std::pair<Vec3, Vec3>;  // at the opening and the closing

std::vector<Path> paths_in(const lang::LoweredScene& lowered) {
  std::vector<Path> paths;
  for (std::size_t i = 0; i < lowered.scene.spheres.size(); ++i) {
    const Vec3 opening = lowered.scene.spheres[i].center;
    const bool moves = !lowered.scene.shifts.empty();
    paths.emplace_back(opening, moves ? opening + lowered.scene.shifts[i] : opening);
  }
  if (!lowered.scene.shifts.empty()) {
    EXPECT_EQ(lowered.scene.shifts.size(), lowered.scene.spheres.size());
  }
  return paths;
}

std::vector<Path> paths_of(const std::string& text, std::optional<int> frame = {}) {
  return paths_in(scene_of({.root = text}, frame));
}

TEST(Motion, OfACenterIsFromItsOpeningToItsClosing) {
  EXPECT_THAT(paths_of(shutter("1s .. 3s") + ball("(t, t * t, 0)")),
              ElementsAre(Path{{1, 1, 0}, {3, 9, 0}}));
  EXPECT_THAT(paths_of(shutter("3s .. 1s") + ball("(t, t * t, 0)")),
              ElementsAre(Path{{3, 9, 0}, {1, 1, 0}}));
}

TEST(Motion, GoesThroughNamesFunctionsLoopsAndParameters) {
  EXPECT_THAT(paths_of(shutter("1s .. 3s") +
                       "let at = (t, 0, 0) fn up(x, y = t) = (x, y, 0)\n"
                       "def dot(p, q = p * 2) { let r = p + q " +
                       ball("r") + "}\n" + ball("at") + ball("up(5)") +
                       "dot { p: at + (0, 0, 7) }\n"
                       "for p in [at, 3 * at] { let q = p " +
                       ball("q - (0, 0, 9)") +
                       "}\n"
                       "if true { let u = t " +
                       ball("(0, 0, u * 100)") + "}"),
              ElementsAre(Path{{1, 0, 0}, {3, 0, 0}}, Path{{5, 1, 0}, {5, 3, 0}},
                          Path{{3, 0, 21}, {9, 0, 21}}, Path{{1, 0, -9}, {3, 0, -9}},
                          Path{{3, 0, -9}, {9, 0, -9}}, Path{{0, 0, 100}, {0, 0, 300}}));
}

TEST(Motion, OfAnImportedFileFollowsTheSameTime) {
  const auto lowered = scene_of(
      {.root = shutter("1s .. 3s") + "import \"a.scene\" as a include \"b.scene\"\n" + ball("a.at"),
       .files = {{"a.scene", "let at = (time / 1s, 0, 0)"},
                 {"b.scene", "import \"a.scene\" as a let at = a.at * 2 " + ball("at")}}});
  EXPECT_THAT(paths_in(lowered),
              ElementsAre(Path{{2, 0, 0}, {6, 0, 0}}, Path{{1, 0, 0}, {3, 0, 0}}));
}

TEST(Motion, OfAGroupMovesTheCentersOfTheWorldInStraightLines) {
  // A half turn: the centre goes through the axis, not around it.
  EXPECT_THAT(paths_of(shutter("0s .. 2s") + "group { rotate: (0deg, 0deg, t * 90deg), scale: 2 " +
                       ball("(1, 0, 0)") + "}"),
              ElementsAre(Path{{2, 0, 0}, {-2, 0, 0}}));
  EXPECT_THAT(paths_of(shutter("1s .. 2s") +
                       "group { translate: (t, 0, 0) group { rotate: (0deg, "
                       "0deg, (t - 1) * 90deg) " +
                       ball("(0, t, 0)") + "} " + ball("(0, 9, 0)") + "}"),
              ElementsAre(Path{{1, 1, 0}, {0, 0, 0}}, Path{{1, 9, 0}, {2, 9, 0}}));
}

TEST(Motion, OfAnInstanceIsThatOfItsGroup) {
  EXPECT_THAT(paths_of(shutter("1s .. 2s") + "def dot(x) { " + ball("(x, 0, 0)") +
                       "}\n"
                       "dot { x: 5, translate: (0, t, 0) } dot { x: t * 10 }"),
              ElementsAre(Path{{5, 1, 0}, {5, 2, 0}}, Path{{10, 0, 0}, {20, 0, 0}}));
}

TEST(Motion, ByALineIsInTheGroupsOwnCoordinates) {
  const std::string line =
      "sphere { center: (1, 0, 0), radius: 1, material: unlit(red), motion: "
      "line(to: (3, 0, 0), over: 1s .. 2s) }";
  EXPECT_THAT(paths_of(shutter("1s .. 3s") + line), ElementsAre(Path{{1, 0, 0}, {5, 0, 0}}));
  EXPECT_THAT(paths_of(shutter("1s .. 3s") +
                       "group { rotate: (0deg, 0deg, 90deg), scale: 2, "
                       "translate: (0, 0, 4) " +
                       line + "}"),
              ElementsAre(Path{{0, 2, 4}, {0, 10, 4}}));
  EXPECT_THAT(paths_of(shutter("1s .. 3s") +
                       "group { translate: (0, 0, t), rotate: (0deg, 0deg, "
                       "(t - 1) * 45deg) " +
                       line + "}"),
              ElementsAre(Path{{1, 0, 1}, {0, 5, 3}}));
}

TEST(Motion, ByALineIsInAbsoluteTimesWhateverTheFrame) {
  const std::string scene = shutter("0s .. 500ms") +
                            "animation { frames: 0 .. 9, fps: 2 }\n"
                            "sphere { center: (0, 0, 0), radius: 1, material: unlit(red), motion: "
                            "line(to: (1, 0, 0), over: 0s .. 1s) }";
  EXPECT_THAT(paths_of(scene, 0), ElementsAre(Path{{0, 0, 0}, {0.5, 0, 0}}));
  EXPECT_THAT(paths_of(scene, 6), ElementsAre(Path{{3, 0, 0}, {3.5, 0, 0}}));
}

TEST(Motion, OfAnIncludedConfigComposesWithGroups) {
  const std::string config =
      R"({"camera": {"look_from": [9, 9, 9], "look_at": [0, 0, 0], "up": [0, 1, 0], "vfov": 9,
      "focal_length": 1, "aspect_ratio": 1, "viewport_height": 2, "samples_per_pixel": 3},
      "rendering": {"width": 7, "render_depth": 3}, "saving": {"path": "x.ppm", "gamma_correct": true},
      "spheres": [{"origin": [0, 0, 0], "radius": 1, "movement": [[2, 0, 0], 0, 1],
                   "material": {"type": "no_texture", "color": [51, 102, 255]}}]})";
  const auto lowered =
      scene_of({.root = shutter("1s .. 2s") + "group { translate: (0, t, 0) include \"a.json\" }",
                .files = {{"a.json", config}}});
  EXPECT_THAT(paths_in(lowered), ElementsAre(Path{{2, 1, 0}, {4, 2, 0}}));
}

TEST(Motion, HasNoEffectWithoutAShutter) {
  const std::string scene = "let u = time / 1s animation { frames: 0 .. 9, fps: 2 }\n" +
                            ball("(u, 0, 0)", "1 + u") + "group { translate: (u, 5, 0) " +
                            ball("(0, u, 0)") + "}";
  const auto lowered = scene_of({.root = shutter("none") + scene}, 3);
  EXPECT_TRUE(lowered.scene.shifts.empty());
  EXPECT_THAT(paths_in(lowered),
              ElementsAre(Path{{1.5, 0, 0}, {1.5, 0, 0}}, Path{{1.5, 6.5, 0}, {1.5, 6.5, 0}}));
  EXPECT_EQ(lowered.scene.spheres.at(0).radius, 2.5);
}

TEST(Motion, IsOfTheChosenCamerasShutter) {
  const std::string two =
      "camera still { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
      "camera moving { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg, shutter: 1s .. 2s }\n" +
      ball("(time / 1s, 0, 0)");
  EXPECT_THAT(paths_of(two + "render { camera: still }"), ElementsAre(Path{{0, 0, 0}, {0, 0, 0}}));
  EXPECT_THAT(paths_of(two + "render { camera: moving }"), ElementsAre(Path{{1, 0, 0}, {2, 0, 0}}));
  Compilation compilation({.root = two + "render { camera: still }"});
  const auto lowered = compilation.lower({.render = {{lang::render_property::kCamera, "moving"}}});
  ASSERT_TRUE(lowered);
  EXPECT_THAT(paths_in(*lowered), ElementsAre(Path{{1, 0, 0}, {2, 0, 0}}));
}

TEST(Motion, KeepsEachShiftBesideItsSphere) {
  EXPECT_THAT(
      paths_of(shutter("1s .. 2s") + ball("(0, 0, 0)") + ball("(5, t, 0)") + ball("(9, 0, 0)") +
               "sphere { center: (0, 9, 0), radius: 1, material: "
               "unlit(red), motion: line(to: (0, 9, 1), over: 1s .. 2s) }" +
               ball("(0, 5, t)")),
      ElementsAre(Path{{0, 0, 0}, {0, 0, 0}}, Path{{5, 1, 0}, {5, 2, 0}},
                  Path{{9, 0, 0}, {9, 0, 0}}, Path{{0, 9, 0}, {0, 9, 1}},
                  Path{{0, 5, 1}, {0, 5, 2}}));
}

TEST(Motion, DistinguishesSpheresThatMeetAtTheOpening) {
  Compilation compilation({.root = shutter("1s .. 2s") + ball("(1, 0, 0)") + ball("(t, 0, 0)") +
                                   ball("(t, 0, 0)") + ball("(3, 0, 0)") + ball("(3 * t, 0, 0)")});
  const auto lowered = compilation.lower();
  ASSERT_TRUE(lowered);
  EXPECT_THAT(compilation.codes(), ElementsAre("W401"));
  EXPECT_THAT(paths_in(*lowered),
              ElementsAre(Path{{1, 0, 0}, {1, 0, 0}}, Path{{1, 0, 0}, {2, 0, 0}},
                          Path{{3, 0, 0}, {3, 0, 0}}, Path{{3, 0, 0}, {6, 0, 0}}));
}

TEST(Motion, LeavesNoShiftsWhereNothingMoves) {
  for (const std::string& text :
       {ball("(0, 0, 0)"), ball("(t - t, 0, 0)"),
        "group { translate: (floor(t / 9), 0, 0) " + ball("(0, 0, 0)") + "}"}) {
    EXPECT_TRUE(scene_of({.root = shutter("1s .. 2s") + text}).scene.shifts.empty()) << text;
  }
  EXPECT_TRUE(scene_of({.root = shutter("1s .. 1s") + ball("(t, 0, 0)")}).scene.shifts.empty());
  const auto line = scene_of(
      {.root = shutter("1s .. 1s") + "sphere { center: (0, 0, 0), radius: 1, material: unlit(red), "
                                     "motion: line(to: (1, 0, 0), over: 0s .. 1s) }"});
  EXPECT_TRUE(line.scene.shifts.empty());
}

TEST(Opening, DecidesOnTheCamera) {
  Compilation compilation(
      {.root = "camera { from: (0, 0, 5 + time / 1s), at: (time / 1s, 0, 0), fov: 40deg, shutter: "
               "1s .. 2s }\n" +
               ball("(0, 0, 0)")});
  const auto lowered = compilation.lower();
  ASSERT_TRUE(lowered);
  EXPECT_THAT(compilation.codes(), ElementsAre("W404", "W404"));
  EXPECT_EQ(lowered->scene.camera.from, (Vec3{0, 0, 6}));
  EXPECT_EQ(lowered->scene.camera.at, (Vec3{1, 0, 0}));
}

TEST(Opening, DecidesOnSizesMaterialsAndTheSky) {
  Compilation compilation(
      {.root = shutter("1s .. 2s") +
               "background { color: linear(t, 0, 0) }\n"
               "group { scale: t, material: unlit(linear(2 * t, 0, 0)) sphere { "
               "center: (1, 0, 0), radius: 3 * t } }"});
  const auto lowered = compilation.lower();
  ASSERT_TRUE(lowered);
  EXPECT_THAT(compilation.codes(), ElementsAre("W404", "W404", "W404", "W404"));
  EXPECT_EQ(lowered->scene.background.top.r, 1);
  EXPECT_EQ(lowered->scene.materials.at(0).color.r, 2);
  EXPECT_EQ(lowered->scene.spheres.at(0).radius, 3);
  EXPECT_EQ(lowered->scene.spheres.at(0).center, (Vec3{1, 0, 0}));
  EXPECT_TRUE(lowered->scene.shifts.empty()) << "scales do not move";
}

TEST(Opening, DecidesOnCountsAndConditions) {
  Compilation compilation({.root = shutter("1s .. 2s") + "for i in range(t) { " +
                                   ball("(0, 0, i)") +
                                   "}\n"
                                   "if t < 1.5 { " +
                                   ball("(t, 5, 0)") + "} else { " + ball("(0, 9, 0)") + "}\n" +
                                   ball("(if t < 1.5 then 7 else 8, 0, 0)")});
  const auto lowered = compilation.lower();
  ASSERT_TRUE(lowered);
  EXPECT_THAT(compilation.codes(), ElementsAre("W404", "W404"));
  EXPECT_THAT(paths_in(*lowered),
              ElementsAre(Path{{0, 0, 0}, {0, 0, 0}}, Path{{1, 5, 0}, {2, 5, 0}},
                          Path{{7, 0, 0}, {8, 0, 0}}));
}

TEST(Opening, WarnsOnlyOfWhatChanges) {
  EXPECT_THAT(codes_of({.root = shutter("0s .. 1s") + ball("(0, 0, 0)", "floor(t / 2) + 1") +
                                "if t < 5 { " + ball("(3, 0, 0)") +
                                "} for i in range(floor(t / 2) + 1) { " + ball("(6, 0, 0)") + "}"}),
              IsEmpty());
}

TEST(Opening, IsWarnedOfOnceForAllFrames) {
  Compilation compilation({.root = shutter("0s .. 1s") + "animation { frames: 1 .. 3 }\n" +
                                   ball("(0, 0, 0)", "1 + t")});
  for (const int frame : {1, 2, 3}) EXPECT_TRUE(compilation.lower({}, frame));
  EXPECT_THAT(compilation.codes(), ElementsAre("W404"));
}

}  // namespace
}  // namespace sdlc::test
