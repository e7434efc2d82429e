#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/convert/convert.hpp"

namespace sdlc::lang {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The scene of a config with these spheres, and replacements for the usual parts.
struct Config {
  std::string spheres = "[]";
  std::string time_interval = "null";
  std::string aspect = "1.7777777777777777777777777";
  std::string up = "[0, 1, 0]";
  std::string rendering = R"("width": 960, "render_depth": 16)";
  std::string saving = R"("path": "a.png", "gamma_correct": true)";
  std::string background = "null";

  std::string text() const {
    return R"({"camera": {"look_from": [0, 1, 5.50], "look_at": [0, 0, 0], "up": )" + up +
           R"(, "vfov": 40.0, "focal_length": 2.5, "viewport_height": 2, "aspect_ratio": )" +
           aspect + R"(, "samples_per_pixel": 64, "time_interval": )" + time_interval +
           R"(}, "rendering": {)" + rendering + R"(}, "saving": {)" + saving +
           R"(}, "background": )" + background + R"(, "spheres": )" + spheres + "}";
  }
};

std::string scene_of(const std::string& config) {
  const Document file("config.json", config);
  DiagnosticSink sink;
  Conversion conversion(file, {}, sink);
  const auto scene = conversion.run({});
  for (const Diagnostic& diagnostic : sink.diagnostics()) {
    if (diagnostic.info->severity == Severity::Error) ADD_FAILURE() << diagnostic.message;
  }
  return scene.value_or("");
}

std::string sphere(const std::string& material, const std::string& more = "") {
  return R"({"origin": [0, 0, 0], "radius": 1, "material": {)" + material + "}" + more + "}";
}

constexpr const char* kRed = R"("type": "diffuse", "color": [255, 0, 0])";
constexpr const char* kGlass =
    R"("type": "transmissive", "color": [255, 255, 255], "refraction_index": 1.50)";

TEST(ToScene, LeavesDefaultsOut) {
  EXPECT_EQ(scene_of(Config{}.text()),
            "scene 1\n"
            "\n"
            "camera main {\n"
            "  from: (0, 1, 5.50)\n"
            "  at: (0, 0, 0)\n"
            "  fov: 40.0deg\n"
            "  // focal_length: 2.5 had no effect\n"
            "}\n"
            "\n"
            "render { output: \"a.png\", tone: sqrt }\n");
}

TEST(ToScene, KeepsTheSpellingOfNumbers) {
  const std::string scene =
      scene_of(Config{.spheres = R"([{"origin": [1e3, -0.50, 2.5E+1], "radius": 0.10,
                      "material": {"type": "specular", "color": [12.50, 1e2, 7], "fuzz": 1e-2}}])",
                      .aspect = "1.50",
                      .rendering = R"("width": 1e3, "render_depth": 8.0)"}
                   .text());
  EXPECT_THAT(scene, HasSubstr("aspect: 1.50"));
  EXPECT_THAT(scene, HasSubstr("center: (1e3, -0.50, 2.5E+1)"));
  EXPECT_THAT(scene, HasSubstr("radius: 0.10"));
  EXPECT_THAT(scene, HasSubstr("specular(color: linear255(12.50, 1e2, 7), fuzz: 1e-2)"));
  EXPECT_THAT(scene, HasSubstr("width: 1e3, depth: 8.0"));
}

TEST(ToScene, NamesMaterialsThatAreUsedTwice) {
  const std::string scene = scene_of(
      Config{.spheres = "[" + sphere(kGlass) + "," + sphere(kRed) + "," + sphere(kGlass) + "]"}
          .text());
  EXPECT_THAT(scene, HasSubstr("scene 1\n\nlet glass = transmissive(ior: 1.50)\n\ncamera"));
  EXPECT_THAT(scene, HasSubstr("radius: 1, material: glass }\n"));
  EXPECT_THAT(scene, HasSubstr("radius: 1, material: diffuse(color: red) }\n"));
  EXPECT_THAT(scene, Not(HasSubstr("red_matt")));
}

TEST(ToScene, SpellsColorsPlainlyWhereThatIsExactlyTheSame) {
  const auto color = [](const std::string& numbers) {
    const std::string scene = scene_of(Config{.background = numbers}.text());
    const std::size_t begin = scene.find("color: ") + 7;
    return scene.substr(begin, scene.find(" }", begin) - begin);
  };
  EXPECT_EQ(color("[255, 255, 255]"), "white");
  EXPECT_EQ(color("[0, 0.0, 0]"), "black");
  EXPECT_EQ(color("[255, 0, 255]"), "magenta");
  EXPECT_EQ(color("[127.5, 178.5, 255]"), "linear(0.5, 0.7, 1)");
  EXPECT_EQ(color("[100, 150, 200]"), "linear255(100, 150, 200)");
  EXPECT_EQ(color("[51, 102, 204]"), "linear255(51, 102, 204)");
  EXPECT_EQ(color("[-0, 0, 0]"), "linear255(-0, 0, 0)");
  // It would also be read as white, but is not what the config says.
  EXPECT_EQ(color("[255.00000000000003, 255, 255]"), "linear255(255.00000000000003, 255, 255)");
}

