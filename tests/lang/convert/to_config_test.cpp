#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "lang/compile/compile.hpp"
#include "lang/convert/convert.hpp"
#include "lang/report/findings.hpp"
#include "lang/source/limits.hpp"
#include "lang/value/colors.hpp"
#include "render/scene/digest.hpp"
#include "tests/support/compilation/compilation.hpp"

namespace sdlc::lang {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kCamera = "camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n";
constexpr const char* kRender = "render { width: 16, samples: 2, tone: sqrt }\n";

/// Converts a scene; adds a camera and settings if it has none.
struct Converted {
  std::optional<std::string> text;
  std::vector<std::string> told;  ///< "E313 `seed` cannot be …"
};

Converted convert(const std::string& scene, const ConvertOptions& options = {},
                  const std::map<std::string, std::string>& files = {}) {
  std::string text = "scene 1\n" + scene;
  if (text.find("camera ") == std::string::npos) text += kCamera;
  if (text.find("render {") == std::string::npos) text += kRender;
  const test::MemoryFiles others(files);
  Workspace workspace(others);
  const Document file("a.scene", text);
  DiagnosticSink sink;
  Conversion conversion(file, {.workspace = &workspace, .limits = {}, .sets = {}}, sink);
  Converted converted{.text = conversion.run(options), .told = {}};
  for (const Diagnostic* diagnostic : select_findings(sink).shown) {
    converted.told.push_back(std::string(diagnostic->info->code) + " " + diagnostic->message);
  }
  if (!converted.text) return converted;

  // Every conversion lowers to the same bits.
  DiagnosticSink silent;
  Compiler compiler(file, {.workspace = &workspace, .limits = {}, .sets = {}}, silent);
  Overrides overrides;
  if (options.tone) overrides.render.emplace_back(render_property::kTone, *options.tone);
  if (options.camera) overrides.render.emplace_back(render_property::kCamera, *options.camera);
  const auto of_scene = compiler.lower(overrides, options.frame);
  const Document config("a.json", *converted.text);
  const auto of_config = compile(config, {}, silent);
  EXPECT_TRUE(of_scene && of_config) << *converted.text;
  if (of_scene && of_config && converted.told.empty()) {
    EXPECT_EQ(render::digest_of(of_scene->scene), render::digest_of(of_config->scene))
        << *converted.text;
  }
  return converted;
}

json config_of(const std::string& scene, const ConvertOptions& options = {},
               const std::map<std::string, std::string>& files = {}) {
  const Converted converted = convert(scene, options, files);
  EXPECT_THAT(converted.told, ElementsAre());
  return converted.text ? json::parse(*converted.text) : json();
}

TEST(ToConfig, WritesEveryRequiredKeyInTheOrderOfTheTables) {
  EXPECT_EQ(*convert("").text,
            "{\n"
            "  \"camera\": {\n"
            "    \"look_from\": [0, 1, 5],\n"
            "    \"look_at\": [0, 0, 0],\n"
            "    \"up\": [0, 1, 0],\n"
            "    \"vfov\": 40,\n"
            "    \"focal_length\": 1,\n"
            "    \"aspect_ratio\": 1.7777777777777777,\n"
            "    \"viewport_height\": 2,\n"
            "    \"samples_per_pixel\": 2\n"
            "  },\n"
            "  \"rendering\": {\n"
            "    \"width\": 16,\n"
            "    \"render_depth\": 16,\n"
            "    \"in_parallel\": true\n"
            "  },\n"
            "  \"saving\": {\n"
            "    \"gamma_correct\": true\n"
            "  }\n"
            "}\n");
}

TEST(ToConfig, UnrollsLoopsAndFlattensGroups) {
  const json config = config_of(R"(
    def pair(gap: number) {
      sphere { center: (-gap, 0, 0), radius: 1 }
      sphere { center: (gap, 0, 0), radius: 1 }
    }
    group {
      translate: (0, 1, 0)
      rotate: (0deg, 90deg, 30deg)
      scale: 0.5
      material: diffuse(color: linear255(100, 150, 63.9))
      for i in range(2) { pair { gap: i + 0.1 } }
    }
  )");
  ASSERT_EQ(config["spheres"].size(), 4u);
  EXPECT_EQ(config["spheres"][0]["radius"], 0.5);
  EXPECT_EQ(config["spheres"][3]["material"],
            json::parse(R"({"type": "diffuse", "color": [100, 150, 63.9]})"));
}

TEST(ToConfig, WritesAllMaterials) {
  const json config = config_of(R"(
    sphere { center: (0, 0, 0), radius: 1, material: specular(color: white, fuzz: 0.25) }
    sphere { center: (3, 0, 0), radius: 1, material: transmissive(ior: 1.5) }
    sphere { center: (6, 0, 0), radius: 1, material: emissive(color: linear(0.5, 0.7, 1)) }
    sphere { center: (9, 0, 0), radius: 1, material: unlit(color: black) }
  )");
  const auto material = [&](int i) { return config["spheres"][i]["material"]; };
  EXPECT_EQ(material(0),
            json::parse(R"({"type": "specular", "color": [255,255,255], "fuzz": 0.25})"));
  EXPECT_EQ(material(1), json::parse(R"({"type": "transmissive", "color": [255,255,255],
                                         "refraction_index": 1.5})"));
  EXPECT_EQ(material(2),
            json::parse(R"({"type": "emissive", "color": [127.5, 178.5, 255], "intensity": 1})"));
  EXPECT_EQ(material(3), json::parse(R"({"type": "no_texture", "color": [0, 0, 0]})"));
}

TEST(ToConfig, KeepsALineAndMakesOneOfEveryOtherMotion) {
  const json config = config_of(R"(
    camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg, shutter: 0.5s .. 1s }
    let matt = diffuse(color: red)
    sphere { center: (1, 0, 0), radius: 1, material: matt, motion: line(to: (2, 0, 0), over: 0 .. 3) }
    sphere { center: (0, 3 + time / 1s, 0), radius: 1, material: matt }
    group {
      translate: (10 * time / 1s, 0, 0)
      sphere { center: (1, 9, 0), radius: 1, material: matt }
      sphere { center: (9, 9, 9), radius: 1, material: matt, motion: line(to: (2, 0, 0), over: 0 .. 3) }
    }
    group { translate: (0, 20, 0) sphere { center: (1, 9, 0), radius: 1, material: matt } }
  )");
  EXPECT_EQ(config["camera"]["time_interval"], json::parse("[0.5, 1]"));
  EXPECT_EQ(config["spheres"][0]["movement"], json::parse("[[2, 0, 0], 0, 3]"));
  EXPECT_EQ(config["spheres"][1]["origin"], json::parse("[0, 3.5, 0]"));
  EXPECT_EQ(config["spheres"][1]["movement"], json::parse("[[0, 4, 0], 0.5, 1]"));
  EXPECT_EQ(config["spheres"][2]["origin"], json::parse("[6, 9, 0]"));
  EXPECT_EQ(config["spheres"][2]["movement"], json::parse("[[11, 9, 0], 0.5, 1]"));
  EXPECT_TRUE(config["spheres"][3].contains("movement"));
  EXPECT_FALSE(config["spheres"][4].contains("movement"));
}

