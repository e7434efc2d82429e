#include "lang/format/format.hpp"

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "lang/syntax/syntax.hpp"
#include "tests/lang/format/scene_texts.hpp"

namespace sdlc::test {
namespace {

class ParsedText {
 public:
  explicit ParsedText(std::string text)
      : file_("test.scene", std::move(text)), tree_(lang::parse(file_, sink_)) {
    EXPECT_FALSE(sink_.has_errors()) << file_.text();
  }
  const lang::SyntaxTree& tree() const { return tree_; }

 private:
  lang::SourceFile file_;
  lang::DiagnosticSink sink_;
  lang::SyntaxTree tree_;
};

bool say_the_same(const std::string& a, const std::string& b) {
  const ParsedText parsed_a(a), parsed_b(b);
  return lang::is_same_program(parsed_a.tree(), parsed_b.tree());
}

TEST(Format, OfTheExamplesIsTheirs) {
  for (const auto& [name, text] : scenes_in({"examples", "examples/library"})) {
    EXPECT_EQ(formatted(text), text) << name << ": `sdlc fmt` brings it in order";
  }
}

TEST(Format, LeavesWhatItMadeAsItIs) {
  for (const auto& [name, text] : sound_scenes()) {
    const std::string once = formatted(text);
    EXPECT_EQ(formatted(once), once) << name;
  }
}

TEST(Format, EndsWithOneLineEndAndNoBlanks) {
  for (const auto& [name, text] : sound_scenes()) {
    const std::string outcome = formatted(text);
    EXPECT_TRUE(outcome.ends_with('\n') && !outcome.ends_with("\n\n")) << name;
    for (const char* blank : {" \n", "\t", "\r", "\n\n\n"}) {
      EXPECT_EQ(outcome.find(blank), std::string::npos) << name;
    }
  }
}

TEST(Format, TakesTheEndOfTheTextForALineEnd) {
  const std::string sum = "first_summand_of_several + second_summand_of_several + third_of_them";
  for (const std::string end : {"", ",", "\n", ",\n"}) {
    const std::string once =
        formatted("scene 1\nlet several = " + sum + end + " /* not the widest */");
    EXPECT_EQ(formatted(once), once);
  }
}

TEST(Format, MakesNothingOfATextWithErrors) {
  const lang::Document file("test.scene", "scene 1\nlet a = \nsphere {radius:1}\n");
  lang::DiagnosticSink sink;
  EXPECT_EQ(lang::format_file(file, sink), std::nullopt);
  EXPECT_EQ(sink.error_count(), 1u);
}

TEST(Format, TakesAsManyTermsAsThereAre) {
  std::string text = "scene 1\nlet sum = 0";
  for (int i = 0; i < 1'000'000; ++i) text += i % 2 == 0 ? "+x*2" : " - y";
  const std::string outcome = formatted(text);
  EXPECT_TRUE(outcome.starts_with("scene 1\nlet sum =\n  0\n  + x * 2\n  - y\n"));
}

TEST(Format, TakesAsManyElementsAsThereAre) {
  std::string text = "scene 1\nlet list = [";
  for (int i = 0; i < 300'000; ++i) text += "1,(2,3,4),";
  const std::string outcome = formatted(text + "]");
  EXPECT_TRUE(outcome.starts_with("scene 1\nlet list = [\n  1, (2, 3, 4), 1, "));
  EXPECT_TRUE(outcome.ends_with(", (2, 3, 4),\n]\n"));
}

std::string nested(int depth, std::string_view open, std::string_view inside,
                   std::string_view close) {
  std::string text;
  for (int i = 0; i < depth; ++i) text += open;
  text += inside;
  for (int i = 0; i < depth; ++i) text += close;
  return text;
}

TEST(Format, GoesAsDeepAsTheLanguage) {
  for (const std::string& text :
       {nested(127, "group {", "", "}"), "let a = " + nested(127, "(1+", "2", ")"),
        "let a = " + nested(63, "f(2,[", "3", "])"), "let a = " + nested(127, "-", "2", ""),
        "let a = " + nested(63, "if b then (", "2", ") else c"),
        "let a = " + nested(42, "x*(f([", "3", "]))+y")}) {
    const std::string once = formatted("scene 1\n" + text);
    EXPECT_EQ(formatted(once), once);
  }
}

TEST(SameProgram, KnowsWhatALayoutMayChange) {
  const std::string text = "scene 1\nthing a { x: .5, y: f(1, 2) } // c\n";
  EXPECT_TRUE(say_the_same(text, "scene 1\nthing a {\n  x: 0.5\n  y: f(1, 2,)\n}  // c  \n"));
  EXPECT_TRUE(say_the_same("scene 1 let a = 1, // b\nlet c = 2 + // d\n3",
                           "scene 1 let a = 1 // b\nlet c = 2 // d\n+ 3"));
}

TEST(SameProgram, KnowsWhatALayoutMayNotChange) {
  const std::string text = "scene 1\nlet a = [x, -1] // b\nlet c = \"d\" // e\n";
  for (const char* other : {"scene 1\nlet a = [x -1] // b\nlet c = \"d\" // e\n",
                            "scene 1\nlet a = [x, -1] // b\nlet c = \"d \" // e\n",
                            "scene 1\nlet a = [x, -1]\nlet c = \"d\" // b\n// e\n",
                            "scene 1\nlet a = [x, -1] // b\nlet c = \"d\"\n",
                            "scene 1\nlet a = [x, -1.0] // b\nlet c = \"d\" // e\n",
                            "scene 1\nlet c = \"d\" // b\nlet a = [x, -1] // e\n",
                            "scene 1\nlet a = [x, -1] // b\nlet c = \"d\" // e\nlet f = 1\n"}) {
    EXPECT_FALSE(say_the_same(text, other)) << other;
  }
  EXPECT_FALSE(say_the_same("scene 1 let a = 1 + 2 - 3", "scene 1 let a = 1 - 2 + 3"));
}

}  // namespace
}  // namespace sdlc::test
