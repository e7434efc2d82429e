#include "lang/editor/symbols.hpp"

#include <string>
#include <string_view>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::test {
namespace {

using namespace lang;

std::string described(std::string_view text, const std::vector<DocumentSymbol>& symbols) {
  std::string all;
  for (const DocumentSymbol& symbol : symbols) {
    all += fmt::format("{}{}", std::string(2 * symbol.depth, ' '), symbol.name);
    if (!symbol.detail.empty()) all += fmt::format(" | {}", symbol.detail);
    all += '\n';
    EXPECT_LE(symbol.whole.begin, symbol.where.begin);
    EXPECT_GE(symbol.whole.end, symbol.where.end);
    EXPECT_LE(symbol.whole.end, text.size());
  }
  return all;
}

std::string outline(std::string_view text, std::size_t max_count = kMaxDocumentSymbols) {
  const SourceFile file("test.scene", std::string(text));
  DiagnosticSink ignored;
  const SyntaxTree tree = parse(file, ignored);
  return described(text, document_symbols(tree, max_count));
}

std::string outline_of_config(std::string_view text, std::size_t max_count = kMaxDocumentSymbols) {
  return described(text, config_symbols(text, max_count));
}

TEST(DocumentSymbols, ShowNamesValuesAndKinds) {
  EXPECT_EQ(outline(R"(scene 1
import "lib.scene" as lib
param count: number = 3
let wide = 2 *
           pi
fn half(of, by = (1)) = of / by
def ring(n: number) {
  let step = 1turn / n
  for i in range(n) { sphere { radius: 1 } }
}
group moved {
  lib . pair second { gap: 1 }
  lib /* of glass */ . pair { gap: 1 }
}
)"),
            R"(lib | "lib.scene"
count | : number = 3
wide | = 2 * pi
half | (of, by = (1)
ring | (n: number)
  step | = 1turn / n
  sphere
moved | group
  second | lib . pair
  lib /* of glass */ . pair
)");
}

TEST(DocumentSymbols, HaveNoEmptyNames) {
  EXPECT_EQ(outline("scene 1\nimport \"lib.scene\"\nlet\nfn (a) = a\ndef\nsphere {"), "sphere\n");
  EXPECT_EQ(outline(""), "");
  EXPECT_EQ(outline("\xEF\xBB\xBFscene 1\r\nlet a = 1\r\n"), "a | = 1\n");
  EXPECT_EQ(outline("import \"lib.scene\" as"), "");
}

TEST(DocumentSymbols, CutLongText) {
  EXPECT_EQ(outline("scene 1\nlet a = \"" + std::string(60, '.') + "\"\n"),
            "a | = \"" + std::string(57, '.') + "…\n");
  const std::string astral = "\U0001F308";
  EXPECT_EQ(excerpt_of(std::string(59, 'a') + astral + "b"), std::string(59, 'a') + astral + "…");
}

TEST(DocumentSymbols, OmitNamelessObjectsOfTooManyFirst) {
  const std::string text =
      "scene 1\nsphere { }\ngroup { sphere ball { } sphere { } }\nsphere { }\nlet a = 1\n";
  EXPECT_EQ(outline(text, 6), "sphere\ngroup\n  ball | sphere\n  sphere\nsphere\na | = 1\n");
  EXPECT_EQ(outline(text, 5), "group\n  ball | sphere\na | = 1\n");
  EXPECT_EQ(outline(text, 2), "group\n  ball | sphere\n");
}

TEST(ConfigSymbols, AreMembersAndElements) {
  EXPECT_EQ(outline_of_config(R"({
  "camera": { "look_from": [0, 0, 5], "vfov": 40, "deep": { "deeper": { "x": 1 } } },
  "background": null,
  "saving": {},
  "spheres": [
    { "radius": 1, "name": "a } \" {" },
    { "radius": 2, "material": { "type": "diffuse" } }
  ]
})"),
            R"(camera
  look_from | [0, 0, 5]
  vfov | 40
  deep
    deeper | { "x": 1 }
background | null
saving | {}
spheres
  [0]
    radius | 1
    name | "a } \" {"
  [1]
    radius | 2
    material | { "type": "diffuse" }
)");
}

TEST(ConfigSymbols, SurviveBrokenTexts) {
  EXPECT_EQ(outline_of_config(""), "");
  EXPECT_EQ(outline_of_config("{"), "");
  EXPECT_EQ(outline_of_config("{\"a"), "");
  EXPECT_EQ(outline_of_config("{\"a\":"), "");
  EXPECT_EQ(outline_of_config("{\"a\": }"), "");
  EXPECT_EQ(outline_of_config("{\"\": 1, \"a\": 1}"), "a | 1\n");
  EXPECT_EQ(outline_of_config("{\"a\": [1, 2"), "a | [1, 2\n");
  EXPECT_EQ(outline_of_config("{\"a\" 1, b: 'x', \"c\": {\"d\": 1}"), "b | 'x'\nc\n  d | 1\n");
  EXPECT_EQ(outline_of_config("[{\"a\": 1}]"), "[0]\n  a | 1\n");
}

TEST(ConfigSymbols, SkipTheRestOfALongList) {
  std::string text = "{\"spheres\": [";
  for (int i = 0; i < 3000; ++i) text += "{\"radius\": 1, \"s\": \"]\"},";
  text += "{}], \"last\": 1}";
  const auto symbols = config_symbols(text);
  EXPECT_EQ(symbols.size(), 1 + 1000 * 3 + 1);
  EXPECT_EQ(symbols.back().name, "last");
  EXPECT_EQ(text.substr(symbols[0].whole.end), ", \"last\": 1}");
  EXPECT_EQ(config_symbols(text, 10).size(), 10u);
}

}  // namespace
}  // namespace sdlc::test