TEST(ToConfig, WritesBackgroundsThatTheFormatHas) {
  EXPECT_EQ(config_of("background { color: linear255(1, 2, 3) }")["background"],
            json::parse("[1, 2, 3]"));
  EXPECT_EQ(config_of("background { bottom: red, top: red }")["background"],
            json::parse("[255, 0, 0]"));
  EXPECT_FALSE(
      config_of("background { bottom: white, top: linear(0.5, 0.7, 1) }").contains("background"));
}

TEST(ToConfig, WritesSettings) {
  const json config = config_of(
      "render { width: 30, height: 20, samples: 7, depth: 3, threads: 1, tone: linear,"
      " output: \"a\\t\\\"é\\u0001.png\" }");
  EXPECT_EQ(config["camera"]["aspect_ratio"], 1.5);
  EXPECT_EQ(config["camera"]["samples_per_pixel"], 7);
  EXPECT_EQ(config["rendering"],
            json::parse(R"({"width": 30, "render_depth": 3, "in_parallel": false})"));
  EXPECT_EQ(config["saving"]["path"], "a\t\"é\x01.png");
  EXPECT_EQ(config["saving"]["gamma_correct"], false);
  EXPECT_EQ(config_of("render { tone: sqrt, threads: 4 }")["rendering"]["number_cores"], 4);
}

