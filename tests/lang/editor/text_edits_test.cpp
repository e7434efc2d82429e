#include "lang/editor/text_edits.hpp"

#include <cstddef>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace sdlc::test {
namespace {

using Edits = std::vector<lang::TextEdit>;

/// The edits, which are applied and checked: ascending, disjoint, and not inside a character.
Edits edits_between(std::string_view from, std::string_view to) {
  Edits edits = lang::text_edits(from, to);
  EXPECT_EQ(lang::with_edits(from, edits), to);
  std::uint32_t end = 0;
  for (const lang::TextEdit& edit : edits) {
    EXPECT_GE(edit.where.begin, end);
    EXPECT_GE(edit.where.end, edit.where.begin);
    end = edit.where.end;
    for (const std::uint32_t at : {edit.where.begin, edit.where.end}) {
      if (at == 0 || at >= from.size()) continue;
      EXPECT_FALSE(from[at - 1] == '\r' && from[at] == '\n') << at;
      EXPECT_NE(static_cast<unsigned char>(from[at]) & 0xC0, 0x80) << at;
    }
  }
  return edits;
}

TEST(TextEdits, AreNoneForEqualTexts) {
  EXPECT_TRUE(edits_between("", "").empty());
  EXPECT_TRUE(edits_between("a\nb\n", "a\nb\n").empty());
}

TEST(TextEdits, ReplaceOnlyTheChangedPartOfALine) {
  EXPECT_EQ(edits_between("a\nlet  b=1\nc\n", "a\nlet b=1\nc\n"), (Edits{{{6, 7}, ""}}));
}

TEST(TextEdits, ChangeEachLineSeparately) {
  EXPECT_EQ(edits_between("x{\na\nb\n}\n", "x{\n  a\n  b\n}\n"),
            (Edits{{{3, 3}, "  "}, {{5, 5}, "  "}}));
}

TEST(TextEdits, ChangeSpacesOneByOne) {
  EXPECT_EQ(edits_between("a {b:1}\n", "a { b: 1 }\n"),
            (Edits{{{3, 3}, " "}, {{5, 5}, " "}, {{6, 6}, " "}}));
  EXPECT_EQ(edits_between("a {\nb }\n", "a {\n  b\n}\n"), (Edits{{{4, 4}, "  "}, {{5, 6}, "\n"}}));
}

TEST(TextEdits, DoNotTouchLinesThatMove) {
  EXPECT_EQ(edits_between("one\ntwo\nthree\n", "zero\none\ntwo\nthree\n"),
            (Edits{{{0, 0}, "zero\n"}}));
}

TEST(TextEdits, KeepTheLineEndsOfUnchangedLines) {
  EXPECT_EQ(edits_between("a\r\n  b\r\nc\r\n", "a\r\nb\r\nc\r\n"), (Edits{{{3, 5}, ""}}));
}

TEST(TextEdits, ReplaceWholeLineEnds) {
  EXPECT_EQ(edits_between("a\r\nb\r\n", "a\nb\n"), (Edits{{{1, 3}, "\n"}, {{4, 6}, "\n"}}));
  EXPECT_EQ(edits_between("a\nb\n", "a\r\nb\r\n"), (Edits{{{1, 2}, "\r\n"}, {{3, 4}, "\r\n"}}));
  edits_between("a\r\n", "a\r");
  edits_between("a\r", "a\r\n");
  edits_between("a\r\r\n", "a\r\n");
}

TEST(TextEdits, DoNotSplitCharacters) {
  // The two characters have three equal bytes at the beginning, and the next two at the end.
  EXPECT_EQ(edits_between("\U0001F600", "\U0001F601"), (Edits{{{0, 4}, "\U0001F601"}}));
  EXPECT_EQ(edits_between("aéb", "aĩb"), (Edits{{{1, 3}, "ĩ"}}));
}

TEST(TextEdits, ReachTheEndsOfTexts) {
  edits_between("", "a");
  edits_between("a", "");
  edits_between("a", "a\n");
  edits_between("a\n", "a");
  edits_between("\n\n\n", "\n");
  edits_between("\xEF\xBB\xBFscene 1\n", "scene 1\n");
}

TEST(TextEdits, LeadFromAnyTextToAnyOther) {
  std::mt19937 random(7);  // NOLINT: the same texts in each run
  const std::vector<std::string> parts{"a",  " ", "\n",         "\r\n",   "}\n",
                                       "\r", "é", "\U0001F600", "  b {\n"};
  const auto text = [&] {
    std::string made;
    for (std::size_t i = random() % 12; i > 0; --i) made += parts[random() % parts.size()];
    return made;
  };
  for (int i = 0; i < 20'000; ++i) {
    const std::string from = text(), to = text();
    edits_between(from, to);
    if (testing::Test::HasFailure())
      FAIL() << testing::PrintToString(from) << testing::PrintToString(to);
  }
}

TEST(TextEdits, AreOnePerLineOfALargeText) {
  std::string from, to;
  for (int i = 0; i < 50'000; ++i) {
    const std::string number = std::to_string(i % 100);
    from += "sphere {center:(" + number + ",0,0)}\n";
    to += "  sphere { center: (" + number + ", 0, 0) }\n";
  }
  EXPECT_EQ(edits_between(from, to).size(), 50'000u);
}

}  // namespace
}  // namespace sdlc::test
