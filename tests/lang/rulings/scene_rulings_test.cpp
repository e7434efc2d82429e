#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lang/rulings/values.hpp"

// Rulings 28 to 35 of the language's design: time, groups, camera, settings, limits.
namespace sdlc::test {
namespace {

using render::LinearRgb;
using render::Vec3;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string camera_with(const std::string& more) {
  return "camera { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg, " + more + " }\n";
}

/// The centre of the only sphere at the opening and the closing of the shutter.
std::pair<Vec3, Vec3> path_of(const std::string& text, std::optional<int> frame = {}) {
  const auto lowered = scene_of({.root = text}, frame);
  if (lowered.scene.spheres.size() != 1) {
    ADD_FAILURE() << lowered.scene.spheres.size() << " spheres: " << text;
    return {};
  }
  const Vec3 opening = lowered.scene.spheres.at(0).center;
  return {opening, lowered.scene.shifts.empty() ? opening : opening + lowered.scene.shifts.at(0)};
}

Vec3 center_of(const std::string& text, std::optional<int> frame = {}) {
  const auto [opening, closing] = path_of(text, frame);
  EXPECT_EQ(opening, closing) << text;
  return opening;
}

TEST(Rulings, Ruling28_TimeIsTheFrameOverItsRate) {
  const std::string scene =
      kCamera + "animation { frames: 6 .. 12, fps: 4 }\n" + ball_at("(time / 1s, 0, 0)");
  EXPECT_EQ(center_of(scene).x, 6.0 / 4) << "the first frame when none is chosen";
  EXPECT_EQ(center_of(scene, 9).x, 9.0 / 4);
  EXPECT_EQ(center_of(kCamera + "animation { frames: 1 .. 9 }" + ball_at("(time / 1s, 0, 0)"), 7).x,
            7.0 / 24);
}

TEST(Rulings, Ruling28_TimeIsZeroWithoutAnAnimation) {
  EXPECT_EQ(center_of(kCamera + ball_at("(time / 1s + 3, 0, 0)")).x, 3);
  EXPECT_EQ(center_of(kCamera + ball_at("(time / 1s + 3, 0, 0)"), 5).x, 3);
}

TEST(Rulings, Ruling28_TheShutterIsRelativeToTheTime) {
  const std::string scene = camera_with("shutter: -10ms .. 250ms") +
                            "animation { frames: 0 .. 9, fps: 2 }\n" + ball_at("(time / 1s, 0, 0)");
  const auto [opening, closing] = path_of(scene, 3);
  EXPECT_EQ(opening.x, 1.5 - 10.0 / 1000);
  EXPECT_EQ(closing.x, opening.x + ((1.5 + 0.25) - opening.x));
}

TEST(Rulings, Ruling28_WithoutAShutterNothingMoves) {
  const std::string scene = "animation { frames: 0 .. 9, fps: 2 }\n" + ball_at("(time / 1s, 0, 0)");
  EXPECT_EQ(center_of(kCamera + scene, 3).x, 1.5);
  EXPECT_EQ(center_of(camera_with("shutter: none") + scene, 3).x, 1.5);
}

TEST(Rulings, Ruling29_CentersMoveInAStraightLineBetweenTheTwoEnds) {
  // Half a turn of a group: the world's centres are joined, not the angles.
  const std::string inside =
      "sphere { center: (time / 1s, 0, 0), radius: 1, material: unlit(red) }";
  const auto [opening, closing] = path_of(camera_with("shutter: 1s .. 3s") +
                                          "group { translate: (0, time / 1s, 0), rotate: "
                                          "(0deg, 0deg, 90deg * (time / 1s - 1)) " +
                                          inside + " }");
  EXPECT_EQ(opening, (Vec3{1, 1, 0}));
  EXPECT_EQ(closing, (Vec3{-3, 3, 0}));
}

TEST(Rulings, Ruling29_WhatElseDependsOnTimeIsThatOfTheOpeningWithAWarning) {
  const std::string camera = camera_with("shutter: 1s .. 3s");
  const std::string t = "(time / 1s)";
  struct Changing {
    std::string text, what;
  };
  for (const Changing& changing : std::vector<Changing>{
           {ball_at("(0, 0, 0)", t), "radius"},
           {"group { scale: " + t + " " + kBall + " }", "scale"},
           {"sphere { center: (0, 0, 0), radius: 1, material: emissive(red, " + t + ") }",
            "material"},
           {"background { color: red * " + t + " }" + kBall, "color"},
           {"for i in range(" + t + ") { " + ball_at("(3 * i, 0, 0)") + " }", "for"},
           {"if " + t + " < 2 { " + kBall + " }", "if"}}) {
    Compilation compilation({.root = camera + changing.text});
    const auto lowered = compilation.lower();
    const auto told = compilation.told();
    ASSERT_TRUE(lowered) << changing.text;
    ASSERT_EQ(told.size(), 1u) << changing.text;
    EXPECT_EQ(told[0].code, "W404") << changing.text;
    EXPECT_THAT(told[0].message, HasSubstr("`" + changing.what + "`")) << changing.text;
    ASSERT_EQ(lowered->scene.spheres.size(), 1u) << changing.text;
    EXPECT_EQ(lowered->scene.spheres.at(0).radius, 1) << changing.text;
    EXPECT_EQ(lowered->scene.shifts.size(), 0u) << changing.text;
  }
  EXPECT_THAT(codes_of({.root = "camera { from: (0, 0, 5 + " + t +
                                "), at: (0, 0, 0), fov: 40deg, "
                                "shutter: 1s .. 3s }\n" +
                                kBall}),
              ElementsAre("W404"));
}

TEST(Rulings, Ruling29_RenderSettingsMayNotDependOnTime) {
  const std::string t = "(time / 1s)";
  EXPECT_THAT(errors_of("render { width: 5 + " + t + " }"), ElementsAre("E234"));
  EXPECT_THAT(errors_of("let w = 5 + " + t + " fn f(x) = x * w render { samples: f(1) }"),
              ElementsAre("E234"));
  EXPECT_THAT(errors_of("animation { frames: 1 .. 2, fps: 24 + " + t + " }"), ElementsAre("E234"));
}

TEST(Rulings, Ruling30_AMotionIsALineInAbsoluteTimes) {
  const std::string ball =
      "sphere { center: (-2, 0, 0), radius: 1, material: unlit(red), motion: line(to: (2, 0, 0), "
      "over: 1s .. 3s) }";
  const auto ends = [&](const std::string& shutter, const std::string& more = "") {
    const auto [opening, closing] = path_of(camera_with("shutter: " + shutter) + more + ball);
    return std::pair(opening.x, closing.x);
  };
  EXPECT_EQ(ends("1s .. 3s"), (std::pair{-2.0, 2.0}));
  EXPECT_EQ(ends("0s .. 5s"), (std::pair{-4.0, 6.0})) << "extrapolated";
  EXPECT_EQ(ends("0s .. 1s", "animation { frames: 4 .. 9, fps: 2 }"), (std::pair{0.0, 2.0}))
      << "the shutter moves with the frame, the motion does not";
  EXPECT_THAT(errors_of("sphere { center: (0, 0, 0), radius: 1, material: unlit(red), motion: "
                        "line(to: (1, 0, 0), over: 1s .. 1s) }"),
              ElementsAre("E206"));
}

TEST(Rulings, Ruling30_AMotionAndACenterInTimeDoNotGoTogether) {
  for (const std::string shutter : {"none", "0s .. 1s"}) {
    const auto told = told_about(
        {.root = camera_with("shutter: " + shutter) +
                 "sphere { center: (time / 1s, 0, 0), radius: 1, material: unlit(red), motion: "
                 "line(to: (1, 0, 0), over: 0s .. 1s) }"});
    ASSERT_FALSE(told.empty()) << shutter;
    EXPECT_EQ(told[0].code, "E236") << shutter;
  }
}

TEST(Rulings, Ruling30_AMotionComposesWithMovingGroups) {
  const auto [opening, closing] = path_of(
      camera_with("shutter: 0s .. 2s") +
      "group { translate: (0, time / 1s, 0), scale: 2 sphere { center: (0, 0, 0), radius: 1, "
      "material: unlit(red), motion: line(to: (1, 0, 0), over: 0s .. 1s) } }");
  EXPECT_EQ(opening, (Vec3{0, 0, 0}));
  EXPECT_EQ(closing, (Vec3{4, 2, 0}));
}

TEST(Rulings, Ruling31_AGroupScalesThenRotatesThenMoves) {
  const auto place = [](const std::string& group, const std::string& center) {
    return center_of(kCamera + "group { " + group + " " + ball_at(center) + " }");
  };
  EXPECT_EQ(place("rotate: (90deg, 0deg, 0deg)", "(0, 1, 0)"), (Vec3{0, 0, 1})) << "right-handed";
  EXPECT_EQ(place("rotate: (0deg, 90deg, 0deg)", "(0, 0, 1)"), (Vec3{1, 0, 0}));
  EXPECT_EQ(place("rotate: (0deg, 0deg, 90deg)", "(1, 0, 0)"), (Vec3{0, 1, 0}));
  // Rx first: (0, 1, 0) becomes z, which Ry turns to x, which Rz turns to y.
  EXPECT_EQ(place("rotate: (90deg, 90deg, 90deg)", "(0, 1, 0)"), (Vec3{0, 1, 0}));
  EXPECT_EQ(place("translate: (10, 0, 0), scale: 3, rotate: (0deg, 0deg, 90deg)", "(1, 2, 0)"),
            (Vec3{4, 3, 0}));
  EXPECT_THAT(errors_of("group { scale: 0 }"), ElementsAre("E202"));
  EXPECT_THAT(errors_of("group { scale: -1 }"), ElementsAre("E202"));
}

TEST(Rulings, Ruling31_TheNearestMaterialWins) {
  const auto lowered = scene_of(
      {.root =
           kCamera +
           "group { material: unlit(linear(1, 0, 0))\n"
           "  sphere { center: (0, 0, 0), radius: 1 }\n"
           "  group { material: unlit(linear(2, 0, 0)) sphere { center: (1, 0, 0), radius: 1 }\n"
           "    sphere { center: (2, 0, 0), radius: 1, material: unlit(linear(3, 0, 0)) } }\n"
           "  group { sphere { center: (3, 0, 0), radius: 1 } } }"});
  std::vector<double> reds;
  for (const render::Sphere& sphere : lowered.scene.spheres) {
    reds.push_back(lowered.scene.materials.at(sphere.material).color.r);
  }
  EXPECT_THAT(reds, ElementsAre(1, 2, 3, 1));
  EXPECT_THAT(codes_of({.root = kCamera + "group { sphere { center: (0, 0, 0), radius: 1 } }"}),
              ElementsAre("E235"));
}

TEST(Rulings, Ruling32_ACameraHasTheseProperties) {
  const auto camera =
      scene_of({.root = "camera { from: (1, 2, 3), at: (4, 5, 7), up: (0, 0, 2), fov: "
                        "90deg, view_height: 3, aspect: 2 }" +
                        kBall});
  EXPECT_EQ(camera.scene.camera.from, (Vec3{1, 2, 3}));
  EXPECT_EQ(camera.scene.camera.at, (Vec3{4, 5, 7}));
  EXPECT_EQ(camera.scene.camera.up, (Vec3{0, 0, 2}));
  EXPECT_EQ(camera.scene.camera.aspect, 2);
  EXPECT_DOUBLE_EQ(camera.scene.camera.plane_height, 3) << "view_height tan(fov / 2)";
  const auto other = scene_of({.root = kCamera + kBall});
  EXPECT_EQ(other.scene.camera.up, (Vec3{0, 1, 0}));
  EXPECT_EQ(other.scene.camera.aspect, 16.0 / 9);
  EXPECT_DOUBLE_EQ(other.scene.camera.plane_height, 2 * 0.36397023426620234) << "2 tan 20°";
}

TEST(Rulings, Ruling32_ASingleCameraNeedsNoPicking) {
  const auto declare = [](const std::string& name, int x) {
    return "camera " + name + " { from: (" + std::to_string(x) +
           ", 0, 5), at: (0, 0, 0), fov: 40deg }\n";
  };
  const auto x_of = [](const std::string& text, const lang::Overrides& overrides = {}) {
    Compilation compilation({.root = text});
    const auto lowered = compilation.lower(overrides);
    EXPECT_THAT(compilation.codes(), IsEmpty()) << text;
    return lowered ? lowered->scene.camera.from.x : -1;
  };
  const std::string two = declare("a", 1) + declare("b", 2) + kBall;
  EXPECT_EQ(x_of(declare("a", 1) + kBall), 1);
  EXPECT_THAT(codes_of({.root = two}), ElementsAre("E111"));
  EXPECT_EQ(x_of(two + "render { camera: b }"), 2);
  EXPECT_EQ(x_of(two + "render { camera: b }", {.render = {{lang::render_property::kCamera, "a"}}}),
            1);
}

TEST(Rulings, Ruling32_TheHeightIsTheWidthOverTheAspectRoundedDown) {
  const auto size = [](const std::string& text) {
    const auto lowered = scene_of({.root = text + kBall});
    return std::pair(lowered.settings.width, lowered.settings.height);
  };
  EXPECT_EQ(size(kCamera), (std::pair{960, 540}));
  EXPECT_EQ(size(camera_with("aspect: 1.6") + "render { width: 641 }"), (std::pair{641, 400}));
  EXPECT_EQ(size(camera_with("aspect: 1.6") + "render { width: 640 }"), (std::pair{640, 400}));
  EXPECT_THAT(codes_of({.root = camera_with("aspect: 100") + "render { width: 99 }" + kBall}),
              ElementsAre("E209"));
  const auto both = scene_of({.root = kCamera + "render { width: 300, height: 100 }" + kBall});
  EXPECT_EQ(both.scene.camera.aspect, 3);
  const auto given =
      scene_of({.root = camera_with("aspect: 2") + "render { width: 300, height: 100 }" + kBall});
  EXPECT_EQ(given.scene.camera.aspect, 2);
}

TEST(Rulings, Ruling33_RenderHasTheseSettingsAndDefaults) {
  const auto plain = scene_of({.root = kCamera + kBall});
  EXPECT_EQ(plain.settings.width, 960);
  EXPECT_EQ(plain.settings.samples, 64);
  EXPECT_EQ(plain.settings.depth, 16);
  EXPECT_EQ(plain.settings.seed, 0u);
  EXPECT_EQ(plain.output.mapping.tone, render::Tone::Srgb);
  EXPECT_EQ(plain.output.output, "");
  const std::string render =
      "render { width: 5, height: 4, samples: 9, depth: 2, output: \"o.png\", tone: linear, "
      "seed: 9007199254740992, threads: 1, precision: float, sampler: independent, "
      "light_sampling: off, error: 3% }";
  const auto written = scene_of({.root = kCamera + kBall + render});
  EXPECT_EQ(written.settings.width, 5);
  EXPECT_EQ(written.settings.height, 4);
  EXPECT_EQ(written.settings.samples, 9);
  EXPECT_EQ(written.settings.depth, 2);
  EXPECT_EQ(written.settings.seed, 9007199254740992u);
  EXPECT_EQ(written.settings.threads, 1);
  EXPECT_EQ(written.precision, render::Precision::Float);
  EXPECT_EQ(plain.precision, std::nullopt);
  EXPECT_EQ(written.settings.sampler, render::SamplerKind::Independent);
  EXPECT_EQ(plain.settings.sampler, render::SamplerKind::Sobol);
  EXPECT_EQ(written.settings.light_sampling, render::LightSampling::Off);
  EXPECT_EQ(plain.settings.light_sampling, render::LightSampling::Auto);
  EXPECT_EQ(written.settings.error, 0.03);
  EXPECT_EQ(plain.settings.error, std::nullopt);
  EXPECT_EQ(written.output.mapping.tone, render::Tone::Linear);
  EXPECT_EQ(written.output.output, "o.png");
}

TEST(Rulings, Ruling33_FlagsWinOverTheScene) {
  using namespace lang::render_property;
  Compilation compilation(
      {.root = kCamera + kBall + "render { width: 5, samples: 3, tone: sqrt, precision: float }"});
  const auto lowered = compilation.lower({.render = {{kWidth, 7},
                                                     {kSamples, 8},
                                                     {kDepth, 9},
                                                     {kThreads, 2},
                                                     {kTone, "linear"},
                                                     {kPrecision, "double"}},
                                          .seed = 10});
  ASSERT_TRUE(lowered);
  EXPECT_EQ(lowered->settings.width, 7);
  EXPECT_EQ(lowered->settings.samples, 8);
  EXPECT_EQ(lowered->settings.depth, 9);
  EXPECT_EQ(lowered->settings.threads, 2);
  EXPECT_EQ(lowered->settings.seed, 10u);
  EXPECT_EQ(lowered->precision, render::Precision::Double);
  EXPECT_EQ(lowered->output.mapping.tone, render::Tone::Linear);
}

TEST(Rulings, Ruling33_ABackgroundIsAColourAGradientOrTheJsonFormats) {
  const auto background = [](const std::string& text) {
    return scene_of({.root = kCamera + kBall + text}).scene.background;
  };
  EXPECT_EQ(background("").bottom, (LinearRgb{1, 1, 1}));
  EXPECT_EQ(background("").top, (LinearRgb{127.5 / 255, 178.5 / 255, 1}));
  EXPECT_EQ(background("background { color: red }").bottom, (LinearRgb{1, 0, 0}));
  EXPECT_EQ(background("background { color: red }").top, (LinearRgb{1, 0, 0}));
  EXPECT_EQ(background("background { bottom: red, top: blue }").bottom, (LinearRgb{1, 0, 0}));
  EXPECT_EQ(background("background { bottom: red, top: blue }").top, (LinearRgb{0, 0, 1}));
}

TEST(Rulings, Ruling33_AnAnimationsOutputIsNumbered) {
  const std::string animated = kCamera + kBall + "animation { frames: 1 .. 48, fps: 12, step: 3 }";
  Compilation compilation({.root = animated + "render { output: \"a.####.png\" }"});
  const auto animation = compilation.compiler().animation();
  ASSERT_TRUE(animation);
  EXPECT_EQ(animation->first, 1);
  EXPECT_EQ(animation->last, 48);
  EXPECT_EQ(animation->step, 3);
  EXPECT_EQ(animation->fps, 12);
  EXPECT_TRUE(compilation.lower());
  EXPECT_THAT(codes_of({.root = animated + "render { output: \"a.png\" }"}), ElementsAre("E237"));
  EXPECT_THAT(codes_of({.root = animated}), IsEmpty());
  Compilation defaults({.root = kCamera + kBall + "animation { frames: 1 .. 2 }"});
  EXPECT_EQ(defaults.compiler().animation()->fps, 24);
  EXPECT_EQ(defaults.compiler().animation()->step, 1);
  EXPECT_FALSE(Compilation({.root = kCamera}).compiler().animation());
}

TEST(Rulings, Ruling33_AColourAndASizeAloneAreAPlainPicture) {
  const auto lowered = scene_of(
      {.root = "background { color: linear(0.5, 0.25, 1) } render { width: 7, height: 5 }"});
  EXPECT_TRUE(lowered.scene.spheres.empty());
  EXPECT_EQ(lowered.settings.height, 5);
  EXPECT_EQ(lowered.settings.samples, 1);
  EXPECT_THAT(codes_of({.root = "background { color: red } render { width: 7 }"}),
              ElementsAre("E212"));
  EXPECT_THAT(
      codes_of({.root = "background { color: red } render { width: 7, height: 5 }" + kBall}),
      ElementsAre("E213"));
}

/// The codes of a program under a limit of its own.
std::vector<std::string> codes_under(const lang::Limits& limits, const std::string& text,
                                     std::map<std::string, std::string> files = {}) {
  return codes_of({.root = kCamera + text, .files = std::move(files), .limits = limits});
}

TEST(Rulings, Ruling34_EachLimitHasAnErrorOfItsOwn) {
  const std::string loop = "for i in range(10) { " + ball_at("(3 * i, 0, 0)") + " }";
  EXPECT_THAT(codes_under({.steps = 1000}, loop), IsEmpty());
  EXPECT_THAT(codes_under({.steps = 100}, loop), ElementsAre("E304"));
  EXPECT_THAT(codes_under({.memory = 10'000}, loop), IsEmpty());
  EXPECT_THAT(codes_under({.memory = 1000}, loop), ElementsAre("E315"));
  EXPECT_THAT(codes_under({.objects = 10}, loop), IsEmpty());
  EXPECT_THAT(codes_under({.objects = 9}, loop), ElementsAre("E305"));
  EXPECT_THAT(codes_under({.string = 6}, "let a = \"abc\" + \"def\""), IsEmpty());
  EXPECT_THAT(codes_under({.string = 5}, "let a = \"abc\" + \"def\""), ElementsAre("E306"));
  const std::map<std::string, std::string> chain{{"a.scene", "include \"b.scene\""},
                                                 {"b.scene", kBall}};
  EXPECT_THAT(codes_under({.include_depth = 2}, "include \"a.scene\"", chain), IsEmpty());
  EXPECT_THAT(codes_under({.include_depth = 1}, "include \"a.scene\"", chain), ElementsAre("E307"));
  const std::string text = "scene 1\n" + kCamera + kBall;
  EXPECT_THAT(codes_of({.root = text, .limits = {.file = text.size()}}), IsEmpty());
  EXPECT_THAT(codes_of({.root = text, .limits = {.file = text.size() - 1}}), Contains("E308"));
}

TEST(Rulings, Ruling34_CallsIncludesAndTurnsAreSteps) {
  EXPECT_THAT(codes_under({.steps = 40}, "fn f(x) = x let a = f(1) + f(2)"), IsEmpty());
  EXPECT_THAT(codes_under({.steps = 20}, "fn f(x) = x let a = f(1) + f(2)"), ElementsAre("E304"));
  EXPECT_THAT(codes_under({.steps = 300}, "def d() { } d { } d { }"), IsEmpty());
  EXPECT_THAT(codes_under({.steps = 150}, "def d() { } d { } d { }"), ElementsAre("E304"));
  EXPECT_THAT(
      codes_under({.steps = 999}, "include \"a.scene\" include \"a.scene\"", {{"a.scene", ""}}),
      ElementsAre("E304"));
  // A limit is one error, however often it is met.
  EXPECT_THAT(codes_under({.steps = 5},
                          "for i in range(9) { for j in range(9) { } }\nlet a = "
                          "sum(range(100))"),
              ElementsAre("E304"));
}

TEST(Rulings, Ruling34_StringsOfAnyOriginAreLimited) {
  EXPECT_THAT(codes_under({.string = 5}, "let a = \"abcdef\""), ElementsAre("E306"));
  EXPECT_THAT(codes_of({.root = kCamera + "param a = \"x\"",
                        .sets = {{"a", "abcdef"}},
                        .limits = {.string = 5}}),
              ElementsAre("E306"));
}

TEST(Rulings, Ruling34_NestingIsLimitedTo128) {
  const auto nested = [](int depth) {
    return "let a = " + std::string(static_cast<std::size_t>(depth), '(') + "1" +
           std::string(static_cast<std::size_t>(depth), ')');
  };
  EXPECT_THAT(errors_of(nested(128)), IsEmpty());
  EXPECT_THAT(errors_of(nested(129)), ElementsAre("E301"));
  const std::string count = "fn f(n) = if n == 0 then 0 else 1 + f(n - 1)\n";
  EXPECT_EQ(number("f(9999)", count), 9999) << "10,000 calls";
  EXPECT_THAT(errors_in("f(10000)", count), ElementsAre("E301"));
}

TEST(Rulings, Ruling34_LongChainsOfValuesNeedNoStack) {
  std::string text;
  constexpr int kCount = 200'000;  // a million takes seconds and tells no more
  for (int i = 0; i < kCount; ++i) {
    const std::string next = std::to_string(i + 1);
    text += "let a" + std::to_string(i) + "=[a" + next + "]\n";
  }
  text += "let a" + std::to_string(kCount) + "=[1]\n";
  EXPECT_THAT(errors_of(text + "let same = a0 == a0\nlet again = [a1] == a0\n"), IsEmpty());
}

TEST(Rulings, Ruling34_ComparingListsTakesSteps) {
  // 2^60 elements, of which a comparison must not look at each.
  std::string text;
  for (int i = 0; i < 60; ++i) {
    for (const std::string name : {"a", "b"}) {
      const std::string next = name + std::to_string(i + 1);
      text += "let " + name + std::to_string(i) + " = [" + next + ", " + next + "]\n";
    }
  }
  text += "let a60 = [1] let b60 = [1]\nlet same = a0 == b0\n";
  EXPECT_THAT(codes_under({.steps = 10'000}, text), ElementsAre("E304"));
}

TEST(Rulings, Ruling34_TheSandboxKeepsToTheScenesFolder) {
  const std::map<std::string, std::string> files{{"../a.scene", ""}, {"sub/a.scene", ""}};
  const auto codes = [&](const std::string& statement, bool is_sandboxed) {
    return codes_of({.root = kCamera + statement, .files = files, .is_sandboxed = is_sandboxed});
  };
  EXPECT_THAT(codes("include \"../a.scene\"", false), IsEmpty());
  EXPECT_THAT(codes("include \"../a.scene\"", true), ElementsAre("E312"));
  EXPECT_THAT(codes("import \"sub/../../a.scene\" as a", true), ElementsAre("E312"));
  EXPECT_THAT(codes("include \"sub/a.scene\"", true), IsEmpty());
}

TEST(Rulings, Ruling35_AnotherVersionIsOneErrorAndTheEnd) {
  for (const std::string version : {"2", "0", "10"}) {
    const Told error = only_error_of("scene " + version + "\nwhat ever { comes (");
    EXPECT_EQ(error.code, "E011") << version;
    EXPECT_EQ(error.at, version);
  }
}

}  // namespace
}  // namespace sdlc::test
