#include "lang/editor/hover.hpp"

#include <map>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/editor/keywords.hpp"
#include "lang/resolve/builtin_symbols.hpp"
#include "lang/value/builtins.hpp"
#include "tests/lang/editor/marked_scene.hpp"

namespace sdlc::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string hover_in(std::map<std::string, std::string> texts) {
  MarkedScene scene(std::move(texts));
  const auto hover = lang::hover(scene.view(), scene.file(), scene.offset());
  return hover ? hover->markdown : "none";
}

std::string hover_at(const std::string& text) {
  return hover_in({{"root.scene", "scene 1\n" + text}});
}

/// The text that the hover describes.
std::string place_at(const std::string& text) {
  MarkedScene scene("scene 1\n" + text);
  const auto hover = lang::hover(scene.view(), scene.file(), scene.offset());
  return hover ? std::string(scene.view().file(0).text(hover->where)) : "none";
}

TEST(Hover, ShowsDeclarationValueAndDocumentationOfALet) {
  EXPECT_EQ(hover_at("/// Once around.\nlet circle = 2 * pi\nlet b = cir|cle\n"),
            "```scene\nlet circle = 2 * pi\n```\n\nValue: `6.283185307179586`\n\n"
            "Type: `number`\n\nOnce around.");
  EXPECT_THAT(hover_at("let |a = 5\n"), Not(HasSubstr("Value")));
  EXPECT_THAT(
      hover_at("param |a: angle = 90deg\n"),
      AllOf(HasSubstr("param a: angle = 90deg"), HasSubstr("Value: `1.5707963267948966rad`")));
}

TEST(Hover, NamesTheFileOfAnImportedDeclaration) {
  EXPECT_THAT(hover_in({{"root.scene", "scene 1\nimport \"l.scene\" as l\nlet a = l.un|it\n"},
                        {"l.scene", "scene 1\nlet unit = 1 + 1\n"}}),
              AllOf(HasSubstr("let unit = 1 + 1"), HasSubstr("Value: `2`"),
                    HasSubstr("Declared in `l.scene`.")));
}

TEST(Hover, ShowsPathAndDescriptionOfAnImport) {
  const std::string root = "scene 1\nimport \"l.scene\" as l\nlet a = |l.unit\n";
  EXPECT_THAT(hover_in({{"root.scene", root}, {"l.scene", "/// Units.\nscene 1\nlet unit = 1\n"}}),
              AllOf(HasSubstr("import \"l.scene\" as l"), HasSubstr("File: `l.scene`"),
                    HasSubstr("Units.")));
  EXPECT_THAT(hover_in({{"root.scene", root}}), HasSubstr("could not be read"));
  EXPECT_THAT(hover_at("import \"lib/../l.|scene\" as l\n"), HasSubstr("File: `l.scene`"));
}

TEST(Hover, ShowsColumnsAndNumberOfRowsOfADataFile) {
  EXPECT_THAT(hover_in({{"root.scene", "scene 1\nimport \"a.csv\" as a\nlet n = len(|a)\n"},
                        {"a.csv", "name,mass,\nx,1,2\ny,2,3\n"}}),
              HasSubstr("Data file: `a.csv`, 2 rows.\n\n* `name`: string\n* `mass`: number\n"
                        "* `[2]`: number"));
}

TEST(Hover, ShowsSignaturesOfFunctionsAndDefs) {
  EXPECT_THAT(hover_at("/// Twice.\nfn twice(x: number) = 2 * x\nlet a = twi|ce(4)\n"),
              AllOf(HasSubstr("```scene\nfn twice(x: number) = 2 * x\n```"), HasSubstr("Twice."),
                    HasSubstr("Value: `8`")));
  EXPECT_THAT(
      hover_at("/// A ring.\ndef ring(n: number = (1)) { sphere { radius: n } }\nri|ng {}\n"),
      AllOf(HasSubstr("```scene\ndef ring(n: number = (1))\n```"), HasSubstr("A ring.")));
  EXPECT_THAT(
      hover_at("def ring(n: number = 1) {}\nring { |n: 2 + 2 }\n"),
      AllOf(HasSubstr("n: number = 1"), HasSubstr("Parameter of `ring`"), HasSubstr("Value: `4`")));
}

