#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "lang/eval/eval.hpp"
#include "lang/program/program.hpp"

// Values of built-in functions, compared by the language itself: `==` is exact.
namespace sdlc::lang {
namespace {

class NoObjects final : public ObjectSink {
 public:
  void add(const Object& /*object*/) override {}
};

void expect_true(std::string_view condition) {
  const Document file("test.scene", "scene 1\nassert " + std::string(condition) + ", \"false\"\n");
  DiagnosticSink sink;
  NoObjects objects;
  evaluate(file, objects, sink);
  for (const Diagnostic& diagnostic : sink.diagnostics())
    ADD_FAILURE() << condition << ": " << diagnostic.message;
}

TEST(Functions, OfVectorsWorkByComponent) {
  expect_true("abs((-1, 2, -0.5m)) == (1, 2, 0.5m)");
  expect_true("min((1, 5, 3), (2, 4, 3), (9, 9, 0)) == (1, 4, 0)");
  expect_true("max([(1, 5, 3), (2, 4, 3)]) == (2, 5, 3)");
  expect_true("clamp((-1, 0.5, 2), (0, 0, 0), (1, 1, 1)) == (0, 0.5, 1)");
}

TEST(Functions, RotateIsExactInRightAngles) {
  for (const std::string_view length : {"1", "49", "1e-300", "1e300"}) {
    const auto rotate = [&](std::string_view axis, std::string_view angle, std::string_view to) {
      expect_true("rotate((0.1, 0.2, 0.7), " + std::string(length) + " * " + std::string(axis) +
                  ", " + std::string(angle) + ") == " + std::string(to));
    };
    rotate("(1, 0, 0)", "90deg", "(0.1, -0.7, 0.2)");
    rotate("(0, 1, 0)", "90deg", "(0.7, 0.2, -0.1)");
    rotate("(0, 0, 1)", "90deg", "(-0.2, 0.1, 0.7)");
    rotate("(0, 0, 1)", "180deg", "(-0.1, -0.2, 0.7)");
    rotate("(0, 0, -1)", "-270deg", "(0.2, -0.1, 0.7)");
    rotate("(1, 2, 3)", "1turn", "(0.1, 0.2, 0.7)");
  }
  expect_true("rotate((1, 2, 0.3), (0, 0, 1), 37deg).z == 0.3");
  expect_true("rotate((1m, 0m, 0m), (0, 0, 1), 90deg).y + 1m == 2m");
}

TEST(Functions, RotateAgreesWithTheRotationOfThreeAxes) {
  // A third of a turn about the diagonal exchanges the axes.
  expect_true("length(rotate((1, 2, 3), (1, 1, 1), 120deg) - (3, 1, 2)) < 4e-15");
  expect_true("abs(length(rotate((1, 2, 3), (4, -1, 2), 77deg))^2 - 14) < 1e-14");
}

TEST(Functions, RangeExcludesAnEndReachedUpToRounding) {
  expect_true("len(range(0, 1, 0.1)) == 10");
  expect_true("range(0, 1, 0.1)[3] == 3 * 0.1");
  expect_true("len(range(0.1, 0.7, 0.1)) == 6");
  expect_true("len(range(0, 1 + 1e-6, 0.1)) == 11");
  expect_true("len(range(1, 0, -0.1)) == 10");
  expect_true("len(range(0, 1e8, 0.1)) == 1e9");
  expect_true("len(range(0, -1, 0.1)) == 0");
  expect_true("range(0, 1, 100ms)[1] == 0.1s");
  expect_true("len(range(0s, 1s, 100ms)) == 10");
  expect_true("range(0deg, 360deg, 120deg) == [0deg, 120deg, 240deg]");
  expect_true("range(0deg, 1rad, 0.5rad) == [0deg, 0.5rad]");
  expect_true("range(2m, 3m, 500mm) == [2m, 2.5m]");
}

TEST(Functions, RangeOfWholeNumbersIsExact) {
  expect_true("len(range(0, 1e15, 1)) == 1e15");
  expect_true("range(10, 0, -4) == [10, 6, 2]");
  expect_true("range(-3, 3, 3) == [-3, 0]");
}

TEST(Functions, SortIsStable) {
  expect_true("sort([3, -1, 2m, 0]) == [-1, 0, 2, 3]");
  expect_true("sort([30deg, 0.01turn, 1rad]) == [0.01turn, 30deg, 1rad]");
  expect_true("sort([\"b\", \"ä\", \"\", \"a\", \"ab\"]) == [\"\", \"a\", \"ab\", \"b\", \"ä\"]");
  expect_true("sort([\"a\", \"b\", \"c\", \"d\"], [1, 0, 1, 0]) == [\"b\", \"d\", \"a\", \"c\"]");
  expect_true("sort([red, tan, lime], [\"r\", \"t\", \"l\"]) == [lime, red, tan]");
  expect_true("sort(range(5), reverse(range(5))) == [4, 3, 2, 1, 0]");
  expect_true("len(sort([])) == 0");
}

TEST(Functions, OfListsWorkOnEveryList) {
  expect_true("reverse([1, 2, 3]) == [3, 2, 1]");
  expect_true("len(reverse([])) == 0");
  expect_true("zip([1, 2], [3, 4], [5, 6]) == [[1, 3, 5], [2, 4, 6]]");
  expect_true("len(zip([], [])) == 0");
  expect_true("zip([1, 2], [\"a\", \"b\"]) == [[1, \"a\"], [2, \"b\"]]");
  expect_true("any([false, true]) and not any([false]) and not any([])");
  expect_true("all([true, true]) and not all([true, false]) and all([])");
}

TEST(Functions, OfNumbersKeepTheirUnits) {
  expect_true("sign(-2m) == -1 and sign(0) == 0 and sign(3deg) == 1");
  expect_true("fract(-0.25) == 0.75 and fract(2.5m) == 0.5m");
  expect_true("remap(3s, 2s, 4s, 10m, 20m) == 15m");
  expect_true("remap(5, 0, 4, 0, 8) == 10");
  expect_true("remap(0.1, 0.1, 0.7, 0.3, 0.9) == 0.3 and remap(0.7, 0.1, 0.7, 0.3, 0.9) == 0.9");
  expect_true("remap(-1e308, -1e308, 1e308, 0, 1) == 0");
  expect_true("remap(1, 0, 2, black, white) == linear(0.5, 0.5, 0.5)");
}

TEST(Functions, OfMotionAreExactAtTheEnds) {
  expect_true("smoothstep(1, 3, 1) == 0 and smoothstep(1, 3, 3) == 1");
  expect_true("smoothstep(1, 3, 0) == 0 and smoothstep(1, 3, 9) == 1");
  expect_true("smoothstep(0deg, 90deg, 45deg) == 0.5");
  expect_true("smoothstep(3, 1, 1) == 1 and smoothstep(3, 1, 1.5) == 0.84375");
  expect_true(
      "ease_in(2) == 1 and ease_out(-1, elastic) == 0 and ease_in_out(1, curve: back) == 1");
  expect_true("ease_in(0.5, curve: quad) == 0.25 and ease_in(0.5, quart) == 0.0625");
}

TEST(Functions, StrRoundsTheBinaryValueHalvesToEven) {
  expect_true("str(0.125, digits: 2) == \"0.12\" and str(0.375, digits: 2) == \"0.38\"");
  expect_true("str(2.675, digits: 2) == \"2.67\"");  // the double is below
  expect_true("str(-0.001, digits: 2) == \"0.00\" and str(-0.5, digits: 0) == \"0\"");
  expect_true("str(1.5m, digits: 2) == \"1.50m\" and str(30deg, 1) == \"30.0deg\"");
  expect_true("str(1e22, digits: 1) == \"10000000000000000000000.0\"");
  expect_true(
      "str(-5, width: 4, fill: \"0\") == \"-005\" and str(-5, width: 4, fill: \"é\") == \"éé-5\"");
  expect_true("str(\"ä\", width: 3) == \"  ä\" and str(12345, width: 3) == \"12345\"");
  expect_true("str(1 / 3) == \"0.3333333333333333\"");
}

TEST(Functions, OfChanceAreFixed) {
  expect_true("random_on_sphere(7).z == 2 * random(7, \"random_on_sphere\", 0) - 1");
  expect_true("random_in_disc(1, \"a\").z == 0");
  expect_true("noise((0.5, 0.25, 0.75), octaves: 1) == noise((0.5, 0.25, 0.75))");
}

}  // namespace
}  // namespace sdlc::lang
