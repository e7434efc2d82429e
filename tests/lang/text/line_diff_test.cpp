#include "lang/text/line_diff.hpp"

#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace sdlc::test {
namespace {

using Changes = std::vector<lang::LineChange>;

Changes changes_between(std::string_view a, std::string_view b) {
  const std::vector<std::string_view> from = lang::lines_of(a), to = lang::lines_of(b);
  return lang::changed_lines(from, to);
}

TEST(LineDiff, SplitsATextAfterItsLineEnds) {
  EXPECT_EQ(lang::lines_of("a\r\n\nb"), (std::vector<std::string_view>{"a\r\n", "\n", "b"}));
  EXPECT_TRUE(lang::lines_of("").empty());
}

TEST(LineDiff, FindsRunsOfChangedLines) {
  EXPECT_EQ(changes_between("a\nb\nc\n", "a\nx\nc\n"), (Changes{{1, 2, 1, 2}}));
  EXPECT_EQ(changes_between("a\nb\n", "a\nx\ny\nb\nz\n"), (Changes{{1, 1, 1, 3}, {2, 2, 4, 5}}));
  EXPECT_TRUE(changes_between("a\n", "a\n").empty());
}

}  // namespace
}  // namespace sdlc::test
