#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lang/rulings/values.hpp"

// Rulings 17 to 27 of the language's design: values and functions. Numbers are compared bit by bit.
namespace sdlc::test {
namespace {

using render::LinearRgb;
using render::Vec3;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kBeyond = 1e308;

TEST(Rulings, Ruling17_ThereAreTenTypesOfValues) {
  const std::string params =
      "param a: number = 1 param b: bool = true param c: string = \"s\" param d: vec3 = (1, 2, 3)\n"
      "param e: angles = (1deg, 2deg, 3deg) param f: angle = 1deg param g: color = red\n"
      "param h: interval = 0 .. 1 param i: list = [1, 2] param j: material = unlit(red)\n";
  EXPECT_THAT(errors_of(params), IsEmpty());
  EXPECT_THAT(errors_of("param a: point = (1, 2, 3)"), ElementsAre("E118"));
  for (const std::string type : {"number", "bool", "string", "vec3", "angles", "angle", "color",
                                 "interval", "list", "material"}) {
    const std::string other = type == "number" ? "red" : "1";
    EXPECT_THAT(errors_of("param a: " + type + " = " + other), ElementsAre("E232")) << type;
  }
}

TEST(Rulings, Ruling17_VectorsAddAndScaleAndHaveParts) {
  EXPECT_EQ(vec3("(1, 2, 3) + (4, 5, 6) - (1, 1, 1)"), (Vec3{4, 6, 8}));
  EXPECT_EQ(vec3("2 * (1, 2, 3) * 3"), (Vec3{6, 12, 18}));
  EXPECT_EQ(vec3("(1, 2, 3) / 2"), (Vec3{0.5, 1, 1.5}));
  EXPECT_EQ(number("v.x + 10 * v.y + 100 * v.z", "let v = (1, 2, 3)"), 321);
  EXPECT_EQ(degrees("r.x + r.y + r.z", "let r = (10deg, 20deg, 30deg)"), 60);
  for (const char* wrong : {"(1, 2, 3) * (1, 2, 3)", "(1, 2, 3) + 1", "1 / (1, 2, 3)", "\"a\" * 2",
                            "true + true", "unlit(red) * 2", "[1] - [2]"}) {
    EXPECT_THAT(errors_in(wrong), ElementsAre("E217")) << wrong;
  }
  EXPECT_THAT(errors_in("(1, 2, 3).w"), ElementsAre("E226"));
}

TEST(Rulings, Ruling17_AListHoldsOneTypeAndItsIndexIsChecked) {
  EXPECT_EQ(number("l[2] + len(l)", "let l = [5, 6, 7]"), 10);
  EXPECT_THAT(errors_in("sum([1, \"a\"])"), ElementsAre("E225"));
  EXPECT_THAT(errors_in("sum([1m, 2s])"), ElementsAre("E225"));
  for (const char* index : {"3", "-1", "1e300"}) {
    EXPECT_THAT(errors_in("l[" + std::string(index) + "]", "let l = [5, 6, 7]"),
                ElementsAre("E227"))
        << index;
  }
}

TEST(Rulings, Ruling18_WhatHasNoResultIsAnErrorAtItsOperator) {
  struct Wrong {
    std::string expression, code, at;
  };
  const std::vector<Wrong> all{
      {"1 / 0", "E215", "/"},
      {"1 / -0", "E215", "/"},
      {"(1, 2, 3) / 0", "E215", "/"},
      {"1deg / 0deg", "E215", "/"},
      {"mod(1, 0)", "E215", "mod"},
      {"0 ^ -1", "E215", "^"},
      {"1e308 * 10", "E216", "*"},
      {"1e308 + 1e308", "E216", "+"},
      {"1e200 ^ 2", "E216", "^"},
      {"exp(1000)", "E216", "exp"},
      {"sqrt(-1)", "E219", "sqrt"},
      {"log(0)", "E219", "log"},
      {"(-1) ^ 0.5", "E219", "^"},
      {"normalize((0, 0, 0))", "E219", "normalize"},
      {"tan(90deg)", "E219", "tan"},
      {"atan2(0, 0)", "E219", "atan2"},
      {"asin(1.5)", "E219", "asin"},
      {"sum([1e308, 1e308])", "E216", "[1e308, 1e308]"},
      {"1e400", "E205", "1e400"},
      {"length((1e308, 1e308, 1e308)) * 2", "E216", "*"},
      {"dot((1e308, 0, 0), (10, 0, 0))", "E216", "dot"},
      {"cross((1e308, 0, 0), (0, 10, 0))", "E216", "cross"},
      {"mix(1e308, 0, -1)", "E216", "mix"},
      {"mix((1e308, 0, 0), (0, 0, 0), -1)", "E216", "mix"},
      {"mix(1e308deg, 0deg, -1)", "E216", "mix"},
      {"mix(linear(1e308, 0, 0), black, -1)", "E216", "mix"},
  };
  for (const Wrong& wrong : all) {
    const Told error = only_error_of("let a = " + wrong.expression);
    EXPECT_EQ(error.code, wrong.code) << wrong.expression;
    EXPECT_EQ(error.at, wrong.at) << wrong.expression;
  }
  EXPECT_EQ(number("mix(1e308, 0, 0.5)"), kBeyond / 2);
}

TEST(Rulings, Ruling18_MinusZeroPrintsAndHashesAsZero) {
  EXPECT_EQ(text("str(-0) + str(0 * -5) + str(-0.0)"), "000");
  EXPECT_EQ(number("random(-0)"), number("random(0)"));
  EXPECT_EQ(number("random((-0, 1, -0))"), number("random((0, 1, 0))"));
  EXPECT_EQ(number("random(-0deg)"), number("random(0deg)"));
  EXPECT_TRUE(is_true("0 == -0"));
}

TEST(Rulings, Ruling19_AnglesAreHeldInDegreesAndReducedExactly) {
  EXPECT_EQ(number("sin(180deg)"), 0);
  EXPECT_EQ(number("tan(45deg)"), 1);
  EXPECT_EQ(number("cos(60deg)"), 0.5);
  EXPECT_EQ(number("cos(90deg) + sin(1turn) + tan(-180deg)"), 0);
  EXPECT_EQ(number("sin(1e22deg)"), number("sin(280deg)")) << "10^22 mod 360 is 280";
  EXPECT_EQ(number("cos(1e6turn + 120deg)"), -0.5);
  EXPECT_EQ(degrees("0.1turn"), 0.1 * 360);
  EXPECT_EQ(degrees("1rad"), 57.29577951308232);
}

TEST(Rulings, Ruling19_TrigonometryTakesAnglesAndItsInversesReturnThem) {
  EXPECT_EQ(degrees("atan2(1, -1)"), 135);
  EXPECT_EQ(degrees("asin(1) + acos(-1)"), 270);
  EXPECT_EQ(degrees("asin(0.5) * 2"), 60);
  EXPECT_EQ(degrees("acos(0.5)"), 60);
  EXPECT_EQ(number("90deg / 1turn"), 0.25);
  EXPECT_THAT(errors_in("1deg * 1deg"), ElementsAre("E217"));
  EXPECT_THAT(errors_in("1deg + 1"), ElementsAre("E217"));
  EXPECT_THAT(errors_in("asin(1deg)"), ElementsAre("E228"));
}

TEST(Rulings, Ruling19_ABareNumberForAnAngleGetsTheUnit) {
  for (const std::string wrong :
       {"camera { from: (0, 0, 5), at: (0, 0, 0), fov: 40 }", "group { rotate: (0, 30deg, 0deg) }",
        "let a = sin(30)", "let a = hsl(0, 100%, 50%)"}) {
    EXPECT_THAT(only_error_of(wrong).fixes, ElementsAre("deg")) << wrong;
    EXPECT_THAT(errors_of(with_fixes(wrong)), IsEmpty()) << with_fixes(wrong);
  }
}

TEST(Rulings, Ruling20_UnitsAreTagsThatDoNotAddUp) {
  EXPECT_EQ(number("1m + 50cm + 5mm + 1km"), 1 + 50.0 / 100 + 5.0 / 1000 + 1000);
  EXPECT_EQ(number("2m + 1"), 3) << "one unit is a metre";
  for (const char* wrong : {"1m + 1s", "1s - 1m", "1m == 1s", "1m < 1s", "(1m, 1s, 0)", "1m .. 1s",
                            "max(1m, 1s)", "(1m, 0, 0) + (1s, 0, 0)"}) {
    EXPECT_EQ(errors_in(wrong).size(), 1u) << wrong;
  }
  for (const std::string wrong :
       {"sphere { center: (0, 0, 0), radius: 1s, material: unlit(red) }", "render { width: 5m }",
        "group { translate: (1s, 0, 0) }", "group { scale: 2m }",
        "group { material: emissive(red, 1m) }",
        "camera { from: (0, 0, 5), at: (0, 0, 0), fov: 1deg, shutter: 0m .. 1m }",
        "let a = range(2m)", "let a = asin(1m)"}) {
    EXPECT_EQ(errors_of(wrong).size(), 1u) << wrong;
  }
}

TEST(Rulings, Ruling20_ProductsWithPlainNumbersKeepTheTagAndOthersDropIt) {
  const auto radius = [](const std::string& expression) {
    return errors_of(ball_at("(0, 0, 0)", expression));
  };
  EXPECT_THAT(radius("2 * 3m / 4"), IsEmpty());
  EXPECT_THAT(radius("2 * 3s"), ElementsAre("E201"));
  EXPECT_THAT(radius("3s / 4"), ElementsAre("E201"));
  EXPECT_THAT(radius("3s / 1s"), IsEmpty());
  EXPECT_THAT(radius("3s * 2m"), IsEmpty());
  EXPECT_THAT(radius("6m / 2s"), IsEmpty());
  EXPECT_THAT(radius("1 / 2s"), IsEmpty());
  EXPECT_THAT(radius("sqrt(4s)"), IsEmpty());
  const auto place = [](const std::string& expression) {
    return errors_of("group { translate: " + expression + " }");
  };
  EXPECT_THAT(place("2 * (1s, 0, 0) / 3"), ElementsAre("E201"));
  EXPECT_THAT(place("(1s, 0, 0) / 1s"), IsEmpty());
  EXPECT_THAT(place("(1s, 0, 0) * 2m"), IsEmpty());
}

TEST(Rulings, Ruling21_WhereAWholeNumberIsMeantAPartIsAnErrorThatNamesTheRemedy) {
  for (const std::string wrong :
       {"render { width: 2.5 }", "render { samples: 2.5 }", "render { depth: 2.5 }",
        "animation { frames: 1 .. 2.5 }", "let a = range(2.5)", "let a = range(1, 2.5)",
        "let a = ([1, 2, 3])[2.5]"}) {
    const Told error = only_error_of(wrong);
    EXPECT_EQ(error.code, "E204") << wrong;
    EXPECT_THAT(error.help, ElementsAre(testing::AllOf(HasSubstr("floor"), HasSubstr("round"))))
        << wrong;
  }
}

TEST(Rulings, Ruling21_ARangeExcludesItsEndAndAnIntervalIsNoList) {
  EXPECT_TRUE(is_true("range(4) == [0, 1, 2, 3]"));
  EXPECT_TRUE(is_true("range(2, 5) == [2, 3, 4]"));
  EXPECT_TRUE(is_true("range(2, 9, 3) == [2, 5, 8] and range(3, 0, -2) == [3, 1]"));
  EXPECT_EQ(number("len(range(5, 2)) + len(range(0))"), 0);
  const Told error = only_error_of("for i in 0 .. 3 { }");
  EXPECT_EQ(error.code, "E230");
  EXPECT_THAT(error.fixes, ElementsAre("range(0, 4)"));
  EXPECT_THAT(errors_in("len(0 .. 3)"), ElementsAre("E228"));
}

TEST(Rulings, Ruling22_EqualityIsExactAndOfOneType) {
  EXPECT_TRUE(is_true("0.1 + 0.2 != 0.3"));
  EXPECT_TRUE(is_true("\"a\" == \"a\" and (1, 2, 3) == (1, 2, 3) and red == #f00"));
  EXPECT_TRUE(is_true("unlit(red) == unlit(#f00) and [1, 2] != [1, 2, 3]"));
  EXPECT_TRUE(is_true("[[1], [2, 3]] == [[1], [2, 3]] and [[1], [2, 3]] != [[1], [2, 4]]"));
  for (const char* wrong : {"1 == \"1\"", "1 == true", "1deg == 1", "red == (1, 0, 0)"}) {
    EXPECT_THAT(errors_in(wrong), ElementsAre("E224")) << wrong;
  }
}

TEST(Rulings, Ruling22_RoundingModuloAndPowersAreFixed) {
  EXPECT_EQ(number("round(2.5)"), 3);
  EXPECT_EQ(number("round(-2.5)"), -3);
  EXPECT_EQ(number("round(0.49999999999999994)"), 0);
  EXPECT_EQ(number("mod(-1, 3)"), 2);
  EXPECT_EQ(number("mod(1, -3)"), -2);
  EXPECT_EQ(number("mod(1e22, 7)"), 4) << "10^22 mod 7, exactly";
  EXPECT_EQ(number("1.1^2"), 1.1 * 1.1);
  EXPECT_EQ(number("1.1^3"), 1.1 * 1.1 * 1.1);
  EXPECT_EQ(number("-2^2"), -4);
  EXPECT_EQ(number("2^-1"), 0.5);
  EXPECT_EQ(number("2^3^2"), 512) << "from the right";
}

TEST(Rulings, Ruling22_StrIsTheShortestTextThatReadsBack) {
  EXPECT_EQ(text("str(0.1)"), "0.1");
  EXPECT_EQ(text("str(1 / 3)"), "0.3333333333333333");
  EXPECT_EQ(text("str(5e-324)"), "5e-324");
  EXPECT_EQ(text("str(100)"), "100");
  EXPECT_EQ(text("str(true) + str(\"x\")"), "truex");
}

TEST(Rulings, Ruling22_AllTopLevelValuesAreCheckedButBranchesOnlyAsNeeded) {
  EXPECT_THAT(errors_of("let unused = 1 / 0"), ElementsAre("E215"));
  EXPECT_THAT(errors_of("param unused = sqrt(-1)"), ElementsAre("E219"));
  EXPECT_EQ(number("if true then 1 else 1 / 0"), 1);
  EXPECT_EQ(number("if false then 1 / 0 else if true then 2 else 1 / 0"), 2);
  EXPECT_FALSE(is_true("(false and 1 / 0 == 1)"));
  EXPECT_TRUE(is_true("(true or 1 / 0 == 1)"));
  EXPECT_THAT(errors_in("true and 1 / 0 == 1"), ElementsAre("E215"));
}

TEST(Rulings, Ruling23_CodesAndNamesAreEncodedAsInCss) {
  const LinearRgb expected{0.18782077230067787, 0.26225065752969623, 0.10224173308810132};
  EXPECT_EQ(color("rgb(120, 140, 90)"), expected);
  EXPECT_EQ(color("#788c5a"), expected);
  EXPECT_EQ(color("tan"),
            (LinearRgb{0.6444796819705821, 0.45641102318040466, 0.26225065752969623}));
  EXPECT_EQ(color("#fa0"), color("#ffaa00"));
  EXPECT_EQ(color("rgb(127.5, 0, 255)"), (LinearRgb{0.21404114048223255, 0, 1}));
  EXPECT_EQ(color("hsl(210deg, 60%, 40%)"),
            (LinearRgb{0.021980947079887205, 0.13286832155381798, 0.3672464682101826}));
  EXPECT_EQ(color("hsl(-150deg, 60%, 40%)"), color("hsl(210deg, 60%, 40%)"));
  EXPECT_THAT(errors_in("rgb(256, 0, 0)"), ElementsAre("E202"));
}

TEST(Rulings, Ruling23_LinearColoursAreTakenAsTheyAre) {
  EXPECT_EQ(color("linear(1, 0.5, 20)"), (LinearRgb{1, 0.5, 20}));
  EXPECT_EQ(color("linear255(63.9, 255, 0)"), (LinearRgb{63.9 / 255, 1, 0}));
  EXPECT_NE(63.9 / 255 * 255, 63.9) << "which is why linear255 is kept";
}

TEST(Rulings, Ruling23_KelvinIsKimsCubicWithALargestComponentOfOne) {
  EXPECT_EQ(color("kelvin(1667)"), (LinearRgb{1, 0.17575376418828828, 0}));
  EXPECT_EQ(color("kelvin(2000)"), (LinearRgb{1, 0.25622119541729294, 0.007922987864222368}));
  EXPECT_EQ(color("kelvin(3000)"), (LinearRgb{1, 0.4785256136553254, 0.1543167428805946}));
  EXPECT_EQ(color("kelvin(6500)"), (LinearRgb{1, 0.9435584499741619, 0.9927550938382514}));
  EXPECT_EQ(color("kelvin(25000)"), (LinearRgb{0.37735356489388744, 0.5123461472559966, 1}));
  EXPECT_THAT(errors_in("kelvin(1666)"), ElementsAre("E202"));
  EXPECT_THAT(errors_in("kelvin(25001)"), ElementsAre("E202"));
}

TEST(Rulings, Ruling23_ColoursAreMixedLinearlyAndMultipliedByComponent) {
  EXPECT_EQ(color("mix(black, white, 25%)"), (LinearRgb{0.25, 0.25, 0.25}));
  EXPECT_EQ(color("linear(1, 2, 3) * linear(2, 3, 4)"), (LinearRgb{2, 6, 12}));
  EXPECT_EQ(color("linear(1, 2, 3) * 2 + linear(1, 1, 1) / 2"), (LinearRgb{2.5, 4.5, 6.5}));
}

TEST(Rulings, Ruling24_MaterialsHaveTheirArgumentsAndDefaults) {
  using enum lang::MaterialKind;
  const LinearRgb white{1, 1, 1}, red{1, 0, 0};
  EXPECT_EQ(material("diffuse(color: red)"), (lang::MaterialValue{Diffuse, red, 0, false}));
  EXPECT_EQ(material("specular(color: red)"), (lang::MaterialValue{Specular, red, 0, false}));
  EXPECT_EQ(material("specular(red, 0.3)"), (lang::MaterialValue{Specular, red, 0.3, false}));
  EXPECT_EQ(material("transmissive(ior: 1.5)"),
            (lang::MaterialValue{Transmissive, white, 1.5, false}));
  EXPECT_EQ(material("transmissive(red, 1.5, exact)"),
            (lang::MaterialValue{Transmissive, red, 1.5, true}));
  EXPECT_EQ(material("emissive(red)"), (lang::MaterialValue{Emissive, red, 1, false}));
  EXPECT_EQ(material("emissive(red, intensity: 8)"),
            (lang::MaterialValue{Emissive, red, 8, false}));
  EXPECT_EQ(material("unlit(color: red)"), (lang::MaterialValue{Unlit, red, 0, false}));
  for (const char* wrong :
       {"diffuse()", "specular(fuzz: 1)", "transmissive()", "emissive()", "unlit()"}) {
    EXPECT_THAT(errors_in(wrong), ElementsAre("E107")) << wrong;
  }
  EXPECT_THAT(errors_in("transmissive(ior: 1, fresnel: fast)"), ElementsAre("E108"));
}

TEST(Rulings, Ruling25_TheFunctionsAreThese) {
  const std::vector<std::string> calls{
      "sqrt(4) == 2",
      "abs(-3) == 3",
      "min(4, 2, 3) == 2",
      "max([1, 5, 2]) == 5",
      "clamp(7, 1, 3) == 3",
      "floor(-2.5) == -3",
      "ceil(-2.5) == -2",
      "round(2.5) == 3",
      "exp(1) == 2.718281828459045",
      "log(10) == 2.302585092994046",
      "sin(30deg) == 0.5",
      "cos(0deg) == 1",
      "tan(0deg) == 0",
      "asin(1) == 90deg",
      "acos(1) == 0deg",
      "atan2(1, 0) == 90deg",
      "mod(7, 4) == 3",
      "sum([1, 2, 3.5]) == 6.5",
      "len([1, 2]) == 2",
      "str(1) == \"1\"",
      "dot((1, 2, 3), (4, 5, 6)) == 32",
      "cross((1, 0, 0), (0, 1, 0)) == (0, 0, 1)",
      "length((3, 4, 0)) == 5",
      "normalize((0, 0, 9)) == (0, 0, 1)",
      "mix(1, 3, 0.5) == 2",
      "random(1) < 1",
      "noise((0, 0, 0)) < 1",
      "pi == 3.141592653589793",
  };
  for (const std::string& call : calls) EXPECT_TRUE(is_true(call)) << call;
}

// The bits of the elementary functions are tested in tests/lang/math. The transfer curve in
// render/image/tone.cpp still asks the host for a power.
TEST(Rulings, Ruling25_TheHostsElementaryFunctionsAreNeverUsed) {
  const std::regex call(
      "std::(sin|cos|tan|asin|acos|atan|atan2|exp|exp2|expm1|log|log2|log10|log1p|pow|hypot|cbrt)"
      "\\(");
  const std::filesystem::path root = SDLC_SOURCE_DIR;
  std::vector<std::filesystem::path> files{root / "render/shading/pinhole.hpp"};
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "lang")) {
    const std::filesystem::path extension = entry.path().extension();
    if (extension == ".cpp" || extension == ".hpp") files.push_back(entry.path());
  }
  for (const std::filesystem::path& file : files) {
    std::ifstream stream(file);
    ASSERT_TRUE(stream) << file;
    for (std::string line; std::getline(stream, line);) {
      EXPECT_FALSE(std::regex_search(line, call)) << file << ": " << line;
    }
  }
  EXPECT_GT(files.size(), 50u);
}

