#include "lang/editor/formatting.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "lang/format/format.hpp"

namespace sdlc::test {
namespace {

/// The text with a mark `|` for the caret.
struct Marked {
  explicit Marked(std::string text) {
    const std::size_t at = text.find('|');
    caret = static_cast<std::uint32_t>(at);
    text.erase(at, 1);
    document.emplace("scenes/ball.scene", std::move(text));
  }

  std::uint32_t caret = 0;
  std::optional<lang::Document> document;
};

std::string formatted(const std::string& text) {
  const lang::Document document("ball.scene", text);
  const lang::Formatting result = lang::format_text(document);
  EXPECT_EQ(result.refusal, "");
  return lang::with_edits(text, result.edits);
}

/// The text after `typed` was typed before the mark, with the caret where it is then.
std::string typed(std::string_view typed_text, const std::string& text) {
  const Marked marked(text);
  const lang::Formatting result = lang::format_on_type(*marked.document, marked.caret, typed_text);
  EXPECT_EQ(result.refusal, "");
  std::uint32_t caret = marked.caret;
  for (const lang::TextEdit& edit : result.edits) {
    EXPECT_LE(edit.where.end, marked.caret);
    caret += static_cast<std::uint32_t>(edit.text.size()) - edit.where.size();
  }
  return lang::with_edits(marked.document->text(), result.edits).insert(caret, "|");
}

TEST(Formatting, OfTheWholeText) {
  EXPECT_EQ(formatted("scene 1\nlet  a=1\n"), "scene 1\nlet a = 1\n");
}

TEST(Formatting, KeepsTheLineEndsAndTheByteOrderMarkOfTheEditor) {
  EXPECT_EQ(formatted("scene 1\r\nsphere {\r\nradius:1 }\r\n"),
            "scene 1\r\nsphere {\r\n  radius: 1\r\n}\r\n");
  EXPECT_EQ(formatted("\xEF\xBB\xBFscene 1\nlet a=1\n"), "\xEF\xBB\xBFscene 1\nlet a = 1\n");
}

TEST(Formatting, OfAFormattedTextIsEmpty) {
  for (const auto& entry : std::filesystem::directory_iterator(SDLC_SOURCE_DIR "/examples")) {
    if (entry.path().extension() != ".scene") continue;
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const lang::Document document(entry.path().string(), text);
    EXPECT_TRUE(lang::format_text(document).edits.empty()) << entry.path();
  }
}

TEST(Formatting, IsRefusedWithThePlaceOfTheFirstSyntaxError) {
  const lang::Document document("scenes/ball.scene", "scene 1\nlet  a = \nlet b = (\n");
  const lang::Formatting result = lang::format_text(document);
  EXPECT_TRUE(result.edits.empty());
  EXPECT_TRUE(result.refusal.starts_with(
      "`ball.scene` was not formatted because of an error in line 2, column "))
      << result.refusal;
  EXPECT_EQ(document.position(result.cause.begin).line, 2u);
  EXPECT_TRUE(lang::format_range(document, {0, 7}).is_refused());
}

TEST(Formatting, OfAConfigIsRefused) {
  const lang::Document document("old.json", "{}");
  EXPECT_EQ(lang::format_text(document).refusal,
            "`old.json` was not formatted: it is a JSON config, and only scenes have a canonical "
            "layout");
}

TEST(Formatting, OfARangeTouchesOnlyItsLines) {
  const std::string text = "scene 1\nlet  a=1\nlet  b=2\nlet  c=3\n";
  const lang::Document document("ball.scene", text);
  const auto begin = static_cast<std::uint32_t>(text.find("let  b"));
  const auto end = static_cast<std::uint32_t>(text.find("let  c"));
  EXPECT_EQ(lang::with_edits(text, lang::format_range(document, {begin, end}).edits),
            "scene 1\nlet  a=1\nlet b = 2\nlet  c=3\n");
  EXPECT_TRUE(lang::format_range(document, {0, 1'000'000}).edits.size() > 2);
}

TEST(Formatting, AfterABraceIsOfTheStatementThatItCloses) {
  EXPECT_EQ(typed("}", "scene 1\nlet  a=1\nsphere {radius:1,center:(0,0,0)}|\nlet  b=1\n"),
            "scene 1\nlet  a=1\nsphere { radius: 1, center: (0, 0, 0) }|\nlet  b=1\n");
  EXPECT_EQ(typed("}", "scene 1\ngroup {\nsphere {\nradius:1\n      }|\nlet  b=1\n}\n"),
            "scene 1\ngroup {\n  sphere {\n    radius: 1\n  }|\nlet  b=1\n}\n");
}

TEST(Formatting, AfterABraceKeepsTheTextAfterIt) {
  EXPECT_EQ(typed("}", "scene 1\nsphere {radius:1}|    // here\n"),
            "scene 1\nsphere { radius: 1 }|    // here\n");
  EXPECT_EQ(typed("}", "scene 1\nsphere {radius:1}|  sphere {radius:2}\n"),
            "scene 1\nsphere { radius: 1 }|  sphere {radius:2}\n");
}

TEST(Formatting, AfterABraceOfABranchKeepsTheOtherBranch) {
  EXPECT_EQ(typed("}", "scene 1\nif true {\nsphere {radius:1}\n}|\nelse { sphere {radius:2} }\n"),
            "scene 1\nif true {\nsphere {radius:1}\n}|\nelse { sphere {radius:2} }\n");
}

TEST(Formatting, AfterABraceInAStringOrCommentIsNone) {
  EXPECT_EQ(typed("}", "scene 1\nlet  a=\"}|\"\n"), "scene 1\nlet  a=\"}|\"\n");
  EXPECT_EQ(typed("}", "scene 1\nlet  a=1 // }|\n"), "scene 1\nlet  a=1 // }|\n");
}

TEST(Formatting, AfterALineEndIsOfTheStatementBeforeIt) {
  EXPECT_EQ(typed("\n", "scene 1\nlet  z=1\nlet  a=1  \n|\nlet  b=1\n"),
            "scene 1\nlet  z=1\nlet a = 1\n|\nlet  b=1\n");
  EXPECT_EQ(typed("\n", "scene 1\r\nlet  a=1  \r\n|\r\nlet  b=1\r\n"),
            "scene 1\r\nlet a = 1\r\n|\r\nlet  b=1\r\n");
  EXPECT_EQ(typed("\n", "scene 1\nlet  a=[1,\n 2]\n|\n"), "scene 1\nlet a = [1, 2]\n|\n");
}

TEST(Formatting, AfterALineEndWithinAStatementIsNone) {
  for (const char* text :
       {"scene 1\nsphere {\n  |\n}\n", "scene 1\nsphere { radius: 1,\n|center: (0, 0, 0) }\n",
        "scene 1\nsphere { center: (0,\n|0, 0) }\n", "scene 1\nlet a =\n|  1\n",
        "scene 1\nlet a = 1 +\n  |2\n", "scene 1\nsphere { radius: 1\n| }\n", "scene 1\n\n\n|\n",
        "scene 1\n|", "\n|scene 1\n", "scene 1\nsphere {radius:1}\n|\n"}) {
    EXPECT_EQ(typed("\n", text), text);
  }
}

TEST(Formatting, AfterALineEndOfAPropertyIsOfThatProperty) {
  EXPECT_EQ(typed("\n", "scene 1\nsphere {\n  radius:1\n  |\n  center:(0,0,0)\n}\n"),
            "scene 1\nsphere {\n  radius: 1\n  |\n  center:(0,0,0)\n}\n");
}

TEST(Formatting, WhileTypingIsRefusedForBrokenTexts) {
  const Marked marked("scene 1\nlet  a=1\n|\nlet b =\n");
  const lang::Formatting result = lang::format_on_type(*marked.document, marked.caret, "\n");
  EXPECT_TRUE(result.is_refused());
  EXPECT_TRUE(result.edits.empty());
}

TEST(Formatting, AcceptsEmptyTextsAndCaretsBeyondTheEnd) {
  const lang::Document empty("a.scene", ""), short_text("a.scene", "scene 1\nlet  a=1\n");
  EXPECT_TRUE(lang::format_text(empty).is_refused());
  EXPECT_TRUE(lang::format_on_type(empty, 5, "}").is_refused());
  EXPECT_EQ(lang::format_on_type(short_text, 1000, "\n").edits.size(), 3u);
  EXPECT_TRUE(lang::format_on_type(short_text, 0, "}").edits.empty());
}

/// Wherever the caret is: the text stays the same program, and nothing after the caret changes.
TEST(Formatting, WhileTypingNeverChangesTheProgram) {
  const std::string text =
      "scene 1\ngroup{sphere{radius:1 // c\n,center:(0,0,0)}}\nlet  a=[1,\n2,3 ] let b=1\n"
      "if a[0]>1{sphere{radius:.5}}else{ group{}\n}\nfn f( x )=x+ // d\n1\n";
  const lang::Document document("a.scene", text);
  for (std::uint32_t at = 1; at <= text.size(); ++at) {
    if (text[at - 1] != '}' && text[at - 1] != '\n') continue;
    const lang::Formatting result =
        lang::format_on_type(document, at, std::string_view(text).substr(at - 1, 1));
    const lang::Document edited("a.scene", lang::with_edits(text, result.edits));
    lang::DiagnosticSink sink;
    EXPECT_TRUE(lang::is_same_program(document.tree(sink), edited.tree(sink))) << edited.text();
    EXPECT_FALSE(sink.has_errors());
    EXPECT_TRUE(edited.text().ends_with(text.substr(at))) << edited.text();
  }
}

}  // namespace
}  // namespace sdlc::test
