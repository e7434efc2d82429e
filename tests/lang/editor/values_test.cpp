#include "lang/editor/values.hpp"

#include <map>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "lang/ast/ast.hpp"
#include "lang/ast/statements.hpp"
#include "lang/editor/cursor.hpp"
#include "lang/editor/value_text.hpp"
#include "tests/lang/editor/marked_scene.hpp"

namespace sdlc::test {
namespace {

using Status = lang::ComputedValue::Status;

/// Describes the value of the let or param that the marked name refers to.
std::string text_of(const lang::ComputedValue& computed) {
  switch (computed.status) {
    case Status::Wrong: return "wrong";
    case Status::Local: return "local " + std::string(computed.local);
    case Status::TooExpensive: return "too expensive";
    case Status::Known: break;
  }
  return lang::short_text(computed.value) + (computed.reads_time ? " by time" : "");
}

std::string value_of_name(std::map<std::string, std::string> texts) {
  MarkedScene scene(std::move(texts));
  lang::Values values(scene.view());
  return text_of(values.of_symbol(scene.view().index().at(scene.file(), scene.offset())));
}

std::string value_of_name(const std::string& text) {
  return value_of_name({{"root.scene", "scene 1\n" + text}});
}

/// The value of the property whose label is marked.
std::string value_of_property(const std::string& text) {
  MarkedScene scene("scene 1\n" + text);
  lang::Values values(scene.view());
  const auto cursor = lang::cursor_at(scene.view().tree(scene.file()), scene.offset());
  const lang::ast::Labeled property{cursor.nodes.back()};
  return text_of(values.of_expression(scene.file(), *property.value()));
}

TEST(Values, AreTheShortestNumbersThatReadBack) {
  EXPECT_EQ(value_of_name("let |a = 2 * pi\n"), "6.283185307179586");
  EXPECT_EQ(value_of_name("let |a = 0.1 + 0.2\n"), "0.30000000000000004");
  EXPECT_EQ(value_of_name("param |a: number = 3e2\n"), "300");
}

TEST(Values, UseOtherValuesOfTheScene) {
  EXPECT_EQ(value_of_name("let |a = b + f(c)\nlet c = 2\nlet b = c * c\nfn f(x, y = c) = x * y\n"),
            "8");
  EXPECT_EQ(value_of_name({{"root.scene", "scene 1\nimport \"l.scene\" as l\nlet |a = l.b * 2\n"},
                           {"l.scene", "scene 1\nlet c = 5\nlet b = f(c)\nfn f(x) = x + c\n"}}),
            "20");
}

TEST(Values, EndInCyclesOfImports) {
  EXPECT_EQ(value_of_name({{"root.scene", "scene 1\nimport \"a.scene\" as a\nlet |x = a.y + 1\n"},
                           {"a.scene", "scene 1\nimport \"b.scene\" as b\nlet y = 2 + 2\n"},
                           {"b.scene", "scene 1\nimport \"a.scene\" as a\nlet z = a.y\n"}}),
            "5");
}

TEST(Values, HaveEveryType) {
  EXPECT_EQ(value_of_name("let |a = (1, 2, 3) * 2\n"), "(2, 4, 6)");
  EXPECT_EQ(value_of_name("let |a = 20cm + 1m\n"), "1.2m");
  EXPECT_EQ(value_of_name("let |a = 1turn / 8\n"), "45deg");
  EXPECT_EQ(value_of_name("let |a = \"x\" + str(2)\n"), "\"x2\"");
  EXPECT_EQ(value_of_name("let |a = not (1 > 2)\n"), "true");
  EXPECT_EQ(value_of_name("let |a = 0s .. 20ms\n"), "0 .. 0.02");
  EXPECT_EQ(value_of_name("let |a = diffuse(#ffcc00)\n"), "diffuse(color: #ffcc00)");
  EXPECT_EQ(value_of_name("let |a = emissive(linear(2, 1, 0.5), 3)\n"),
            "emissive(color: linear(2, 1, 0.5), intensity: 3)");
  EXPECT_EQ(value_of_name("let |a = #fff * 0.5\n"), "linear(0.5, 0.5, 0.5)");
}

TEST(Values, OfListsAndStringsAreShortened) {
  EXPECT_EQ(value_of_name("let |a = range(3)\n"), "[0, 1, 2]");
  EXPECT_EQ(value_of_name("let |a = range(1000000000)\n"),
            "[0, 1, 2, 3, 4, 5, …] (1000000000 elements)");
  EXPECT_EQ(value_of_name("let |a = [[[1]]]\n"), "[[[…]]]");
  const std::string text = value_of_name("let |a = \"" + std::string(79, 'x') + "ä" + "yz\"\n");
  EXPECT_EQ(text, "\"" + std::string(79, 'x') + "…\" (83 bytes)");
}

TEST(Values, AtTheFirstFrameDependOnTheAnimation) {
  EXPECT_EQ(value_of_name("let |a = time * 2\n"), "0s by time");
  EXPECT_EQ(value_of_name("let |a = time + b\nlet b = 1s\nlet n = 12\n"
                          "animation { frames: n .. 48, fps: n + 12 }\n"),
            "1.5s by time");
  EXPECT_EQ(value_of_name("let |a = if true then 1 else time\n"), "1");
}

TEST(Values, OfLocalsAreUnknown) {
  EXPECT_EQ(value_of_property("for i in range(3) { sphere { |radius: 2 * i } }\n"), "local i");
  EXPECT_EQ(value_of_property("def d(n) { sphere { |radius: 2 * n } }\n"), "local n");
  EXPECT_EQ(value_of_property("group { let r = 1  sphere { |radius: 2 * r } }\n"), "local r");
  EXPECT_EQ(value_of_name("group { let |r = 1 + 1  sphere { radius: 2 * r } }\n"), "2");
}

TEST(Values, IgnoreGlobalsThatALocalHides) {
  EXPECT_EQ(value_of_property("let n = 7\ndef d(n) { sphere { |radius: n } }\n"), "local n");
  EXPECT_EQ(value_of_property("let n = 7\nfn f(n) = n\nsphere { |radius: f(n: n) }\n"), "7");
  EXPECT_EQ(value_of_property("let m = 7\nfn f(n) = n\n"
                              "for n in range(2) { sphere { |radius: f(n: m) } }\n"),
            "7");
}

TEST(Values, OfWrongExpressionsAreUnknown) {
  EXPECT_EQ(value_of_name("let |a = 1 / 0\n"), "wrong");
  EXPECT_EQ(value_of_name("let |a = b\nlet b = a\n"), "wrong");
  EXPECT_EQ(value_of_name("let |a = 1 + unknown\n"), "wrong");
  EXPECT_EQ(value_of_name("let |a = 1 + \n"), "wrong");
  EXPECT_EQ(value_of_name("let |a =\n"), "wrong");
  EXPECT_EQ(value_of_name("param |a: color = 3\n"), "wrong");
  EXPECT_EQ(value_of_name("let |a = 1 + b\nlet b = (2\nlet c = 3\n"), "wrong");
}

TEST(Values, ThatTakeTooLongAreGivenUp) {
  const std::string slow = "fn f(n) = if n < 2 then n else f(n - 1) + f(n - 2)\n";
  EXPECT_EQ(value_of_name(slow + "let |a = f(60)\n"), "too expensive");
  EXPECT_EQ(value_of_name("let |a = sum(range(1e9))\n"), "too expensive");
  EXPECT_EQ(value_of_name("fn f(n) = f(n)\nlet |a = f(1)\n"), "too expensive");
}

TEST(Values, DoNotNeedOthersThatTakeTooLong) {
  EXPECT_EQ(value_of_name("let slow = sum(range(1e9))\nlet |a = 1 + 1\n"), "2");
  MarkedScene scene("scene 1\nlet slow = sum(range(1e9))\nlet a = slow + 1\nlet b| = 2\n");
  lang::Values values(scene.view());
  const auto& globals = scene.view().module(0).globals;
  EXPECT_EQ(text_of(values.of_symbol({0, globals[1].node})), "too expensive");
  EXPECT_EQ(text_of(values.of_symbol({0, globals[2].node})), "2");
  EXPECT_EQ(text_of(values.of_symbol({0, globals[0].node})), "too expensive");
}

TEST(Values, OfLongChainsNeedNoMachineStack) {
  std::string text = "let |a0 = a1\n";
  for (int i = 1; i < 30'000; ++i) {
    text += "let a" + std::to_string(i) + " = a" + std::to_string(i + 1) + "\n";
  }
  EXPECT_EQ(value_of_name(text + "let a30000 = 4\n"), "4");
}

TEST(Values, HaveOtherSpellings) {
  EXPECT_EQ(lang::other_spellings(lang::Angle{180}).at(0), "3.141592653589793rad");
  EXPECT_EQ(lang::other_spellings(lang::Scalar{0.2, lang::Unit::Length}).at(0), "20cm");
  EXPECT_EQ(lang::other_spellings(lang::Scalar{0.02, lang::Unit::Time}).at(0), "20ms");
  EXPECT_TRUE(lang::other_spellings(lang::Scalar{0.2}).empty());
  EXPECT_EQ(lang::other_spellings(render::LinearRgb{1, 0.5, 0}).at(0), "≈ #ffbc00");
  EXPECT_EQ(lang::other_spellings(render::LinearRgb{1, 1, 0}).at(0), "#ffff00");
  EXPECT_TRUE(lang::other_spellings(render::LinearRgb{2, 1, 0}).empty());
}

}  // namespace
}  // namespace sdlc::test
