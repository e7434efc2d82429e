#include "cli/numbers/format_numbers.hpp"

#include <gtest/gtest.h>

namespace sdlc::cli {
namespace {

TEST(FormatSeconds, UsesTheUnitThatReadsBest) {
  EXPECT_EQ(format_seconds(0.000154), "0.15 ms");
  EXPECT_EQ(format_seconds(0.0123), "12 ms");
  EXPECT_EQ(format_seconds(59.94), "59.9 s");
  EXPECT_EQ(format_seconds(245), "4 min 05 s");
  EXPECT_EQ(format_seconds(7800), "2 h 10 min");
}

TEST(FormatCount, KeepsThreeDigits) {
  EXPECT_EQ(format_count(999), "999");
  EXPECT_EQ(format_count(1234), "1.23 k");
  EXPECT_EQ(format_count(71.2e6), "71.2 M");
  EXPECT_EQ(format_count(7.1e14), "710 T");
}

TEST(FormatWhole, PutsTheDigitsInGroupsOfThree) {
  EXPECT_EQ(format_whole(0), "0");
  EXPECT_EQ(format_whole(999), "999");
  EXPECT_EQ(format_whole(1000), "1,000");
  EXPECT_EQ(format_whole(12345678), "12,345,678");
  EXPECT_EQ(format_whole(UINT64_MAX), "18,446,744,073,709,551,615");
}

TEST(FormatBytes, CountsIn1024s) {
  EXPECT_EQ(format_bytes(1023), "1023 B");
  EXPECT_EQ(format_bytes(1024), "1.00 KiB");
  EXPECT_EQ(format_bytes(40'000'000), "38.1 MiB");
  EXPECT_EQ(format_bytes(std::uint64_t{1} << 40), "1.00 TiB");
  EXPECT_EQ(format_bytes(std::uint64_t{5000} << 40), "5000 TiB");
}

TEST(FormatRounded, KeepsSixDigitsInTheSpellingOfTheLanguage) {
  EXPECT_EQ(format_rounded(-1.0 / 3), "-0.333333");
  EXPECT_EQ(format_rounded(0.1 + 0.2), "0.3");
  EXPECT_EQ(format_rounded(-1000.5), "-1000.5");
  EXPECT_EQ(format_rounded(1e9), "1e9");
  EXPECT_EQ(format_rounded(-0.0), "0");
}

}  // namespace
}  // namespace sdlc::cli
