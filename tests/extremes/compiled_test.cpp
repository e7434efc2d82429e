#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "render/image/tone.hpp"
#include "tests/extremes/forms.hpp"
#include "tests/support/statistics/estimate.hpp"
#include "tests/support/statistics/scenes.hpp"

// Texts beyond the limits are rejected at their place, and all others are rendered: a scene and a
// config of each.
namespace sdlc::test {
namespace {

using render::LinearRgb;
using testing::Contains;
using testing::IsEmpty;

struct Compiled {
  std::optional<lang::LoweredScene> lowered;
  std::vector<std::string> codes;  ///< "E202 3": with the line
};

Compiled compiled(const std::string& name, const std::string& text,
                  const lang::Overrides& overrides = {}) {
  const lang::Document file(name, text);
  lang::DiagnosticSink sink;
  lang::Compiler compiler(file, {}, sink);
  Compiled result{compiler.lower(overrides), {}};
  if (result.lowered && result.lowered->camera) {
    const auto& lowered = *result.lowered;
    const auto kernel =
        render::choose_kernel(lowered.scene, lowered.settings, {.precision = lowered.precision});
    compiler.warn_of_precision(lowered, kernel.precision, kernel.bounds);
  }
  for (const lang::Diagnostic& diagnostic : sink.diagnostics()) {
    const auto line = file.position(diagnostic.where.span.begin).line;
    result.codes.push_back(fmt::format("{} {}", diagnostic.info->code, line));
  }
  return result;
}

/// A scene of one sphere, with properties of the camera, of `render` and of the sphere.
struct Text {
  std::string from = "(0, 0, 5)", at = "(0, 0, 0)", fov = "40deg", more = "";
  std::string render = "width: 8, height: 8, samples: 4";
  std::string center = "(0, 0, 0)", radius = "1", material = "diffuse(color: rgb(0.5, 0.5, 0.5))";
  std::string version = "scene 1";

  Compiled compile(const lang::Overrides& overrides = {}) const {
    return compiled("test.scene",
                    version + "\ncamera { from: " + from + ",\nat: " + at + ",\nfov: " + fov +
                        "\n" + more + "}\nrender { " + render + " }\nsphere { center: " + center +
                        ",\nradius: " + radius + ",\nmaterial: " + material + " }\n",
                    overrides);
  }
};
constexpr const char* kLineOfFov = " 4";

/// The same as a config.
struct Config {
  std::string from = "[0, 0, 5]", at = "[0, 0, 0]", up = "[0, 1, 0]", vfov = "40", aspect = "1";
  std::string width = "8", samples = "4", depth = "16", interval = "null";
  std::string origin = "[0, 0, 0]", radius = "1", color = "[127, 127, 127]", movement = "";

