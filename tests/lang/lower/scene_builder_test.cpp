#include "lang/lower/scene_builder.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"

namespace sdlc::lang {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// What a text compiles to, and the codes of its diagnostics.
struct Compiled {
  std::optional<LoweredScene> lowered;
  std::vector<std::string> codes;
};

Compiled compile_text(const std::string& text, const Overrides& overrides = {}) {
  const bool is_json = text.starts_with("{");
  const Document file(is_json ? "test.json" : "test.scene", is_json ? text : "scene 1\n" + text);
  DiagnosticSink sink;
  Compiled compiled{.lowered = compile(file, overrides, sink), .codes = {}};
  for (const Diagnostic& diagnostic : sink.diagnostics()) {
    compiled.codes.emplace_back(diagnostic.info->code);
  }
  return compiled;
}

const std::string kCamera = "camera main { from: (0, 0, 5), at: (0, 0, 0), fov: 90deg }\n";
const std::string kBall =
    "sphere { center: (0, 0, 0), radius: 1, material: diffuse(color: linear(1, 1, 1)) }\n";

std::pair<int, int> size_of(const std::string& text, const Overrides& overrides = {}) {
  const Compiled compiled = compile_text(text, overrides);
  EXPECT_THAT(compiled.codes, IsEmpty()) << text;
  if (!compiled.lowered) return {};
  return {compiled.lowered->settings.width, compiled.lowered->settings.height};
}

TEST(SceneBuilder, TakesDefaultsFromTheTables) {
  const Compiled compiled = compile_text(kCamera + kBall);
  ASSERT_TRUE(compiled.lowered);
  const render::RenderSettings& settings = compiled.lowered->settings;
  EXPECT_EQ(settings.width, 960);
  EXPECT_EQ(settings.height, 540);
  EXPECT_EQ(settings.samples, 64);
  EXPECT_EQ(settings.depth, 16);
  EXPECT_EQ(compiled.lowered->scene.camera.up, (render::Vec3{0, 1, 0}));
  EXPECT_NEAR(compiled.lowered->scene.camera.plane_height, 2, 1e-15) << "2 tan 45°";
  EXPECT_EQ(compiled.lowered->scene.background.top, (render::LinearRgb{0.5, 0.7, 1}));
}

TEST(SceneBuilder, RoundsTheHeightDown) {
  EXPECT_EQ(size_of(kCamera + "render { width: 640 }"), (std::pair{640, 360}));
  EXPECT_EQ(size_of("camera c { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg, aspect: 1.6 } render { "
                    "width: 641 }"),
            (std::pair{641, 400}));
}

TEST(SceneBuilder, TakesTheAspectFromWidthAndHeightTogether) {
  const Compiled compiled = compile_text(kCamera + "render { width: 300, height: 100 }");
  ASSERT_TRUE(compiled.lowered);
  EXPECT_EQ(compiled.lowered->scene.camera.aspect, 3);
  EXPECT_EQ(compiled.lowered->settings.height, 100);
}

TEST(SceneBuilder, KeepsAWrittenAspectWhenThePixelsAreNotSquare) {
  const Compiled compiled = compile_text(
      "camera c { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg, aspect: 2 } render { width: 300, "
      "height: 100 }");
  ASSERT_TRUE(compiled.lowered);
  EXPECT_EQ(compiled.lowered->scene.camera.aspect, 2);
}

TEST(SceneBuilder, KeepsThePictureWholeWhenOneSideIsOverridden) {
  const std::string text = kCamera + "render { width: 300, height: 100 }";
  EXPECT_EQ(size_of(text, {.render = {{render_property::kWidth, 150}}}), (std::pair{150, 50}));
  EXPECT_EQ(size_of(text, {.render = {{render_property::kHeight, 10}}}), (std::pair{30, 10}));
  EXPECT_EQ(
      size_of(text, {.render = {{render_property::kWidth, 70}, {render_property::kHeight, 80}}}),
      (std::pair{70, 80}));
  EXPECT_EQ(size_of(kCamera, {.render = {{render_property::kHeight, 90}}}), (std::pair{160, 90}));
}

TEST(SceneBuilder, RefusesAPictureWithoutRows) {
  EXPECT_THAT(compile_text("camera c { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg, aspect: 100 } "
                           "render { width: 99 }")
                  .codes,
              ElementsAre("E209"));
}

TEST(SceneBuilder, RefusesCamerasThatSeeNothing) {
  const auto codes = [](const std::string& camera) {
    return compile_text("camera c { " + camera + ", fov: 40deg }" + kBall).codes;
  };
  EXPECT_THAT(codes("from: (1, 2, 3), at: (1, 2, 3)"), ElementsAre("E207"));
  EXPECT_THAT(codes("from: (0, 0, 0), at: (0, 3, 0)"), ElementsAre("E208"));
  EXPECT_THAT(codes("from: (0, 0, 0), at: (1, 2, 3), up: (-2, -4, -6)"), ElementsAre("E208"));
  EXPECT_THAT(codes("from: (0, 0, 0), at: (1, 2, 3), up: (0, 0, 0)"), ElementsAre("E208"));
  EXPECT_THAT(codes("from: (1e300, 0, 0), at: (-1e300, 0, 0), up: (0, 1e-300, 0)"),
              ElementsAre("E314"));
}

TEST(SceneBuilder, PicksACamera) {
  const std::string two =
      "camera a { from: (1, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
      "camera b { from: (2, 0, 5), at: (0, 0, 0), fov: 40deg }\n";
  EXPECT_THAT(compile_text(two).codes, ElementsAre("E111"));
  EXPECT_THAT(compile_text(two, {.render = {{render_property::kCamera, "c"}}}).codes,
              ElementsAre("E110"));
  EXPECT_EQ(
      compile_text(two, {.render = {{render_property::kCamera, "b"}}}).lowered->scene.camera.from.x,
      2);
  EXPECT_EQ(compile_text(two + "render { camera: a }").lowered->scene.camera.from.x, 1);
  EXPECT_EQ(
      compile_text(two + "render { camera: a }", {.render = {{render_property::kCamera, "b"}}})
          .lowered->scene.camera.from.x,
      2);
}

TEST(SceneBuilder, RequiresACameraForSpheres) {
  EXPECT_THAT(compile_text(kBall).codes, ElementsAre("E213"));
  EXPECT_THAT(compile_text("").codes, ElementsAre("E212"));
}

TEST(SceneBuilder, MakesAPlainPictureOfAColourAndASize) {
  const Compiled compiled =
      compile_text("background { color: linear(0.5, 0.25, 1) } render { width: 7, height: 5 }");
  ASSERT_TRUE(compiled.lowered);
  EXPECT_EQ(compiled.lowered->settings.width, 7);
  EXPECT_EQ(compiled.lowered->settings.height, 5);
  EXPECT_EQ(compiled.lowered->settings.samples, 1);
  EXPECT_EQ(compiled.lowered->scene.background.top, (render::LinearRgb{0.5, 0.25, 1}));
}

TEST(SceneBuilder, DistinguishesColourAndGradient) {
  EXPECT_THAT(compile_text(kCamera + "background { color: white, top: black }").codes,
              ElementsAre("E210"));
  EXPECT_THAT(compile_text(kCamera + "background { top: black }").codes, ElementsAre("E107"));
  EXPECT_THAT(compile_text(kCamera + "background { }").codes, ElementsAre("E107"));
}

TEST(SceneBuilder, SharesMaterials) {
  const Compiled compiled =
      compile_text(kCamera +
                   "sphere { center: (0, 0, 0), radius: 1, material: diffuse(color: white) }\n"
                   "sphere { center: (0, 9, 0), radius: 1, material: unlit(color: white) }\n"
                   "sphere { center: (9, 0, 0), radius: 1, material: diffuse(color: #fff) }\n");
  ASSERT_TRUE(compiled.lowered);
  EXPECT_EQ(compiled.lowered->scene.materials.size(), 2u);
  EXPECT_EQ(compiled.lowered->scene.spheres[2].material, 0u);
}

TEST(SceneBuilder, DropsWhatIsNeverSeenWithAWarning) {
  const Compiled compiled = compile_text(
      kCamera + kBall + kBall +
      "sphere { center: (0, 0, 0), radius: 1.0000000000002, material: unlit(color: white) }\n"
      "sphere { center: (3, 0, 0), radius: 0, material: unlit(color: white) }\n");
  ASSERT_TRUE(compiled.lowered);
  EXPECT_EQ(compiled.lowered->scene.spheres.size(), 1u);
  EXPECT_THAT(compiled.codes, ElementsAre("W402", "W401", "W401"));
}

// `movement` is linear between its two times and continues beyond them; the shutter decides which
// part is seen.
TEST(SceneBuilder, JoinsMotionAndShutter) {
  const auto ends = [](const std::string& shutter) {
    const Compiled compiled = compile_text(
        "camera c { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg, shutter: " + shutter + " }\n" +
        "sphere { center: (-2, 0, 0), radius: 1, material: unlit(color: white), motion: line(to: "
        "(2, 0, 0), over: 1s .. 3s) }");
    EXPECT_TRUE(compiled.lowered);
    const render::Scene& scene = compiled.lowered->scene;
    const double open = scene.spheres[0].center.x;
    return std::pair{open, scene.shifts.empty() ? open : open + scene.shifts[0].x};
  };
  EXPECT_EQ(ends("1s .. 3s"), (std::pair{-2.0, 2.0}));
  EXPECT_EQ(ends("3s .. 1s"), (std::pair{2.0, -2.0}));
  EXPECT_EQ(ends("2s .. 2s"), (std::pair{0.0, 0.0}));
  EXPECT_EQ(ends("0s .. 5s"), (std::pair{-4.0, 6.0}));
  EXPECT_EQ(ends("none"), (std::pair{-2.0, -2.0}));
}

TEST(SceneBuilder, RefusesMotionBeyondTheLargestNumber) {
  const Compiled compiled = compile_text(
      "camera c { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg, shutter: 0s .. 1e10s }\n"
      "sphere { center: (0, 0, 0), radius: 1, material: unlit(color: white), motion: line(to: "
      "(1e300, 0, 0), over: 0s .. 1s) }");
  EXPECT_THAT(compiled.codes, ElementsAre("E214"));
}

TEST(SceneBuilder, RefusesLightsAndViewsBeyondNumbers) {
  EXPECT_THAT(
      compile_text(kCamera + "sphere { center: (0, 0, 0), radius: 1, material: emissive(color: "
                             "linear(1e300, 1, 1), intensity: 1e300) }")
          .codes,
      ElementsAre("E214"));
  EXPECT_THAT(compile_text("camera c { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg, view_height: "
                           "1e200 }" +
                           kBall)
                  .codes,
              ElementsAre("E214"));
}

TEST(SceneBuilder, WarnsOfMotionWhileTheShutterIsClosed) {
  const Compiled compiled = compile_text(
      kCamera +
      "sphere { center: (0, 0, 0), radius: 1, material: unlit(color: white), motion: line(to: (1, "
      "0, 0), over: 0s .. 1s) }");
  EXPECT_TRUE(compiled.lowered);
  EXPECT_THAT(compiled.codes, ElementsAre("W403"));
}

TEST(SceneBuilder, RefusesWholeNumbersThatNoCounterHolds) {
  EXPECT_THAT(compile_text(kCamera + "render { samples: 3000000000 }").codes, ElementsAre("E202"));
  EXPECT_THAT(compile_text(kCamera + "render { width: 100000, height: 100000 }").codes,
              ElementsAre("E302"));
}

}  // namespace
}  // namespace sdlc::lang
