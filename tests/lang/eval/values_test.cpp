#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lang/eval/eval.hpp"
#include "lang/program/program.hpp"

// Values are compared bit by bit: a scene means the same on every machine.
namespace sdlc::lang {
namespace {

class Objects final : public ObjectSink {
 public:
  void add(const Object& object) override { list.push_back(object); }
  std::vector<Object> list;
};

std::vector<Object> evaluate_text(const std::string& text) {
  const Document file("test.scene", "scene 1\n" + text);
  DiagnosticSink sink;
  Objects objects;
  evaluate(file, objects, sink);
  for (const Diagnostic& diagnostic : sink.diagnostics())
    ADD_FAILURE() << text << ": " << diagnostic.message;
  return objects.list;
}

const Object& only(const std::vector<Object>& objects) {
  EXPECT_EQ(objects.size(), 1u);
  return objects.at(0);
}

double number(const std::string& expression) {
  const auto objects = evaluate_text(
      "sphere { center: (0, 0, 0), material: unlit(red), radius: " + expression + " }");
  return only(objects).get<double>(sphere_property::kRadius).value_or(-1);
}

double degrees(const std::string& expression) {
  const auto objects =
      evaluate_text("camera { from: (0, 0, 0), at: (0, 0, 1), fov: " + expression + " }");
  return only(objects).get<Angle>(camera_property::kFov).value_or(Angle{-1}).degrees;
}

render::Interval shutter(const std::string& expression) {
  const auto objects = evaluate_text(
      "camera { from: (0, 0, 0), at: (0, 0, 1), fov: 1deg, shutter: " + expression + " }");
  return only(objects)
      .get<render::Interval>(camera_property::kShutter)
      .value_or(render::Interval{-1, -1});
}

TEST(Values, OfNumbersAreTheNearest) {
  EXPECT_EQ(number("0.1"), 0.1);
  EXPECT_EQ(number(".5"), 0.5);
  EXPECT_EQ(number("1_000.2_5e-1"), 100.025);
  EXPECT_EQ(number("9007199254740993"), 9007199254740992.0);
  EXPECT_EQ(number("5e-324"), 5e-324);
  EXPECT_EQ(number("1e-400"), 0.0);
  EXPECT_EQ(number("0e999999999999999999999"), 0.0);
  EXPECT_EQ(number("0.000000000001e-999999999999999999999"), 0.0);
}

TEST(Values, OfUnitsAreDividedOrMultipliedOnce) {
  EXPECT_EQ(number("35%"), 35.0 / 100);
  EXPECT_EQ(number("9mm"), 9.0 / 1000);
  EXPECT_EQ(number("35cm"), 35.0 / 100);
  EXPECT_EQ(number("7m"), 7.0);
  EXPECT_EQ(number("0.3km"), 0.3 * 1000);
  EXPECT_EQ(shutter("1s .. 13ms"), (render::Interval{1, 13.0 / 1000}));
  EXPECT_EQ(degrees("0.1turn"), 0.1 * 360);
  EXPECT_EQ(degrees("1rad"), 57.29577951308232);
  EXPECT_EQ(degrees("40deg"), 40.0);
}

TEST(Values, OfArithmetic) {
  EXPECT_EQ(number("1 + 2 * 3 - 4 / 8"), 6.5);
  EXPECT_EQ(number("-2^2 + 5"), 1.0);
  EXPECT_EQ(number("2^-1"), 0.5);
  EXPECT_EQ(number("0.1^2"), 0.1 * 0.1);
  EXPECT_EQ(number("0.1^3"), 0.1 * 0.1 * 0.1);
  EXPECT_EQ(number("(-2)^3 + 9"), 1.0);
  EXPECT_EQ(number("2^0.5"), 1.4142135623730951);
  EXPECT_EQ(number("90deg / 1turn"), 0.25);
  EXPECT_EQ(degrees("(10deg + 20deg) * 2 / 3 - 1deg"), 19.0);
  EXPECT_EQ(number("2m * 3"), 6.0);
  EXPECT_EQ(number("6m / 2m"), 3.0);
  EXPECT_EQ(number("1m + 50cm"), 1.5);
}

TEST(Values, OfTriples) {
  const auto objects = evaluate_text(
      "sphere { center: (1, 2, 3) * 2 - (1, 1, 1) / 4, radius: 1, material: unlit(red) }");
  EXPECT_EQ(only(objects).get<render::Vec3>(sphere_property::kCenter),
            (render::Vec3{1.75, 3.75, 5.75}));
}

TEST(Values, OfMaterials) {
  const auto objects = evaluate_text(
      "sphere { center: (0, 0, 0), radius: 1, material: transmissive(ior: 1.5, fresnel: exact),"
      " motion: line(to: (1, 2, 3), over: 1 .. 2s) }");
  const auto material = only(objects).get<MaterialValue>(sphere_property::kMaterial);
  EXPECT_EQ(material,
            (MaterialValue{MaterialKind::Transmissive, render::LinearRgb{1, 1, 1}, 1.5, true}));
  EXPECT_EQ(only(objects).get<MotionValue>(sphere_property::kMotion),
            (MotionValue{{1, 2, 3}, {1, 2}}));
}

TEST(Values, OfMaterialsTakeTheirDefaults) {
  const auto objects = evaluate_text(
      "sphere { center: (0, 0, 0), radius: 1, material: specular(linear(1, 0.5, 0)) }"
      "sphere { center: (0, 0, 0), radius: 1, material: emissive(linear(1, 0.5, 0)) }");
  ASSERT_EQ(objects.size(), 2u);
  const render::LinearRgb color{1, 0.5, 0};
  EXPECT_EQ(objects[0].get<MaterialValue>(sphere_property::kMaterial),
            (MaterialValue{MaterialKind::Specular, color, 0, false}));
  EXPECT_EQ(objects[1].get<MaterialValue>(sphere_property::kMaterial),
            (MaterialValue{MaterialKind::Emissive, color, 1, false}));
}

TEST(Values, OfStringsHaveTheirEscapesResolved) {
  const auto objects = evaluate_text(R"(render { output: "a\"\\\/\n\u00e9\ud83d\ude00é" })");
  EXPECT_EQ(only(objects).get<std::string>(render_property::kOutput),
            "a\"\\/\n\xC3\xA9\xF0\x9F\x98\x80\xC3\xA9");
}

TEST(Values, OfWordsAndNone) {
  const auto objects = evaluate_text(
      "camera white { from: (0, 0, 0), at: (0, 0, 1), fov: 1deg, shutter: none } render { camera: "
      "white, tone: sqrt }");
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0].name, "white");
  EXPECT_TRUE(holds_alternative<None>(objects[0].slot(camera_property::kShutter).value));
  EXPECT_EQ(objects[1].get<Word>(render_property::kCamera), Word{"white"});
  EXPECT_EQ(objects[1].get<Word>(render_property::kTone), Word{"sqrt"});
}