TEST(Hover, ShowsTypeRangeDefaultAndValueOfAProperty) {
  EXPECT_EQ(hover_at("sphere { rad|ius: 2 * 20cm }\n"),
            "`radius` of `sphere`: a length, at least 0; required\n\n"
            "From the centre to the surface, in metres; a sphere of radius 0 is invisible.\n\n"
            "Value: `0.4m` = `40cm`");
  EXPECT_THAT(hover_at("camera { |up: (0, 1, 0) }\n"), HasSubstr("default `(0, 1, 0)`"));
  EXPECT_THAT(hover_at("render { |tone: sqrt }\n"),
              HasSubstr("`srgb`, `sqrt`, `linear` or `neutral`; default `srgb`"));
  EXPECT_THAT(hover_at("render { tone: sq|rt }\n"),
              HasSubstr("`srgb`, `sqrt`, `linear` or `neutral`; default `srgb`"));
  EXPECT_THAT(hover_at("let m = specular(red, fu|zz: 0.1)\n"), HasSubstr("`fuzz` of `specular`"));
}

TEST(Hover, SaysWhatAValueDependsOn) {
  EXPECT_THAT(hover_at("for i in range(3) { sphere { rad|ius: i } }\n"),
              HasSubstr("The value depends on `i`."));
  EXPECT_THAT(hover_at("let a| = time + 1s\nanimation { frames: 12 .. 24 }\n"),
              HasSubstr("Value: `1.5s` at `0.5s`, the time of the first frame"));
  EXPECT_THAT(hover_at("let |a = sum(range(1e9))\n"), HasSubstr("too long"));
}

TEST(Hover, ShowsUnitsOfNumbers) {
  EXPECT_EQ(hover_at("let a = 4|0deg\n"), "Value: `0.6981317007977318rad`");
  EXPECT_EQ(hover_at("let a = 20cm|\n"), "Value: `0.2m`");
  EXPECT_EQ(hover_at("let a = 1|5%\n"), "Value: `0.15`");
  EXPECT_EQ(hover_at("let a = 1_0|00\n"), "Value: `1000`");
  EXPECT_EQ(hover_at("let a = 1|5\n"), "none");
  EXPECT_THAT(hover_at("sphere { radius: 0.|5 }\n"),
              AllOf(HasSubstr("Value: `0.5m` = `50cm`"), HasSubstr("`radius`: a length")));
  EXPECT_THAT(hover_at("sphere { rad|ius: 2 * 4 }\n"), HasSubstr("Value: `8m`"));
  EXPECT_THAT(hover_at("group { sc|ale: 2 * 4 }\n"), HasSubstr("Value: `8`"));
}

TEST(Hover, ShowsColoursAsLinearAndHex) {
  EXPECT_EQ(hover_at("let a = #f|c0\n"), "Value: `linear(1, 0.603827, 0)` = `#ffcc00`");
  EXPECT_EQ(hover_at("let a = #FFCC|00\n"), "Value: `linear(1, 0.603827, 0)` = `#ffcc00`");
  EXPECT_THAT(hover_at("let a = to|mato\n"), HasSubstr("`#ff6347`"));
}

TEST(Hover, ShowsTheValueOfTheExpressionAroundAnOperator) {
  EXPECT_EQ(hover_at("let b = 3\nsphere { radius: (1 + 2) |* b }\n"), "Value: `9`");
  EXPECT_EQ(place_at("let b = 3\nsphere { radius: 1 + 2 |* b }\n"), "2 * b");
  EXPECT_EQ(hover_at("let b = (1, 2, 3)\nlet c = b.|y\n"), "Value: `2`");
  EXPECT_THAT(hover_at("let b = [4, 5]\nlet c = b|[1]\n"), HasSubstr("let b = [4, 5]"));
  EXPECT_EQ(hover_at("let b = [4, 5]\nlet c = b[1|]\n"), "Value: `5`");
}

TEST(Hover, DescribesBuiltInNames) {
  EXPECT_THAT(hover_at("let a = cla|mp(5, 0, 1)\n"),
              AllOf(HasSubstr("clamp(x, low, high)"), HasSubstr("Value: `1`")));
  EXPECT_THAT(hover_at("let a = transm|issive(ior: 1.5)\n"),
              AllOf(HasSubstr("transmissive(color: white, ior, fresnel: schlick)"),
                    HasSubstr("* `ior`: a number, greater than 0; required.")));
  EXPECT_THAT(hover_at("sph|ere {}\n"),
              AllOf(HasSubstr("sphere name { … }"), HasSubstr("Properties: `center`, `radius`")));
  EXPECT_THAT(hover_at("param a: num|ber = 1\n"), HasSubstr("with or without a unit"));
  EXPECT_THAT(hover_at("let a = ti|me\n"), HasSubstr("in seconds"));
}

