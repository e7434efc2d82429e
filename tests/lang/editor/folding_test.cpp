#include "lang/editor/folding.hpp"

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::test {
namespace {

using namespace lang;
using testing::ElementsAre;
using testing::IsEmpty;

/// "2-4", with the kind after it if it has no brackets; lines count from 1.
std::vector<std::string> folds(const std::string& name, std::string_view text,
                               std::size_t max_count = 1000) {
  const SourceFile file(name, std::string(text));
  DiagnosticSink ignored;
  const bool is_scene = file.format() == SourceFormat::Scene;
  const SyntaxTree tree = parse(file, ignored);
  std::vector<std::string> found;
  for (const FoldingRange& range : folding_ranges(file, is_scene ? &tree : nullptr, max_count)) {
    const char* kind = range.kind == FoldingKind::Comment   ? " comment"
                       : range.kind == FoldingKind::Imports ? " imports"
                                                            : "";
    found.push_back(fmt::format("{}-{}{}", file.position(range.hidden.begin).line,
                                file.position(range.hidden.end).line, kind));
  }
  return found;
}

std::vector<std::string> folds(std::string_view text) { return folds("a.scene", text); }

TEST(FoldingRanges, AreBlocksAndLists) {
  EXPECT_THAT(folds(R"(scene 1
def ring(n) {
  if n > 1 {
    sphere { radius: 1 }
  } else {
    sphere { radius: f(
      1) }
  }
}
let list = [
  1
]
)"),
              ElementsAre("2-9", "3-5", "5-8", "6-7", "6-7", "10-12"));
}

TEST(FoldingRanges, AreCommentsAndImports) {
  EXPECT_THAT(
      folds(R"(// one
// two
// three
scene 1
import "a.scene" as a
// between
import "b.scene" as b
include "c.scene"
/* long
*/ let x = 1 // no
// lone

// x
// y
/// Doc.
/// More.
let y = 1 /* { */ // z
)"),
      ElementsAre("1-3 comment", "5-8 imports", "9-10 comment", "13-14 comment", "15-16 comment"));
}

TEST(FoldingRanges, SurviveBrokenBrackets) {
  EXPECT_THAT(folds("scene 1\ngroup {\n  sphere {\n    radius: (1\n  }\n]\n"), ElementsAre("3-5"));
  EXPECT_THAT(folds("}\n)\n{\n"), IsEmpty());
  EXPECT_THAT(folds(""), IsEmpty());
  EXPECT_THAT(folds("scene 1\r\ngroup {\r\n}\r\n"), ElementsAre("2-3"));
  EXPECT_THAT(folds("scene 1\nlet a = \"{\n\"\n}\n/* {\n"), IsEmpty());
}

TEST(FoldingRanges, AreThoseOfConfigs) {
  EXPECT_THAT(folds("a.json", "{\n  \"a\": [\n    1\n  ],\n  \"b\": {}\n}\n"),
              ElementsAre("1-6", "2-4"));
}

TEST(FoldingRanges, KeepTheLargest) {
  EXPECT_THAT(folds("a.json", "{\n  \"a\": [\n    1\n  ],\n  \"b\": [\n\n11111111]\n}\n", 2),
              ElementsAre("1-8", "5-7"));
}

}  // namespace
}  // namespace sdlc::test
