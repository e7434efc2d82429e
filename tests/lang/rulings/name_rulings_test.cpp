#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lang/rulings/values.hpp"

// Rulings 9 to 16 of the language's design: names, kinds, files.
namespace sdlc::test {
namespace {

using render::Vec3;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<Vec3> centers_in(const lang::LoweredScene& lowered) {
  std::vector<Vec3> centers;
  for (const render::Sphere& sphere : lowered.scene.spheres) centers.push_back(sphere.center);
  return centers;
}

std::vector<Vec3> centers_of(Sources sources) {
  sources.root = kCamera + sources.root;
  return centers_in(scene_of(std::move(sources)));
}

TEST(Rulings, Ruling09_TheTopLevelIsFreeOfOrder) {
  EXPECT_THAT(centers_of({.root = "pair { n: a }\nlet a = f(b)\nfn f(x) = x + c\nparam b = c + 1\n"
                                  "def pair(n) { " +
                                  ball_at("(n, 0, 0)") + "}\nlet c = 10\n"}),
              ElementsAre(Vec3{21, 0, 0}));
}

TEST(Rulings, Ruling09_ACircleIsAnErrorThatPrintsTheCircle) {
  const Told error = only_error_of("let a = b + 1\nlet b = f(2)\nfn f(x) = x * a\nlet d = a");
  EXPECT_EQ(error.code, "E117");
  EXPECT_EQ(error.at, "a");
  EXPECT_THAT(error.help, ElementsAre("the cycle is `a` → `b` → `f` → `a`"));
  EXPECT_EQ(only_error_of("let a = a").code, "E117");
}

TEST(Rulings, Ruling09_ALetOfABlockIsVisibleBehindItInItsBlock) {
  EXPECT_THAT(
      centers_of({.root = "let x = 1\nif true {\n  let y = x + 1\n  let x = 5\n  if true { " +
                          ball_at("(x, y, 0)") + " let x = 7 }\n  " + ball_at("(x, 0, 0)", "2") +
                          "}\n" + ball_at("(x, 0, 0)", "3")}),
      ElementsAre(Vec3{5, 2, 0}, Vec3{5, 0, 0}, Vec3{1, 0, 0}));
  EXPECT_THAT(errors_of("if true { " + ball_at("(y, 0, 0)") + " let y = 1 }"), ElementsAre("E101"));
  EXPECT_THAT(errors_of("if true { let y = 1 } let z = y"), ElementsAre("E101"));
  EXPECT_THAT(centers_of({.root = "if true { let x = 2 if true { let x = 3 " +
                                  ball_at("(x, 0, 0)") + "} " + ball_at("(x, 0, 0)") + "}"}),
              ElementsAre(Vec3{3, 0, 0}, Vec3{2, 0, 0}));
}

TEST(Rulings, Ruling09_SomeStatementsStandAtTheTopOnly) {
  for (const std::string statement :
       {"param p = 1", "import \"a.scene\" as a",
        "camera { from: (0, 0, 1), at: (0, 0, 0), fov: 1deg }", "background { color: red }",
        "render { width: 5 }", "animation { frames: 1 .. 2 }"}) {
    for (const std::string open : {"if true { ", "for i in [1] { ", "group { ", "def made() { "}) {
      const Told error = only_error_of(open + statement + " }");
      EXPECT_EQ(error.code, "E119") << open << statement;
      EXPECT_EQ(error.at, statement.substr(0, statement.find(' ')));
    }
  }
}

TEST(Rulings, Ruling09_BackgroundRenderAndAnimationStandOnceInAFile) {
  for (const std::string object :
       {"background { color: red }", "render { width: 5 }", "animation { frames: 1 .. 2 }"}) {
    const Told error = only_error_of(object + " " + object);
    EXPECT_EQ(error.code, "E106") << object;
    EXPECT_THAT(error.labels, ElementsAre(HasSubstr("first given here"))) << object;
  }
  const std::string camera = " { from: (0, 0, 1), at: (0, 0, 0), fov: 1deg }";
  EXPECT_THAT(errors_of("camera a" + camera + "camera b" + camera), IsEmpty());
}

// The lint of names that hide names of the file is still to come.
TEST(Rulings, Ruling10_NamesOfTheFileBeatBuiltInsWithoutAWord) {
  EXPECT_EQ(number("pi + time + red", "let pi = 3 let time = 4 let red = 5"), 12);
  EXPECT_EQ(number("sqrt(5) + rgb(1)", "fn sqrt(x) = x fn rgb(x) = x"), 6);
  EXPECT_EQ(number("pi", "fn pi(x) = x"), 3.141592653589793) << "functions are apart";
  EXPECT_THAT(centers_of({.root = "def lamp() { " + ball_at("(1, 0, 0)") + "} lamp { }" +
                                  "def group() { " + ball_at("(2, 0, 0)") + "} group { }"}),
              ElementsAre(Vec3{1, 0, 0}, Vec3{2, 0, 0}));
  EXPECT_THAT(errors_of("let _unused = 1"), IsEmpty());
}

TEST(Rulings, Ruling11_ANameInFrontOfAParenthesisIsAFunction) {
  EXPECT_EQ(number("tan(45deg)"), 1);
  EXPECT_EQ(color("tan"), color("#d2b48c"));
  EXPECT_EQ(number("f + f(1)", "let f = 10 fn f(x) = x"), 11);
}

TEST(Rulings, Ruling11_FunctionsAndDefsAreNoValues) {
  EXPECT_THAT(errors_in("f", "fn f(x) = x"), ElementsAre("E115"));
  EXPECT_THAT(errors_in("sqrt"), ElementsAre("E115"));
  EXPECT_THAT(errors_in("ring", "def ring() { }"), ElementsAre("E101"));
  EXPECT_THAT(errors_in("ring(1)", "def ring(n) { }"), ElementsAre("E103"));
}

TEST(Rulings, Ruling11_NamesOfObjectsAreLabels) {
  const std::string ball = "sphere a { center: (a, 0, 0), radius: a, material: unlit(red) }";
  EXPECT_THAT(errors_of("let a = 1 def d() { } " + ball + ball + "group a { } d a { }"), IsEmpty());
  EXPECT_THAT(errors_of("sphere b { center: (b, 0, 0), radius: 1, material: unlit(red) }"),
              ElementsAre("E101"));
}

TEST(Rulings, Ruling12_ABareWordIsThePropertysOwn) {
  const auto lowered = scene_of(
      {.root =
           "let sqrt = 1 let main = 2 let exact = 3\n"
           "render { tone: sqrt, camera: main }\n"
           "camera main { from: (1, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
           "camera other { from: (2, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
           "sphere { center: (0, 0, 0), radius: 1,\n"
           "  material: transmissive(ior: 1.5, fresnel: if main > 5 then schlick else exact) }"});
  EXPECT_EQ(lowered.output.mapping.tone, render::Tone::Sqrt);
  EXPECT_EQ(lowered.scene.camera.from.x, 1);
  ASSERT_EQ(lowered.scene.materials.size(), 1u);
  EXPECT_EQ(lowered.scene.materials.at(0).fresnel, render::Fresnel::Exact);
}

TEST(Rulings, Ruling13_OnlyGroupsDefsLoopsAndConditionsHoldStatements) {
  const std::string inside =
      "let a = 1 if a > 0 { } for i in [1] { } assert true, \"\" group { } " + kBall;
  for (const std::string open : {"group { ", "def d() { ", "for i in [1] { ", "if true { ",
                                 "if false { } else if true { ", "if false { } else { "}) {
    EXPECT_THAT(errors_of(open + inside + " }"), IsEmpty()) << open;
  }
  for (const std::string statement : {"let a = 1", "if true { }", "for i in [1] { }", "group { }",
                                      "assert true, \"\"", "include \"a.scene\""}) {
    const Told error = only_error_of("render { width: 5 " + statement + " height: 5 }");
    EXPECT_EQ(error.code, "E114") << statement;
    EXPECT_EQ(error.at, statement.substr(0, statement.find(' ')));
  }
}

TEST(Rulings, Ruling13_APropertyInsideAConditionGetsTheConditionalValue) {
  const Told error = only_error_of(
      "sphere { center: (0, 0, 0), material: unlit(red), radius: 1, if true { radius: 2 } }");
  EXPECT_EQ(error.code, "E114");
  EXPECT_THAT(error.help, ElementsAre("write `radius: if … then … else …`"));
  EXPECT_THAT(only_error_of("render { if true { width: 2 } }").help,
              ElementsAre("write `width: if … then … else …`"));
  EXPECT_THAT(only_error_of("group { if true { scale: 2 } }").help,
              ElementsAre(HasSubstr("`scale: if … then … else …`")));
}

TEST(Rulings, Ruling14_ADefsParametersArePropertiesOfItsKind) {
  EXPECT_THAT(
      centers_of({.root = "def row(n: number, gap = n * 2) {\n"
                          "  for i in range(n) { " +
                          ball_at("(i * gap, 0, 0)") +
                          " }\n}\n"
                          "row { n: 2 }\nrow named { gap: 1, n: 1, translate: (0, 9, 0) }"}),
      ElementsAre(Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 9, 0}));
  const std::string def = "def row(n: number, gap = 1) { }\n";
  EXPECT_THAT(errors_of(def + "row { gap: 2 }"), ElementsAre("E107"));
  EXPECT_THAT(errors_of(def + "row { n: red }"), ElementsAre("E232"));
  EXPECT_THAT(errors_of(def + "row { n: 1, n: 2 }"), ElementsAre("E106"));
  const Told unknown = only_error_of(def + "row { n: 1, gpa: 2 }");
  EXPECT_EQ(unknown.code, "E104");
  EXPECT_THAT(unknown.fixes, ElementsAre("gap"));
}

TEST(Rulings, Ruling14_EachInstanceIsAGroup) {
  const auto lowered =
      scene_of({.root = kCamera + "def dot() { sphere { center: (1, 0, 0), radius: 1 } }\n"
                                  "dot { translate: (0, 0, 5), rotate: (0deg, 0deg, 90deg), "
                                  "scale: 2, material: unlit(lime) }"});
  ASSERT_EQ(lowered.scene.spheres.size(), 1u);
  EXPECT_EQ(lowered.scene.spheres.at(0).center, (Vec3{0, 2, 5}));
  EXPECT_EQ(lowered.scene.spheres.at(0).radius, 2);
  EXPECT_EQ(lowered.scene.materials.at(0).color, (render::LinearRgb{0, 1, 0}));
}

TEST(Rulings, Ruling14_AParameterNamedMaterialTakesThatOnesPlace) {
  // The sphere without a material does not get the parameter: it is a value of the body.
  const std::string def =
      "def pair(material = unlit(red)) {\n"
      "  sphere { center: (0, 0, 0), radius: 1, material: material }\n}\n";
  const auto lowered = scene_of({.root = kCamera + def + "pair { material: unlit(lime) }"});
  EXPECT_EQ(lowered.scene.materials.at(0).color, (render::LinearRgb{0, 1, 0}));
  EXPECT_THAT(
      codes_of({.root = kCamera + "def one(material) { sphere { center: (0, 0, 0), radius: 1 } }\n"
                                  "one { material: unlit(lime) }"}),
      ElementsAre("E235"));
  for (const std::string name : {"translate", "rotate", "scale"}) {
    const Told error = only_error_of("def d(" + name + ") { }");
    EXPECT_EQ(error.code, "E121");
    EXPECT_EQ(error.at, name);
  }
}

TEST(Rulings, Ruling14_RecursionIsAllowed) {
  // A flake: each ball carries two of half its size.
  const std::string flake =
      "def flake(levels) {\n  sphere { center: (0, 0, 0), radius: 1 }\n  if levels > 0 {\n"
      "    flake { levels: levels - 1, scale: 0.5, translate: (1.5, 0, 0) }\n"
      "    flake { levels: levels - 1, scale: 0.5, translate: (0, 1.5, 0) }\n  }\n}\n";
  const auto centers = centers_of({.root = flake + "flake { levels: 2, material: unlit(red) }"});
  EXPECT_THAT(centers,
              ElementsAre(Vec3{0, 0, 0}, Vec3{1.5, 0, 0}, Vec3{2.25, 0, 0}, Vec3{1.5, 0.75, 0},
                          Vec3{0, 1.5, 0}, Vec3{0.75, 1.5, 0}, Vec3{0, 2.25, 0}));
}

TEST(Rulings, Ruling15_AnImportBringsNamesAndNoObjects) {
  const std::string library = "param size = 2 fn twice(x) = 2 * x let base = size\n" +
                              ball_at("(9, 9, 9)") + "def dot(x) { " +
                              ball_at("(x, base, 0)", "size") + " }";
  EXPECT_THAT(centers_of({.root = "import \"lib/a.scene\" as a\n" +
                                  ball_at("(a.size, a.twice(3), 0)") + "a.dot { x: 5 }",
                          .files = {{"lib/a.scene", library}}}),
              ElementsAre(Vec3{2, 6, 0}, Vec3{5, 2, 0}));
}

TEST(Rulings, Ruling15_AnIncludePlacesObjectsAndNeverSettings) {
  const std::string included =
      "camera other { from: (7, 7, 7), at: (0, 0, 0), fov: 1deg }\n"
      "render { width: 7 } background { color: lime }\n"
      "animation { frames: 1 .. 9 }\n" +
      ball_at("(1, 0, 0)");
  const auto lowered = scene_of(
      {.root = kCamera + "group { translate: (0, 5, 0) include \"a.scene\" }\ninclude \"a.scene\"",
       .files = {{"a.scene", included}}});
  EXPECT_THAT(centers_in(lowered), ElementsAre(Vec3{1, 5, 0}, Vec3{1, 0, 0}));
  EXPECT_EQ(lowered.settings.width, 960);
  EXPECT_EQ(lowered.scene.camera.from, (Vec3{0, 0, 5}));
  EXPECT_EQ(lowered.scene.background.bottom, (render::LinearRgb{1, 1, 1}));
}

TEST(Rulings, Ruling15_EachFileKeepsItsScopeAndVersion) {
  const std::string root = kCamera + "let mine = 1 let shared = 2 include \"a.scene\"";
  EXPECT_THAT(codes_of({.root = root, .files = {{"a.scene", ball_at("(mine, 0, 0)")}}}),
              ElementsAre("E101"));
  EXPECT_THAT(centers_of({.root = "let shared = 2 include \"a.scene\"",
                          .files = {{"a.scene", "let shared = 5 " + ball_at("(shared, 0, 0)")}}}),
              ElementsAre(Vec3{5, 0, 0}));
  EXPECT_THAT(codes_of({.root = root, .files = {{"a.scene", "scene 2\nwhat ever"}}}),
              ElementsAre("E011"));
}

TEST(Rulings, Ruling15_TheSpheresOfAConfigCanBeIncluded) {
  const std::string config =
      R"({"camera": {"look_from": [9, 9, 9], "look_at": [0, 0, 0], "up": [0, 1, 0], "vfov": 9,
      "focal_length": 1, "aspect_ratio": 1, "viewport_height": 2, "samples_per_pixel": 3},
      "rendering": {"width": 7, "render_depth": 3}, "saving": {"path": "x.ppm", "gamma_correct": true},
      "spheres": [{"origin": [1, 2, 3], "radius": 1,
                   "material": {"type": "no_texture", "color": [51, 102, 255]}}]})";
  const auto lowered =
      scene_of({.root = kCamera + "group { translate: (1, 0, 0), scale: 2 include \"a.json\" }",
                .files = {{"a.json", config}}});
  EXPECT_THAT(centers_in(lowered), ElementsAre(Vec3{3, 4, 6}));
  EXPECT_EQ(lowered.settings.width, 960);
  EXPECT_EQ(lowered.scene.materials.at(0).color, (render::LinearRgb{0.2, 0.4, 1}));
}