TEST(Rulings, Ruling26_RandomNumbersAreSpecifiedBitForBit) {
  EXPECT_EQ(number("random(1)"), .73087526727066165);
  EXPECT_EQ(number("random(1, 2)"), .10157249976416438);
  EXPECT_EQ(number("random(0)"), .36818951565166946);
  EXPECT_EQ(number("random(\"ball\", 0.5)"), .74756360267880151);
  EXPECT_EQ(number("random((1, 2, 3))"), .094651159579525301);
  // From a second implementation, in Python.
  EXPECT_EQ(number("random(true)"), 0.8766756214195504);
  EXPECT_EQ(number("random(false)"), 0.3922164624235318);
  EXPECT_EQ(number("random(30deg)"), 0.020769292405662276);
  EXPECT_EQ(number("random(\"é, a longer text\")"), 0.7110452992752454);
  EXPECT_EQ(number("random((0, 0.5, -1), \"x\", true)"), 0.060968168501698616);
  EXPECT_EQ(number("random(1m)"), number("random(1)")) << "a number is its bits";
  EXPECT_THAT(errors_in("random()"), ElementsAre("E229"));
  EXPECT_THAT(errors_in("random(red)"), ElementsAre("E228"));
}

TEST(Rulings, Ruling27_NoiseIsInterpolatedBetweenRandomNumbersOfALattice) {
  const auto corner = [](const std::string& at) {
    return 2 * number("random(\"noise\", " + at + ")") - 1;
  };
  EXPECT_EQ(number("noise((3, -2, 7))"), corner("3, -2, 7"));
  const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const auto join = [](double a, double b, double t) { return a + t * (b - a); };
  EXPECT_EQ(number("noise((3.25, -2, 7))"),
            join(corner("3, -2, 7"), corner("4, -2, 7"), fade(0.25)));
  // x innermost: rounding differs in another order.
  const double x = fade(0.3 - 0), y = fade(-7.9 + 8), z = fade(0.5);
  const auto along_x = [&](const std::string& yz) {
    return join(corner("0, " + yz), corner("1, " + yz), x);
  };
  const auto along_y = [&](const std::string& k) {
    return join(along_x("-8, " + k), along_x("-7, " + k), y);
  };
  EXPECT_EQ(number("noise((0.3, -7.9, 2.5))"), join(along_y("2"), along_y("3"), z));
  EXPECT_EQ(number("noise((0.5, 0.25, 0.75))"), 0.3815970819668423);
  EXPECT_EQ(number("noise((-1.25, 3.5, 100.1))"), -0.509008277453363);
}

}  // namespace
}  // namespace sdlc::test
