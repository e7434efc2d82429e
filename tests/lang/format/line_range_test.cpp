#include <string>

#include <gtest/gtest.h>

#include "tests/lang/format/scene_texts.hpp"

// Formatting some lines of a text: every other byte is unchanged.
namespace sdlc::test {
namespace {

std::string with_lines_formatted(const std::string& text, std::uint32_t first, std::uint32_t last) {
  const lang::Document file("test.scene", text);
  lang::DiagnosticSink sink;
  return lang::format_file(file, sink, lang::LineRange{first, last}).value_or("errors");
}

TEST(LineRange, TakesTheStatementsOfTheTopLevel) {
  const std::string text =
      "scene   1\n"
      "let   a=1\n"
      "let   b=2\n"
      "let   c=3 ,  // c  \n"
      "let   d=4\n";
  EXPECT_EQ(with_lines_formatted(text, 3, 4),
            "scene   1\n"
            "let   a=1\n"
            "let b = 2\n"
            "let c = 3  // c\n"
            "let   d=4\n");
  EXPECT_EQ(with_lines_formatted(text, 1, 1), "scene 1\n" + text.substr(10));
  EXPECT_EQ(with_lines_formatted(text, 6, 9), text);
}

TEST(LineRange, TakesTheStatementsInsideBlocks) {
  const std::string text =
      "scene   1\n"
      "group   g  {\n"
      "      scale:2\n"
      "      sphere   {\n"
      "            radius:1\n"
      "            center:(0,0,0)\n"
      "      }\n"
      "}\n";
  EXPECT_EQ(with_lines_formatted(text, 5, 5),
            "scene   1\n"
            "group   g  {\n"
            "      scale:2\n"
            "      sphere   {\n"
            "    radius: 1\n"
            "            center:(0,0,0)\n"
            "      }\n"
            "}\n");
  EXPECT_EQ(with_lines_formatted(text, 3, 4),
            "scene   1\n"
            "group   g  {\n"
            "  scale: 2\n"
            "  sphere {\n"
            "    radius: 1\n"
            "    center: (0, 0, 0)\n"
            "  }\n"
            "}\n");
}

TEST(LineRange, TakesTheWholeStatementOfItsFirstOrLastLine) {
  const std::string text = "scene   1\nif a {\n let x=1\n}else{\n let y=1\n}\n";
  EXPECT_EQ(with_lines_formatted(text, 4, 4),
            "scene   1\nif a {\n  let x = 1\n} else {\n  let y = 1\n}\n");
  EXPECT_EQ(with_lines_formatted(text, 5, 5),
            "scene   1\nif a {\n let x=1\n}else{\n  let y = 1\n}\n");
}

TEST(LineRange, TakesTheCommentsOfAStatement) {
  const std::string text = "scene   1 // v\n\n   // a\nlet   b=1  /* c */\n   // d\n";
  EXPECT_EQ(with_lines_formatted(text, 3, 3),
            "scene   1 // v\n\n// a\nlet b = 1 /* c */\n   // d\n");
  EXPECT_EQ(with_lines_formatted(text, 5, 5), text);
}

TEST(LineRange, LeavesACommaBehindCommentsThere) {
  EXPECT_EQ(with_lines_formatted("scene 1\nlet   a=1\n// b\n  ,\nlet   c=1\n", 2, 2),
            "scene 1\nlet a = 1\n// b\n  ,\nlet   c=1\n");
}

TEST(LineRange, KeepsACommaThatTheNextStatementNeeds) {
  EXPECT_EQ(with_lines_formatted("scene 1\nthing {\n x:1 ,\n or:2\n}\n", 3, 3),
            "scene 1\nthing {\n  x: 1,\n or:2\n}\n");
}

TEST(LineRange, TakesAllThatShareALine) {
  EXPECT_EQ(with_lines_formatted("scene 1 let a=1 let b=[\n2] let c=3\nlet d=4", 1, 1),
            "scene 1\nlet a = 1\nlet b = [\n  2,\n]\nlet c = 3\nlet d=4");
}

TEST(LineRange, KeepsTheLineEndsOfTheFile) {
  EXPECT_EQ(with_lines_formatted("scene 1\r\nlet a=1\r\n sphere{\r\nradius:1}\r\n", 3, 3),
            "scene 1\r\nlet a=1\r\nsphere {\r\n  radius: 1\r\n}\r\n");
}

}  // namespace
}  // namespace sdlc::test