TEST(Values, ComeInTheOrderOfTheFileBehindTheSettings) {
  const auto objects = evaluate_text(
      "sphere a { center: (0, 0, 0), radius: 1, material: unlit(red) } background { }"
      "sphere b { center: (0, 0, 0), radius: 1, material: unlit(red) }");
  ASSERT_EQ(objects.size(), 3u);
  EXPECT_EQ(objects[0].kind->name, "background");
  EXPECT_EQ(objects[1].name, "a");
  EXPECT_EQ(objects[2].name, "b");
}

TEST(Values, OfTwoMillionTermsAreSummedWithoutRecursion) {
  std::string terms = "1";
  for (int i = 1; i < 2'000'000; ++i) terms += "+1";
  EXPECT_EQ(number(terms), 2e6);
}

TEST(Values, OfConditionsListsAndMembers) {
  EXPECT_EQ(number("if 1 < 2 then 3 else 4"), 3);
  EXPECT_EQ(number("if 1 > 2 then 3 else if 2 == 2 then 5 else 4"), 5);
  EXPECT_EQ(number("if not (1 <= 2) or 3 >= 4 then 3 else 4"), 4);
  EXPECT_EQ(number("if (1, 2, 3) == (1, 2, 3) and [1, 2] != [1, 3] then 3 else 4"), 3);
  EXPECT_EQ(number("if 0 == -0 and \"a\" == \"a\" and 90deg == 0.25turn then 3 else 4"), 3);
  EXPECT_EQ(number("([1, 2, 7])[2]"), 7);
  EXPECT_EQ(number("([[1, 2], [3, 4]])[1][0]"), 3);
  EXPECT_EQ(number("(1, 2, 3).y"), 2);
  EXPECT_EQ(degrees("(10deg, 20deg, 30deg).z"), 30);
}

