#include "lang/repair/repaired_text.hpp"

#include <gtest/gtest.h>

namespace sdlc::lang {
namespace {

TEST(RepairedText, IsItsSourceWithoutEdits) {
  RepairedText text("abc");
  text.apply({});
  EXPECT_EQ(text.text(), "abc");
  EXPECT_FALSE(text.is_changed());
  EXPECT_EQ(text.in_source(2), 2u);
}

TEST(RepairedText, MapsEachByteToItsSource) {
  const std::string source = "f(1 2) g";
  RepairedText text(source);
  text.apply({{{3, 3}, ","}, {{6, 7}, ""}});
  ASSERT_EQ(text.text(), "f(1, 2)g");
  for (std::uint32_t i = 0; i < text.text().size(); ++i) {
    if (!text.is_added(i)) {
      EXPECT_EQ(text.text()[i], source[text.in_source(i)]) << i;
    }
  }
  EXPECT_TRUE(text.is_added(3));
  EXPECT_EQ(text.in_source(3), 3u);
  EXPECT_EQ(text.in_source(8), 8u);
}

TEST(RepairedText, KeepsTheEndOfAReplacedPart) {
  RepairedText text("function f");
  text.apply({{{0, 8}, "fn"}});
  EXPECT_EQ(text.text(), "fn f");
  EXPECT_EQ(text.in_source(Span{0, 2}), (Span{0, 8}));
  EXPECT_EQ(text.in_source(Span{3, 4}), (Span{9, 10}));
}

TEST(RepairedText, AppliesRoundAfterRound) {
  RepairedText text("a b c");
  text.apply({{{1, 1}, ","}});  // a, b c
  text.apply({{{4, 4}, ","}});  // a, b, c
  EXPECT_EQ(text.text(), "a, b, c");
  EXPECT_TRUE(text.is_added(1));
  EXPECT_TRUE(text.is_added(4));
  EXPECT_FALSE(text.is_added(3));
  EXPECT_EQ(text.in_source(6), 4u);
}

TEST(RepairedText, KeepsTheOrderOfInsertionsAndDropsOverlaps) {
  RepairedText text("abcd");
  text.apply({{{2, 2}, ")"}, {{2, 2}, "}"}, {{0, 2}, "x"}, {{1, 2}, "y"}});
  EXPECT_EQ(text.text(), "x)}cd");
}

TEST(RepairedText, HasAPartThatGrowsWithItsEdits) {
  RepairedText text("abc\ndef\nghi");
  text.set_part({4, 8});
  text.apply({{{4, 5}, "12345"}});
  EXPECT_EQ(text.part(), (Span{4, 12}));
  text.apply({{{4, 12}, ""}});
  EXPECT_EQ(text.part(), (Span{4, 4}));
}

}  // namespace
}  // namespace sdlc::lang