TEST(ToConfig, WritesAPlainPicture) {
  EXPECT_EQ(json::parse(*convert("render { width: 9, height: 8, tone: linear }\n"
                                 "background { color: blue }  // no camera here")
                             .text),
            json::parse(R"({"image": {"width": 9, "height": 8, "color": [0, 0, 255]},
                            "saving": {"gamma_correct": false}})"));
}

TEST(ToConfig, TakesTheCameraAndTheToneThatAreAskedFor) {
  const std::string scene = R"(
    camera left { from: (-1, 0, 5), at: (0, 0, 0), fov: 40deg }
    camera right { from: (1, 0, 5), at: (0, 0, 0), fov: 50deg }
    render { camera: left, width: 16 }
  )";
  EXPECT_EQ(config_of(scene, {.tone = "sqrt"})["camera"]["vfov"], 40);
  EXPECT_EQ(config_of(scene, {.camera = "right", .tone = "linear"})["camera"]["vfov"], 50);
  EXPECT_THAT(convert(scene, {.camera = "rigt", .tone = "sqrt"}).told,
              ElementsAre("E110 there is no camera `rigt`"));
}

TEST(ToConfig, TakesOneFrameOfAFilm) {
  const std::string scene = R"(
    sphere { center: (time / 1s, 0, 0), radius: 1, material: unlit(color: red) }
    animation { frames: 1 .. 48 }
    render { output: "ring.####.png", tone: sqrt, width: 16 }
  )";
  const json config = config_of(scene, {.frame = 12});
  EXPECT_EQ(config["spheres"][0]["origin"][0], 0.5);
  EXPECT_EQ(config["saving"]["path"], "ring.0012.png");
  EXPECT_THAT(convert(scene).told, ElementsAre("E313 a film cannot be written in a JSON config"));
}

TEST(ToConfig, ResolvesImportsAndIncludes) {
  const json config = config_of(
      "import \"m.scene\" as m\nsphere { center: (0, 0, 0), radius: 1, material: m.matt }\n"
      "group { translate: (5, 0, 0) include \"more.json\" }",
      {},
      {{"m.scene", "scene 1\nlet matt = diffuse(color: white)"},
       {"more.json", R"({"spheres": [{"origin": [1, 0, 0], "radius": 2,
                         "material": {"type": "diffuse", "color": [1, 2, 3]}}]})"}});
  ASSERT_EQ(config["spheres"].size(), 2u);
  EXPECT_EQ(config["spheres"][1]["origin"], json::parse("[6, 0, 0]"));
}

TEST(ToConfig, RoundsAColorThatNoNumbersAre) {
  // Of the 256 codes only 118 is not a number divided by 255.
  const Converted converted = convert("background { color: #760000 }");
  ASSERT_TRUE(converted.text);
  EXPECT_THAT(converted.told,
              ElementsAre(HasSubstr("W405 a JSON config cannot represent this colour exactly")));
  const double red = json::parse(*converted.text)["background"][0];
  EXPECT_NEAR(red / 255, decode_srgb(118), 0x1p-53);
}

TEST(ToConfig, WarnsOfAFrameThatIsNone) {
  EXPECT_THAT(convert("", {.frame = 3}).told, ElementsAre("W403 `--frame` has no effect"));
}

TEST(ToConfig, ConvertsTheExamplesOrSaysWhatKeepsThem) {
  int converted = 0;
  const DiskFileSystem files;
  Workspace workspace(files);
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(SDLC_SOURCE_DIR) / "examples")) {
    if (entry.path().extension() != ".scene") continue;
    std::error_code error;
    const Document file(entry.path().string(),
                        *files.read(entry.path(), Limits().any_file(), error));
    DiagnosticSink sink;
    Conversion conversion(file, {.workspace = &workspace, .limits = {}, .sets = {}}, sink);
    converted += conversion.run({.frame = 1, .tone = "sqrt"}).has_value();
    for (const Diagnostic& diagnostic : sink.diagnostics()) {
      const bool is_error = diagnostic.info->severity == Severity::Error;
      EXPECT_TRUE(!is_error || diagnostic.info->code == "E313") << diagnostic.message;
    }
  }
  EXPECT_GE(converted, 2);  // the lantern and Saturn
}

}  // namespace
}  // namespace sdlc::lang