TEST(Hover, DescribesLoopVariablesAndLabels) {
  EXPECT_THAT(hover_at("for i in range(3) { sphere { radius: |i } }\n"),
              AllOf(HasSubstr("for i in range(3)"), HasSubstr("Value: `[0, 1, 2]`")));
  EXPECT_THAT(hover_at("let a = [|x for i, x in [1, 2]]\n"), HasSubstr("for i, x in [1, 2]"));
  EXPECT_THAT(hover_at("let |a = [x^2 for (x, _) in [[1, 2], [3, 4]] if x > 1]\n"),
              HasSubstr("Value: `[9]`"));
  EXPECT_THAT(hover_at("/// Big.\nsphere ba|ll { radius: 1 }\n"),
              AllOf(HasSubstr("```scene\nsphere ball\n```"), HasSubstr("Big.")));
  EXPECT_THAT(hover_at("camera main {}\nrender { camera: ma|in }\n"), HasSubstr("camera main"));
}

TEST(Hover, DescribesEveryKeyword) {
  EXPECT_THAT(hover_at("l|et a = 1\n"), HasSubstr("Names a value"));
  EXPECT_THAT(hover_at("for i i|n range(3) {}\n"), HasSubstr("Precedes the list"));
  EXPECT_THAT(hover_at("let a = if true th|en 1 else 2\n"), HasSubstr("if condition then"));
  EXPECT_THAT(hover_in({{"root.scene", "sce|ne 1\n"}}), HasSubstr("version"));
  for (const lang::Keyword& keyword : lang::all_keywords()) EXPECT_FALSE(keyword.doc.empty());
}

TEST(Hover, ExplainsAllowedCodes) {
  const std::string page = hover_at("// sdlc: allow(W4|02) on purpose\nsphere {}\n");
  EXPECT_THAT(page, AllOf(HasSubstr("# W402: zero radius\n"), HasSubstr("\n```scene\nscene 1\n"),
                          HasSubstr("\n```text\nwarning[W402]"), HasSubstr("\n```\n")));
  EXPECT_EQ(hover_at("// sdlc: allow(W401, w402|)\nsphere {}\n"), page);
  EXPECT_THAT(hover_at("// sdlc: allow(W|4)\n"), HasSubstr("* W402: "));
  EXPECT_EQ(hover_at("// W40|2\n"), "none");
  EXPECT_EQ(hover_at("// sdlc: al|low(W402)\n"), "none");
}

TEST(Hover, DescribesEveryBuiltInFunctionKindAndWord) {
  for (const lang::BuiltinSymbol& builtin : lang::builtin_symbols()) {
    EXPECT_FALSE(builtin.doc.empty()) << builtin.name;
  }
  for (const lang::Builtin& builtin : lang::all_builtins()) {
    EXPECT_THAT(hover_at("let a = |" + std::string(builtin.name) + "(\n"),
                HasSubstr(std::string(builtin.doc)));
  }
}

TEST(Hover, WorksInBrokenTexts) {
  EXPECT_THAT(hover_at("let a = 2 * pi\nlet b = (|a +\nsphere { rad"), HasSubstr("6.283"));
  EXPECT_THAT(hover_at("sphere { rad|ius: \n"), HasSubstr("a length"));
  EXPECT_THAT(hover_at("sphere { rad|ius\n"), Not(HasSubstr("Value")));
  EXPECT_EQ(hover_at("|"), "none");
  EXPECT_EQ(hover_in({{"root.scene", "|"}}), "none");
  EXPECT_EQ(hover_in({{"root.scene", "\xEF\xBB\xBF|"}}), "none");
  EXPECT_THAT(hover_at("let a = pi\r\nlet b = |a\r\n"), HasSubstr("let a = pi"));
  EXPECT_THAT(hover_at("let a = \"😀\" + \"x\"\nlet b = |a\n"), HasSubstr("\"😀x\""));
}

TEST(Hover, AnswersAtEveryOffsetOfATextAndBeyond) {
  const std::string text =
      "\xEF\xBB\xBFscene 1\r\nimport \"x\" as x\nlet a = [1, (2, 3, 4).x][0] + x.y.z\r/* 😀 */ let "
      "b "
      "= \"\\u00\nsphere { radius: f(a:  #fc0 tone: } for i in range(3 { // sdlc: allow(W402";
  for (std::size_t size = 0; size <= text.size(); size += 3) {
    MarkedScene scene(text.substr(0, size));
    for (std::uint32_t offset = 0; offset <= size + 2; ++offset) {
      const auto hover = lang::hover(scene.view(), 0, offset);
      if (hover) {
        EXPECT_LE(hover->where.end, size);
      }
    }
  }
}

TEST(Hover, AsPlainTextHasNoMarks) {
  EXPECT_EQ(lang::to_plain_text("```scene\nlet a = 1\n```\n\nValue: `2`"), "let a = 1\n\nValue: 2");
}

}  // namespace
}  // namespace sdlc::test