TEST(ToScene, WritesMotionWithTheShutterThatSeesIt) {
  const std::string scene =
      scene_of(Config{.spheres = "[" + sphere(kRed, R"(, "movement": [[1, 2, 3], 0, 5.0])") + "]",
                      .time_interval = "[1, 0.5]"}
                   .text());
  EXPECT_THAT(scene, HasSubstr("shutter: 0.5s .. 1s\n"));
  EXPECT_THAT(scene, HasSubstr("motion: line(to: (1, 2, 3), over: 0s .. 5.0s)\n"));
}

TEST(ToScene, KeepsMotionThatNobodySeesAsAComment) {
  const std::string scene = scene_of(
      Config{.spheres = "[" + sphere(kRed, ", \"movement\": [[1,\n2,3],\t0, 5]") + "]"}.text());
  EXPECT_THAT(scene, HasSubstr("  // movement: [[1, 2, 3], 0, 5] had no effect\n}\n"));
  EXPECT_THAT(scene, Not(HasSubstr("motion:")));
}

TEST(ToScene, MakesThreadsOfBothKeys) {
  const auto scene = [](const std::string& keys) {
    return scene_of(Config{.rendering = R"("width": 9, "render_depth": 4, )" + keys}.text());
  };
  EXPECT_THAT(scene(R"("in_parallel": false)"), HasSubstr("threads: 1 }"));
  EXPECT_THAT(scene(R"("in_parallel": true, "number_cores": 3)"), HasSubstr("threads: 3 }"));
  EXPECT_THAT(scene(R"("in_parallel": true, "number_cores": 0)"), Not(HasSubstr("threads")));
  EXPECT_THAT(scene(R"("in_parallel": false, "number_cores": 7)"),
              HasSubstr("  threads: 1\n  // number_cores: 7 had no effect\n"));
}

TEST(ToScene, EscapesWhatOneCannotSeeInAPath) {
  const std::string scene = scene_of(
      Config{.saving = "\"path\": \"\\u00e9\\t\\ud83d\\ude00\xC2\xA0\\\"\\u202e.png\""}.text());
  EXPECT_THAT(scene, HasSubstr("output: \"é\\u0009😀\\u00a0\\\"\\u202e.png\", tone: linear"));
}

TEST(ToScene, MakesAPlainPictureOfAnImage) {
  EXPECT_EQ(scene_of(R"({"image": {"width": 960, "height": 100, "color": [128, 64, 255]},
                         "saving": {"path": "a.png"}})"),
            "scene 1\n"
            "\n"
            "background { color: linear255(128, 64, 255) }\n"
            "\n"
            "render { width: 960, height: 100, output: \"a.png\", tone: linear }\n");
}

/// Glass spheres with these radii, as spelled.
std::string glass_with_radii(const std::vector<std::string>& radii) {
  std::string spheres;
  for (const std::string& radius : radii) {
    spheres += (spheres.empty() ? "" : ", ") + std::string(R"({"origin": [0, 0, 0], "radius": )") +
               radius + R"(, "material": {)" + kGlass + "}}";
  }
  return scene_of(Config{.spheres = "[" + spheres + "]"}.text());
}

TEST(ToScene, GivesARadiusANameThatFourSpheresOfAMaterialHave) {
  const std::string scene = glass_with_radii({"0.20", "1", "0.20", "0.20", "0.20"});
  EXPECT_THAT(scene, HasSubstr("let glass = transmissive(ior: 1.50)\n"
                               "let glass_radius = 0.20\n"));
  EXPECT_THAT(scene, HasSubstr("radius: glass_radius, material: glass }"));
  EXPECT_THAT(scene, HasSubstr("radius: 1, material: glass }"));
  EXPECT_THAT(scene, Not(HasSubstr("radius: 0.20")));
}

TEST(ToScene, LeavesARadiusOfThreeSpheresWhereItIs) {
  EXPECT_THAT(glass_with_radii({"0.20", "0.20", "0.20", "1", "2"}), Not(HasSubstr("glass_radius")));
  // With another spelling it is another number to the reader.
  EXPECT_THAT(glass_with_radii({"0.20", "0.20", "0.2", "0.2"}), Not(HasSubstr("glass_radius")));
}

TEST(ToScene, NamesTheRadiusThatComesFirstOfTwoAsFrequent) {
  EXPECT_THAT(glass_with_radii({"3", "2", "2", "2", "2", "3", "3", "3"}),
              HasSubstr("let glass_radius = 3\n"));
}

TEST(ToScene, RefusesAConfigWithErrors) {
  const Document file("config.json", R"({"camera": 3})");
  DiagnosticSink sink;
  Conversion conversion(file, {}, sink);
  EXPECT_EQ(conversion.run({}), std::nullopt);
  EXPECT_TRUE(sink.has_errors());
}

TEST(ToScene, RefusesWhatNoSceneMayHold) {
  const std::string config = Config{}.text();
  const auto codes = [&](const Limits& limits) {
    const Document file("config.json", config);
    DiagnosticSink sink;
    Conversion conversion(file, {.workspace = nullptr, .limits = limits, .sets = {}}, sink);
    EXPECT_EQ(conversion.run({}), std::nullopt);
    return sink.diagnostics().back().info->code;
  };
  EXPECT_EQ(codes({.string = 4}), "E306");
  EXPECT_EQ(codes({.file = 100}), "E308");
}

}  // namespace
}  // namespace sdlc::lang
