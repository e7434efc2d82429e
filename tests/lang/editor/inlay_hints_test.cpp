#include "lang/editor/inlay_hints.hpp"

#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "tests/lang/editor/marked_scene.hpp"

namespace sdlc::test {
namespace {

/// The text with its hints in angle brackets.
std::string hinted(const std::string& text, std::optional<lang::Span> range = std::nullopt) {
  MarkedScene scene("scene 1\n" + text);
  std::string result(scene.view().file(0).text());
  const auto hints = lang::inlay_hints(scene.view(), 0, range);
  for (auto hint = hints.rbegin(); hint != hints.rend(); ++hint) {
    result.insert(hint->offset, "<" + hint->text + ">");
  }
  return result.substr(std::string("scene 1\n").size());
}

TEST(InlayHints, NamePositionalArguments) {
  EXPECT_EQ(hinted("sphere { material: specular(red, fuzz: 0.1) }\n"),
            "sphere { material: specular(<color:>red, fuzz: 0.1) }\n");
  EXPECT_EQ(hinted("fn f(x, y) = x\nsphere { radius: f(1, f(2, y: 3)) }\n"),
            "fn f(x, y) = x\nsphere { radius: f(<x:>1, <y:>f(<x:>2, y: 3)) }\n");
  EXPECT_EQ(hinted("fn f(x) = sqrt(x)\nfn g(x) = f(x)\n"), "fn f(x) = sqrt(x)\nfn g(x) = f(x)\n");
  EXPECT_EQ(hinted("sphere { radius: f(1, 2, 3), material: rgb(1, 2, 3, 4\n"),
            "sphere { radius: f(1, 2, 3), material: rgb(<r:>1, <g:>2, <b:>3, 4\n");
}

TEST(InlayHints, ShowValuesOfComputedLets) {
  EXPECT_EQ(hinted("let a = 2 * pi\nlet b = 3\nlet c = (1, -2, 3)\nparam d = a > b\n"),
            "let a = 2 * pi<= 6.283185307179586>\nlet b = 3\nlet c = (1, -2, 3)\n"
            "param d = a > b<= true>\n");
  EXPECT_EQ(hinted("let a = red\nlet b = diffuse(color: linear(r: 1, g: 0, b: -0))\n"),
            "let a = red\nlet b = diffuse(color: linear(r: 1, g: 0, b: -0))\n");
  EXPECT_EQ(hinted("let red = 1\nlet a = red\nlet b = sqrt(4)\n"),
            "let red = 1\nlet a = red<= 1>\nlet b = sqrt(4)<= 2>\n");
  EXPECT_EQ(hinted("let a = time * 2\n"), "let a = time * 2<= 0s at the first frame>\n");
  EXPECT_EQ(hinted("for i in range(3) { let a = i * 2  let b = 1 + 1 }\n"),
            "for i in range(3) { let a = i * 2  let b = 1 + 1<= 2> }\n");
  EXPECT_EQ(hinted("let a = 1 / 0\nlet b = sum(range(1e9))\nlet c =\n"),
            "let a = 1 / 0\nlet b = sum(range(1e9))\nlet c =\n");
}

TEST(InlayHints, AreInTheRange) {
  const std::string text = "let a = 1 + 1\nlet b = 2 + 2\nlet c = 3 + 3\n";
  EXPECT_EQ(hinted(text, lang::Span{22, 35}), "let a = 1 + 1\nlet b = 2 + 2<= 4>\nlet c = 3 + 3\n");
}

}  // namespace
}  // namespace sdlc::test