TEST(Rulings, Ruling15_ACircleOfFilesIsAnErrorThatShowsTheCircle) {
  const auto told = told_about({.root = kCamera + "include \"a.scene\"",
                                .files = {{"a.scene", "import \"b.scene\" as b"},
                                          {"b.scene",
                                           "include \"a.scene\" def d() { include "
                                           "\"a.scene\" }"}}});
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told[0].code, "E310");
  EXPECT_THAT(told[0].help, ElementsAre("the cycle is `a.scene` → `b.scene` → `a.scene`"));
  EXPECT_THAT(codes_of({.root = kCamera + "include \"test.scene\""}), ElementsAre("E310"));
  // A circle that only shows when the objects are placed: importing did not place them.
  EXPECT_THAT(
      codes_of({.root = kCamera + "import \"b.scene\" as b include \"a.scene\"",
                .files = {{"a.scene", "include \"b.scene\""}, {"b.scene", "include \"a.scene\""}}}),
      ElementsAre("E310"));
}

TEST(Rulings, Ruling16_SetReachesTheParamsOfTheRoot) {
  const std::string root =
      "import \"lib.scene\" as lib\nparam n = 1 param at = (0, 0, 0) let m = n\n" +
      ball_at("at + (m, lib.n, 0)");
  EXPECT_THAT(centers_of({.root = root,
                          .files = {{"lib.scene", "param n = 5"}},
                          .sets = {{"n", "2 + 1"}, {"at", "(0, 0, 4)"}}}),
              ElementsAre(Vec3{3, 5, 4}));
  for (const std::string name : {"m", "lib", "nn", ""}) {
    EXPECT_THAT(codes_of({.root = kCamera + root,
                          .files = {{"lib.scene", "param n = 5"}},
                          .sets = {{name, "2"}}}),
                ElementsAre("E122"))
        << name;
  }
}