  Compiled compile(const lang::Overrides& overrides = {}) const {
    const std::string moves = movement.empty() ? "" : ",\n\"movement\": " + movement;
    return compiled(
        "test.json",
        fmt::format(
            "{{\"background\": [255, 255, 255],\n\"camera\": {{\"look_from\": {},\n"
            "\"look_at\": {},\n\"up\": {},\n\"vfov\": {},\n\"focal_length\": 1,\n"
            "\"aspect_ratio\": {},\n\"viewport_height\": 2,\n\"samples_per_pixel\": {},\n"
            "\"time_interval\": {}}},\n\"rendering\": {{\"width\": {},\n"
            "\"render_depth\": {}}}, \"saving\": {{}},\n\"spheres\": [{{\"origin\": {},\n"
            "\"radius\": {},\n\"material\": {{\"type\": \"diffuse\", \"color\": {}}}{}}}]}}",
            from, at, up, vfov, aspect, samples, interval, width, depth, origin, radius, color,
            moves),
        overrides);
  }
};

/// Renders it with every kernel that supports it; finite, and approximately `expected` in the
/// centre.
void expect_rendered(const Compiled& compiled, const std::string& what) {
  ASSERT_TRUE(compiled.lowered) << what << ": " << testing::PrintToString(compiled.codes);
  for (const Form& form : all_forms()) {
    if (!may_trace(form, compiled.lowered->scene, compiled.lowered->settings)) continue;
    const auto result = render_in(form, compiled.lowered->scene, compiled.lowered->settings);
    EXPECT_EQ(result.nonfinite_samples, 0u) << what << ", " << name_of(form);
    for (const LinearRgb& pixel : result.picture.pixels) {
      ASSERT_TRUE(is_finite(pixel)) << what << ", " << name_of(form);
    }
  }
}

TEST(ExtremeText, BothTextsAreRightAsTheyAre) {
  EXPECT_THAT(Text{}.compile().codes, IsEmpty());
  EXPECT_THAT(Config{}.compile().codes, IsEmpty());
  expect_rendered(Text{}.compile(), "scene");
  expect_rendered(Config{}.compile(), "config");
}

TEST(ExtremeText, RadiusZeroIsToldAndNeverSeen) {
  const Compiled scene = Text{.radius = "0"}.compile(), config = Config{.radius = "0"}.compile();
  EXPECT_THAT(scene.codes, testing::ElementsAre("W402 8"));
  EXPECT_THAT(config.codes, testing::ElementsAre("W402 14"));
  expect_rendered(config, "radius 0");
  EXPECT_THAT(Text{.radius = "-1"}.compile().codes, Contains("E202 8"));
  EXPECT_THAT(Text{.radius = "-1e-300"}.compile().codes, Contains("E202 8"));
}

// Shutters over a movement from x = −2 to 2 in [0, 1] are among the known answers; here an interval
// of zero length.
TEST(ExtremeText, AMovementWithoutDurationIsAnError) {
  const Config instant{.interval = "[0, 1]", .movement = "[[2, 0, 0], 1, 1]"};
  EXPECT_THAT(instant.compile().codes, Contains(testing::StartsWith("E206")));
  // It moves 2e300 m within the shutter's second.
  const Config sudden{.interval = "[0, 1]", .movement = "[[2, 0, 0], 0, 1e-300]"};
  EXPECT_THAT(sudden.compile().codes, testing::ElementsAre("E314 13"));
}

/// H0: the sphere covers the centre of the picture for this share of the shutter. 1e-4 each.
TEST(ExtremeText, AMovingSphereCoversItsShareOfTheShutter) {
  for (const auto& [interval, share] : {std::pair{"[0, 1]", 0.5},
                                        {"[0.5, 0.5]", 1.0},
                                        {"[1, 3]", 0.0},
                                        {"[-1, 0]", 0.0},
                                        {"[0, 0.5]", 0.5},
                                        {"[0, 100]", 0.005},
                                        {"[1, 0]", 0.5},
                                        {"null", 0.0}}) {
    const Config config{.vfov = "1e-3",
                        .width = "16",
                        .samples = "256",
                        .interval = interval,
                        .origin = "[-2, 0, 0]",
                        .color = "[0, 0, 0]",
                        .movement = "[[2, 0, 0], 0, 1]"};
    const Compiled moving = config.compile();
    ASSERT_TRUE(moving.lowered);
    for (const Form& form : all_forms()) {
      if (!may_trace(form, moving.lowered->scene, moving.lowered->settings)) continue;
      EstimateBuilder builder;
      const auto result = render_in(form, moving.lowered->scene, moving.lowered->settings);
      for (const LinearRgb& pixel : result.picture.pixels) builder.add(pixel);
      EXPECT_TRUE(agrees(builder.estimate(), LinearRgb{1 - share}))
          << interval << ", " << name_of(form);
    }
  }
}

TEST(ExtremeText, AColorOf510IsTwiceWhiteAndClampsIn8Bits) {
  for (const auto& [color, linear] : {std::pair{"[510, 510, 510]", 2.0},
                                      {"[5e-324, 5e-324, 5e-324]", 0.0},
                                      {"[2.55e302, 0, 0]", 1e300}}) {
    const Compiled config = Config{.width = "4", .color = color}.compile();
    expect_rendered(config, color);
    const auto material = config.lowered->scene.materials.at(0);
    EXPECT_NEAR(material.color.r, linear, 1e-12 * linear + 1e-300) << color;
  }
}

TEST(ExtremeText, DepthZeroIsRefused) {
  EXPECT_THAT(Text{.render = "depth: 0"}.compile().codes, Contains("E202 6"));
  EXPECT_THAT(Config{.depth = "0"}.compile().codes, Contains(testing::StartsWith("E202")));
  EXPECT_TRUE(Text{.render = "width: 2, height: 2, depth: 1000000"}.compile().lowered);
  EXPECT_THAT(Text{.render = "samples: 0"}.compile().codes, Contains("E202 6"));
  EXPECT_THAT(Text{.render = "width: 0"}.compile().codes, Contains("E202 6"));
}

TEST(ExtremeText, TheHeightIsTheWidthOverTheAspectRoundedDown) {
  for (const auto& [width, aspect, height] : {std::tuple{"3", "1e-4", 30000},
                                              {"1", "1", 1},
                                              {"100000", "100000", 1},
                                              {"100000", "60000", 1},
                                              {"7", "2", 3},
                                              {"1", "0.33", 3}}) {
    const Compiled config =
        Config{.aspect = aspect, .width = width, .samples = "1", .depth = "2"}.compile();
    ASSERT_TRUE(config.lowered) << width << " / " << aspect;
    EXPECT_EQ(config.lowered->settings.width, std::stoi(width));
    EXPECT_EQ(config.lowered->settings.height, height) << width << " / " << aspect;
  }
  expect_rendered(Config{.aspect = "1e-4", .width = "1", .samples = "1", .depth = "2"}.compile(),
                  "aspect 1e-4");
  EXPECT_THAT(Config({.aspect = "9", .width = "8"}).compile().codes,
              Contains(testing::StartsWith("E209")));
  EXPECT_THAT(Config({.aspect = "0", .width = "8"}).compile().codes,
              Contains(testing::StartsWith("E202")));
}

TEST(ExtremeText, ViewsFromAMillionthOfADegreeToNearlyHalfTheSphereAreFinite) {
  for (const char* angle : {"1e-6", "1e-12", "1e-300", "90", "179.999", "179.9999999999"}) {
    expect_rendered(Config{.vfov = angle}.compile(), angle);
    expect_rendered(Text{.fov = std::string(angle) + "deg"}.compile(), angle);
  }
  for (const char* angle : {"0", "180", "360", "-1", "180.0000001"}) {
    EXPECT_FALSE(Config{.vfov = angle}.compile().lowered) << angle;
    EXPECT_THAT(Text{.fov = std::string(angle) + "deg"}.compile().codes,
                Contains(std::string("E202") + kLineOfFov))
        << angle;
  }
}

TEST(ExtremeText, ACameraWithoutAViewIsRefused) {
  EXPECT_THAT(Text{.more = "up: (0, 0, 1)"}.compile().codes, Contains("E208 5"));
  EXPECT_THAT(Text{.more = "up: (0, 0, -1e300)"}.compile().codes, Contains("E208 5"));
  EXPECT_THAT(Text{.more = "up: (1e-200, 0, 1)"}.compile().codes, Contains("E208 5"));
  EXPECT_THAT(Text{.more = "up: (0, 0, 0)"}.compile().codes, Contains("E208 5"));
  EXPECT_THAT(Text{.at = "(0, 0, 5)"}.compile().codes, Contains("E207 3"));
  EXPECT_THAT(Config{.up = "[0, 0, 3]"}.compile().codes, Contains(testing::StartsWith("E208")));
  EXPECT_THAT(Config{.at = "[0, 0, 5]"}.compile().codes, Contains(testing::StartsWith("E207")));
  expect_rendered(Text{.more = "up: (0, 1e-300, 0)"}.compile(), "a short `up`");
  expect_rendered(Text{.more = "up: (1e308, 1e308, 1e308)"}.compile(), "a long `up`");
  expect_rendered(Text{.at = "(0, 0, 4.999999999999999)"}.compile(), "`at` next to `from`");
}

TEST(ExtremeText, NoNumberIsInfiniteOrNoNumber) {
  for (const char* number : {"NaN", "Infinity", "-Infinity", "1e400", "-1e400", "nan", "inf"}) {
    const Compiled config = Config{.radius = number}.compile();
    EXPECT_FALSE(config.lowered) << number;
    EXPECT_THAT(config.codes, Contains(testing::EndsWith(" 14"))) << number;
    const Compiled scene = Text{.radius = number}.compile();
    EXPECT_FALSE(scene.lowered) << number;
    EXPECT_THAT(scene.codes, Contains(testing::EndsWith(" 8"))) << number;
  }
  EXPECT_THAT(Text{.radius = "1e308 * 10"}.compile().codes, Contains(testing::EndsWith(" 8")));
  EXPECT_THAT(Text{.radius = "1 / 0"}.compile().codes, Contains("E215 8"));
  EXPECT_THAT(Text{.radius = "sqrt(-1)"}.compile().codes, Contains("E219 8"));
}

/// A scene with the largest or the smallest possible numbers.
TEST(ExtremeText, CoordinatesOf1e308AreRenderedLikeAllOthers) {
  const auto scaled_by = [](const std::string& power) {
    return Text{.from = "(0, 0, 5e" + power + ")",
                .center = "(1e" + power + ", 0, -1e" + power + ")",
                .radius = "1e" + power}
        .compile();
  };
  const Form scalar;
  const Compiled middle = scaled_by("0");
  const auto expected = render_in(scalar, middle.lowered->scene, middle.lowered->settings);
  for (const char* power : {"307", "-307", "150", "-150"}) {
    const Compiled far = scaled_by(power);
    expect_rendered(far, power);
    const auto result = render_in(scalar, far.lowered->scene, far.lowered->settings);
    EstimateBuilder differences;
    for (std::size_t i = 0; i < result.picture.pixels.size(); ++i) {
      differences.add(result.picture.pixels[i] - expected.picture.pixels[i]);
    }
    EXPECT_TRUE(agrees(differences.estimate(), LinearRgb{})) << power;
  }
  expect_rendered(Text{.from = "(-1.7e308, 0, 0)",
                       .at = "(1.7e308, 0, 0)",
                       .center = "(1.7e308, 0, 0)",
                       .radius = "1.7e308"}
                      .compile(),
                  "from one end of the numbers to the other");
}

TEST(ExtremeText, AScenePastDoubleIsRefusedUnlessItIsForced) {
  for (const auto& [distance, radius] :
       {std::pair{"1e13", "1"}, {"1", "1e-13"}, {"1e308", "1e-300"}}) {
    const Text text{.from = std::string("(0, 0, ") + distance + ")", .radius = radius};
    EXPECT_THAT(text.compile().codes, Contains("E314 7")) << distance << ", " << radius;
    EXPECT_FALSE(text.compile({.render = {{lang::render_property::kPrecision, "float"}}}).lowered);
    const Compiled forced =
        text.compile({.render = {{lang::render_property::kPrecision, "double"}}});
    EXPECT_THAT(forced.codes, Contains("W501 7"));
    expect_rendered(forced, "forced");
  }
  EXPECT_TRUE(Text{.from = "(0, 0, 1e12)"}.compile().lowered);
}

}  // namespace
}  // namespace sdlc::test
