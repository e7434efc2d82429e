#include <string>

#include <gtest/gtest.h>

#include "tests/lang/token/spelled_tokens.hpp"

namespace sdlc::lang {
namespace {

std::string tokens(std::string_view text) { return test::spelled(text, SourceFormat::Scene); }

TEST(SceneToken, HasTheKindsOfTheLanguage) {
  EXPECT_EQ(tokens("let a_1 = f(x.y, [-2.5e-3m])"),
            "name:let name:a_1 mark:= name:f open:( name:x mark:. name:y mark:, open:[ mark:- "
            "number:2.5e-3m close:] close:)");
  EXPECT_EQ(tokens("a <= b != c == #ff8800 .. \"q\\\"\" ^ 2"),
            "name:a mark:<= name:b mark:!= name:c mark:== color:#ff8800 mark:.. string:\"q\\\"\" "
            "mark:^ number:2");
  EXPECT_EQ(tokens("1..2"), "number:1 mark:.. number:2");
  EXPECT_EQ(tokens("0 ...5"), "number:0 mark:.. number:.5");
}

TEST(SceneToken, TellsCommentsApart) {
  EXPECT_EQ(tokens("/// doc\n//// line\r\n// c"),
            "doc:/// doc line end:\n comment://// line "
            "line end:\r\n comment:// c");
  EXPECT_EQ(tokens("/* a /* b */ c */1"), "block:/* a /* b */ c */ number:1");
  EXPECT_EQ(tokens("1/* a /* b */ c"), "number:1 open block:/* a /* b */ c");
}

TEST(SceneToken, EndsAnUnclosedStringWithItsLine) {
  EXPECT_EQ(tokens("\"a\\\nb"), "open string:\"a\\ line end:\n name:b");
  EXPECT_EQ(tokens("\"a\r\n\"\""), "open string:\"a line end:\r\n string:\"\"");
}

TEST(SceneToken, TakesAWrongNumberAsOne) {
  for (const char* number : {"1.", "1.2.3", "0xff", "5min", "1e+", "1__0", "50%b", "1.e-3x"}) {
    EXPECT_EQ(tokens(number), std::string("number:") + number);
  }
}

TEST(SceneToken, TakesForeignLettersAsPartsOfNames) {
  EXPECT_EQ(tokens("gr\u00F6\u00DFe: \u03B1\u03B2"),
            "foreign:gr\u00F6\u00DFe mark:: foreign:\u03B1\u03B2");
  EXPECT_EQ(tokens("2\u00D73"), "number:2 unknown:\u00D7 number:3");
}

TEST(SceneToken, TakesWhatTheLanguageHasNotByCharacterAndBytesByRun) {
  EXPECT_EQ(tokens("a ! ;; #"), "name:a unknown:! unknown:; unknown:; unknown:#");
  EXPECT_EQ(tokens("\u201Ca\u201D"), "unknown:\u201C name:a unknown:\u201D");
  EXPECT_EQ(tokens("a\x01\xFF\xFE z"), "name:a unknown:\x01\xFF\xFE name:z");
}

TEST(SceneToken, CountsNestedCommentsWithoutStack) {
  std::string text;
  for (int i = 0; i < 1'000'000; ++i) text += "/*";
  EXPECT_EQ(test::tokenize(text).size(), 1u);
}

}  // namespace
}  // namespace sdlc::lang