TEST(Rulings, Ruling16_ASettingIsAnExpressionOfTheParamsTypeOverBuiltIns) {
  const std::string root =
      "param c = red param p = (1, 2, 3) param a = 1deg param n = 1 let m = 2\n";
  const auto codes_with = [&](const std::string& name, const std::string& value) {
    return codes_of({.root = kCamera + root, .sets = {{name, value}}});
  };
  EXPECT_THAT(codes_with("c", "#ff0000"), IsEmpty());
  EXPECT_THAT(codes_with("p", "(0,1,0)"), IsEmpty());
  EXPECT_THAT(codes_with("a", "30deg"), IsEmpty());
  EXPECT_THAT(codes_with("n", "sqrt(2) * pi"), IsEmpty());
  EXPECT_THAT(codes_with("n", "red"), ElementsAre("E238"));
  EXPECT_THAT(codes_with("n", "m"), ElementsAre("E101")) << "names of the file are none of its";
  EXPECT_THAT(codes_with("n", "1 2"), ElementsAre("E001"));
  EXPECT_THAT(codes_with("n", ""), ElementsAre("E014"));
  EXPECT_THAT(codes_with("n", "1 / 0"), ElementsAre("E215"));
  EXPECT_THAT(codes_with("n", "time / 1s"), ElementsAre("E234"));
}

TEST(Rulings, Ruling16_AStringParamTakesTheTextAsItIs) {
  const Sources sources{.root = kCamera +
                                "param name = \"a\" param other: string = \"b\"\n"
                                "render { output: name + other + \".png\" }",
                        .sets = {{"name", "\"x\\ny\" + 1"}, {"other", ""}}};
  EXPECT_EQ(scene_of(sources).output.output, "\"x\\ny\" + 1.png");
}

// The lint of unused names is still to come.
TEST(Rulings, Ruling16_PositionalArgumentsComeBeforeNamedOnes) {
  EXPECT_EQ(number("f(1, z: 3, y: 2)", "fn f(x, y, z) = x + 10 * y + 100 * z"), 321);
  EXPECT_THAT(errors_in("f(y: 2, 1)", "fn f(x, y) = x"), ElementsAre("E116"));
  EXPECT_THAT(errors_in("specular(fuzz: 1, red)"), ElementsAre("E116"));
}

}  // namespace
}  // namespace sdlc::test