TEST(Values, OfFunctionsOfNumbers) {
  EXPECT_EQ(number("sqrt(2)"), 1.4142135623730951);
  EXPECT_EQ(number("abs(-3) + min(4, 2, 3) + max([1, 5, 2])"), 10);
  EXPECT_EQ(number("clamp(7, 1, 3)"), 3);
  EXPECT_EQ(number("floor(2.7) * 100 + ceil(2.2) * 10 + round(2.5)"), 233);
  EXPECT_EQ(number("mod(-1, 3)"), 2);
  EXPECT_EQ(number("sum([1, 2, 3.5])"), 6.5);
  EXPECT_EQ(number("len(range(2, 9, 3))"), 3);
  EXPECT_EQ(number("range(2, 9, 3)[2]"), 8);
  EXPECT_EQ(number("len(range(5, 2)) + sum(range(4))"), 6);
  EXPECT_EQ(number("sin(30deg)"), 0.5);
  EXPECT_EQ(number("1 + sin(180deg)"), 1);
  EXPECT_EQ(number("tan(45deg)"), 1);
  EXPECT_EQ(degrees("atan2(1, 1)"), 45);
  EXPECT_EQ(degrees("acos(0)"), 90);
  EXPECT_EQ(number("exp(1)"), 2.718281828459045);
  EXPECT_EQ(number("log(10)"), 2.302585092994046);
}

TEST(Values, OfFunctionsOfVectorsAndColours) {
  EXPECT_EQ(number("dot((1, 2, 3), (4, 5, 6))"), 32);
  EXPECT_EQ(number("cross((1, 0, 0), (0, 1, 0)).z"), 1);
  EXPECT_EQ(number("length((3, 4, 0))"), 5);
  EXPECT_EQ(number("length((3e300, 4e300, 0)) / 1e300"), 5);
  EXPECT_EQ(number("normalize((0, 1e-300, 0)).y"), 1);
  EXPECT_EQ(number("mix(1, 3, 25%)"), 1.5);
  EXPECT_EQ(number("mix((0, 0, 0), (4, 8, 0), 0.5).y"), 4);
}

// The values of the language's definition.
TEST(Values, OfRandomAreFixed) {
  EXPECT_EQ(number("random(1)"), .73087526727066165);
  EXPECT_EQ(number("random(1, 2)"), .10157249976416438);
  EXPECT_EQ(number("random(-0)"), .36818951565166946);
  EXPECT_EQ(number("random(\"ball\", 0.5)"), .74756360267880151);
  EXPECT_EQ(number("random((1, 2, 3))"), .094651159579525301);
}

double radius_of_last(const std::string& text) {
  const auto objects = evaluate_text(text);
  return objects.empty() ? -1 : objects.back().get<double>(sphere_property::kRadius).value_or(-1);
}

std::string ball(const std::string& radius) {
  return "sphere { center: (0, 0, 0), material: unlit(red), radius: " + radius + " }\n";
}

