#include "lang/text/display_width.hpp"

#include <gtest/gtest.h>

namespace sdlc::lang {
namespace {

TEST(DisplayWidth, IsOneOfMostCharacters) {
  for (const char32_t c :
       {U' ', U'a', U'~', U'é', U'Ω', U'я', U'א', U'→', U'│', U'\u00AD', U'\u2026'}) {
    EXPECT_EQ(display_width(c), 1) << static_cast<std::uint32_t>(c);
  }
}

TEST(DisplayWidth, IsTwoOfIdeographsAndEmoji) {
  for (const char32_t c : {U'\u1100', U'日', U'ア', U'한', U'Ａ', U'　', U'😀', U'⌚', U'\U0001F9FF',
                           U'\U00020000', U'\U0003FFFD'}) {
    EXPECT_EQ(display_width(c), 2) << static_cast<std::uint32_t>(c);
  }
}

TEST(DisplayWidth, IsZeroOfMarksAndJoiners) {
  for (const char32_t c : {U'\u0301', U'\u036F', U'\u20DD', U'\u200B', U'\u200D', U'\uFE0F',
                           U'\uFEFF', U'\u1160', U'\U000E0100'}) {
    EXPECT_EQ(display_width(c), 0) << static_cast<std::uint32_t>(c);
  }
}

TEST(Printable, ReplacesWhatSteersATerminal) {
  EXPECT_EQ(printable("a\x1b[0m\r\n\tb\x7f"), "a␛[0m␍␊␉b␡");
  EXPECT_EQ(printable("\u009b\u202e\u2028\u2066\u200f"), "\uFFFD\uFFFD\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(printable("a\xffz"), "a\uFFFDz");
  EXPECT_EQ(printable("日本 é"), "日本 é");
}

TEST(Abbreviated, KeepsSixtyCharacters) {
  EXPECT_EQ(abbreviated(std::string(60, 'x')), std::string(60, 'x'));
  EXPECT_EQ(abbreviated(std::string(61, 'x')), std::string(60, 'x') + "…");
  EXPECT_EQ(abbreviated("日本"), "日本");
}

}  // namespace
}  // namespace sdlc::lang
