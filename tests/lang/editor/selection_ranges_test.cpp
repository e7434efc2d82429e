#include "lang/editor/selection_ranges.hpp"

#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::test {
namespace {

using namespace lang;
using testing::ElementsAre;

/// The texts selected at `|`, without the whole file, which is the last.
std::vector<std::string> selected(const std::string& name, std::string text) {
  const std::size_t cursor = text.find('|');
  text.erase(cursor, 1);
  const SourceFile file(name, text);
  DiagnosticSink ignored;
  const bool is_scene = file.format() == SourceFormat::Scene;
  const SyntaxTree tree = parse(file, ignored);
  const auto offset = static_cast<std::uint32_t>(cursor);
  const auto chain =
      selection_ranges(file, is_scene ? &tree : nullptr, std::span(&offset, 1)).front();
  std::vector<std::string> texts;
  for (const Span span : chain) texts.emplace_back(file.text(span));
  if (texts.empty() || texts.back() != text) ADD_FAILURE() << "the file is not selected";
  if (!texts.empty()) texts.pop_back();
  return texts;
}

std::vector<std::string> selected(const std::string& text) { return selected("a.scene", text); }

TEST(SelectionRanges, GrowFromTheWordOverBracketsToTheStatement) {
  EXPECT_THAT(
      selected("scene 1\nlet a = f( one + t|wo * 2, 3 )\n"),
      ElementsAre("two", "two * 2", "one + two * 2", "one + two * 2, 3", "( one + two * 2, 3 )",
                  "f( one + two * 2, 3 )", "let a = f( one + two * 2, 3 )"));
}

TEST(SelectionRanges, KnowPathsLabelsAndBlocks) {
  EXPECT_THAT(selected("scene 1\nlib.p|air big { n: 1, m: 2 }\n"),
              ElementsAre("pair", "lib.pair", "lib.pair big { n: 1, m: 2 }"));
  EXPECT_THAT(
      selected("scene 1\nlib.pair big { n|: 1, m: 2 }\n"),
      ElementsAre("n", "n: 1", "n: 1, m: 2", "{ n: 1, m: 2 }", "lib.pair big { n: 1, m: 2 }"));
}

TEST(SelectionRanges, SelectTheInsideOfStringsAndWordsOfComments) {
  EXPECT_THAT(selected("scene 1\nlet a = \"x| y\"\n"),
              ElementsAre("x y", "\"x y\"", "let a = \"x y\""));
  EXPECT_THAT(selected("scene 1\n// one tw|o.\nlet a = 1\n"), ElementsAre("two.", "// one two."));
}

TEST(SelectionRanges, WorkInBrokenTextsAndConfigs) {
  EXPECT_THAT(selected("scene 1\ngroup { sphere { radius: (a|b + "),
              ElementsAre("ab", "ab +", "(ab +", "radius: (ab +", "sphere { radius: (ab +",
                          "group { sphere { radius: (ab +"));
  EXPECT_THAT(
      selected("a.json", "{\"a\": [1, {\"b\": tr|ue} ]}\n"),
      ElementsAre("true", "\"b\": true", "{\"b\": true}", "1, {\"b\": true}", "[1, {\"b\": true} ]",
                  "\"a\": [1, {\"b\": true} ]", "{\"a\": [1, {\"b\": true} ]}"));
}

TEST(SelectionRanges, AreGivenForEachCursor) {
  const SourceFile file("a.scene", "scene 1\nlet a = 1\n");
  DiagnosticSink ignored;
  const SyntaxTree tree = parse(file, ignored);
  const std::vector<std::uint32_t> offsets{12, 99, 0};
  const auto ranges = selection_ranges(file, &tree, offsets);
  ASSERT_EQ(ranges.size(), 3u);
  EXPECT_EQ(file.text(ranges[0].front()), "a");
  EXPECT_EQ(file.text(ranges[1].front()), file.text());
  EXPECT_EQ(file.text(ranges[2].front()), "scene");
  EXPECT_TRUE(selection_ranges(file, &tree, {}).empty());
}

}  // namespace
}  // namespace sdlc::test
