#include "lang/syntax/broken_parts.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

// A repair reads only the statements around a mistake.
namespace sdlc::lang {
namespace {

/// `let a0 = 0` and so on to a9, a line each; some lines are replaced.
struct Lines {
  Lines() {
    for (int i = 0; i < 10; ++i) lines.push_back("let a" + std::to_string(i) + " = 0");
  }
  std::string text() const {
    std::string text = "scene 1\n";
    for (const std::string& line : lines) text += line + '\n';
    return text;
  }
  std::vector<std::string> lines;
};

/// The tree that is given is that of the repaired text: errors that a repair removes are reported
/// with their places all the same.
std::vector<std::string> parts_of(const std::string& text) {
  const SourceFile file("test.scene", text);
  DiagnosticSink sink;
  const SyntaxTree tree = parse(file, sink);
  std::vector<std::string> parts;
  for (const Span part : broken_parts(text, tree.nodes(), sink)) {
    parts.emplace_back(file.text(part));
  }
  return parts;
}

TEST(BrokenParts, AreAStatementAndItsNeighbours) {
  Lines text;
  text.lines[5] = "let a5 = (1 2, 3)";
  EXPECT_EQ(parts_of(text.text()),
            std::vector<std::string>{"let a4 = 0\nlet a5 = (1 2, 3)\nlet a6 = 0\n"});
}

TEST(BrokenParts, AreOneForMistakesSideBySide) {
  Lines text;
  text.lines[4] = "let a4 = (1 2, 3)";
  text.lines[6] = "let a6 = (1 2, 3)";
  EXPECT_EQ(parts_of(text.text()),
            std::vector<std::string>{"let a3 = 0\nlet a4 = (1 2, 3)\nlet a5 = 0\n"
                                     "let a6 = (1 2, 3)\nlet a7 = 0\n"});
}

TEST(BrokenParts, AreSeveralForMistakesApart) {
  Lines text;
  text.lines[1] = "let a1 = (1 2, 3)";
  text.lines[8] = "let a8 = (1 2, 3)";
  EXPECT_EQ(parts_of(text.text()),
            (std::vector<std::string>{"let a0 = 0\nlet a1 = (1 2, 3)\nlet a2 = 0\n",
                                      "let a7 = 0\nlet a8 = (1 2, 3)\nlet a9 = 0\n"}));
}

TEST(BrokenParts, HaveWholeLines) {
  Lines text;
  text.lines[4] = "let a4 = 0, let b = 1";
  text.lines[5] = "let a5 = (1 2, 3)";
  text.lines[6] = "let a6 = 0, let c = 1";
  EXPECT_EQ(parts_of(text.text()),
            std::vector<std::string>{"let a4 = 0, let b = 1\nlet a5 = (1 2, 3)\n"
                                     "let a6 = 0, let c = 1\n"});
}

TEST(BrokenParts, AreOneToTheBracketThatClosesABlockThatIsNotOpened) {
  const std::string text =
      "scene 1\nlet a = 1\nlet b = 2\ngroup g\n  let c = 3\n  let d = 4\n  let e = 5\n"
      "  let f = 6\n}\nlet h = 7\nlet i = 8\n";
  const std::vector<std::string> parts = parts_of(text);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_NE(parts[0].find("group g"), std::string::npos);
  EXPECT_NE(parts[0].find('}'), std::string::npos);
  EXPECT_EQ(parts[0].find("let a"), std::string::npos);
}

TEST(BrokenParts, AreTheWholeTextIfItsHeaderIsWrong) {
  Lines text;
  const std::string broken = "scen 1\n" + text.text().substr(8);
  EXPECT_EQ(parts_of(broken), std::vector<std::string>{broken});
}

TEST(BrokenParts, OfALongTextAreRepairedAsThoseOfAShortOne) {
  const std::string broken = "sphere { center: (0 0, 0) radius 1 }\n";
  std::string lines;
  for (int i = 0; i < 500; ++i) lines += "sphere { center: (0, 0, 0), radius: 1 }\n";
  std::vector<std::string> messages[2];
  for (const bool is_long : {false, true}) {
    const SourceFile file("test.scene", "scene 1\n" + (is_long ? lines + broken + lines : broken));
    DiagnosticSink sink;
    parse(file, sink);
    for (const Diagnostic& diagnostic : sink.diagnostics()) {
      messages[is_long ? 1 : 0].push_back(diagnostic.message);
    }
  }
  EXPECT_EQ(messages[0], messages[1]);
  EXPECT_EQ(messages[0].size(), 2U);
}

}  // namespace
}  // namespace sdlc::lang