TEST(Values, OfNamesFunctionsAndLoops) {
  EXPECT_EQ(radius_of_last("let b = a * 2 let a = 3 " + ball("b")), 6);
  EXPECT_EQ(radius_of_last("fn f(x, y = 2) = x * y " + ball("f(3) + f(3, y: 5)")), 21);
  EXPECT_EQ(radius_of_last("fn f(n) = if n <= 1 then 1 else n * f(n - 1) " + ball("f(10)")),
            3628800);
  EXPECT_EQ(radius_of_last("let v = (1, 2, 3) " + ball("v.z + (v).y")), 5);
  EXPECT_EQ(radius_of_last("let l = [4, 5] " + ball("l[1]")), 5);
  EXPECT_EQ(radius_of_last("for i in range(1, 4) { let s = i * i " + ball("s") + "}"), 9);
  EXPECT_EQ(
      radius_of_last("for i in [2, 7] { if i > 5 { " + ball("i") + "} else { " + ball("1") + "} }"),
      7);
  EXPECT_EQ(
      evaluate_text("for i in range(3) { for j in range(4) { " + ball("i + j") + "} }").size(),
      12u);
  // The file's own names take precedence over those of the language.
  EXPECT_EQ(radius_of_last("let pi = 3 fn sqrt(x) = x " + ball("sqrt(pi)")), 3);
}

TEST(Values, MayBeChainedAsLongAsAFileIs) {
  std::string text;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    text += "let a" + std::to_string(i) + " = a" + std::to_string(i + 1) + " + 1\n";
    text += "let l" + std::to_string(i) + " = [l" + std::to_string(i + 1) + "]\n";
  }
  text += "let a" + std::to_string(kCount) + " = 1\nlet l" + std::to_string(kCount) + " = [1]\n";
  EXPECT_EQ(radius_of_last(text + ball("a0 + len(l0)")), kCount + 2);
}

TEST(Values, StopWhenAFileTakesTooManySteps) {
  const Document file("test.scene", "scene 1\nfor i in range(100) { for j in range(100) { } }");
  DiagnosticSink sink;
  Objects objects;
  ProgramOptions options;
  options.limits.steps = 1000;
  Program program(file, options, sink);
  Evaluation(program, {}, sink).run(objects);
  ASSERT_EQ(sink.error_count(), 1u);
  EXPECT_EQ(sink.diagnostics().front().info->code, "E304");
}

TEST(Values, OfBrokenSpheresEndInSilence) {
  std::string text = "scene 1\n";
  for (int i = 0; i < 30; ++i) text += "for i in range(3) { ";
  text += "sphere { center: (0, 0, 0), radius: 1, material: unknown }" + std::string(30, '}');
  const Document file("test.scene", text);
  DiagnosticSink sink;
  Objects objects;
  Program program(file, {.limits = {.steps = 100'000}}, sink);
  Evaluation(program, {}, sink).run(objects);
  ASSERT_EQ(sink.error_count(), 1u);
  EXPECT_EQ(sink.diagnostics().front().info->code, "E101");
}

TEST(Values, OfSettingsAreResolvedOnce) {
  const Document file("test.scene", "scene 1\nparam a = 1\nparam b = 2\nparam c = time\n");
  DiagnosticSink sink;
  Program program(file, {.limits = {}, .sets = {{"a", "2 + 3"}, {"b", "2 +"}, {"c", "$"}}}, sink);
  EXPECT_EQ(sink.error_count(), 0u);
  std::uint32_t modules = 0;
  std::size_t errors = 0;
  for (int i = 0; i < 3; ++i) {
    DiagnosticSink evaluating;
    const Evaluation evaluation(program, {.frame = i}, evaluating);
    if (i == 0) errors = evaluating.error_count();
    if (i == 0) modules = program.module_count();
    EXPECT_EQ(evaluating.error_count(), errors);
    EXPECT_EQ(program.module_count(), modules);
  }
  EXPECT_GE(errors, 2u);
}

TEST(Values, StopOnRequest) {
  const Document file("test.scene", "scene 1\nfor i in range(1000) { for j in range(1000) { } }");
  StopRequest stop;
  DiagnosticSink sink(&stop);
  Objects objects;
  Program program(file, {}, sink);
  Evaluation evaluation(program, {}, sink);
  stop.make();
  EXPECT_THROW(evaluation.run(objects), StopRequested);
}

}  // namespace
}  // namespace sdlc::lang
