#include "lang/text/nearest_name.hpp"

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace sdlc::lang {
namespace {

constexpr std::array<std::string_view, 4> kNames{"radius", "center", "material", "view_height"};

TEST(NearestName, FindsTypos) {
  EXPECT_EQ(nearest_name("radus", kNames), "radius");
  EXPECT_EQ(nearest_name("raduis", kNames), "radius");
  EXPECT_EQ(nearest_name("RADIUS", kNames), "radius");
  EXPECT_EQ(nearest_name("centre", kNames), "center");
}

TEST(NearestName, FindsAbbreviations) {
  EXPECT_EQ(nearest_name("mat", kNames), "material");
  EXPECT_EQ(nearest_name("view", kNames), "view_height");
}

TEST(NearestName, FindsShortNamesAmongFewOnly) {
  EXPECT_EQ(nearest_name("m", std::array<std::string_view, 2>{"n", "radius"}), "n");
  std::vector<std::string_view> many(17, "crimson");
  many.push_back("n");
  EXPECT_EQ(nearest_name("m", many), std::nullopt);
  EXPECT_EQ(nearest_name("N", many), "n");
}

TEST(NearestName, CountsSwappedNeighboursOnce) {
  // Two edits in six letters are a typo, three are another word.
  EXPECT_EQ(nearest_name("etmpty", std::array<std::string_view, 1>{"tempty"}), "tempty");
  EXPECT_EQ(nearest_name("etpmty", std::array<std::string_view, 1>{"tempty"}), "tempty");
  EXPECT_EQ(nearest_name("etpmyt", std::array<std::string_view, 1>{"tempty"}), std::nullopt);
}

/// By its definition: the table of a, b and their prefixes, row by row.
std::size_t distance_by_table(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> table(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        table[i][j] = i + j;
        continue;
      }
      table[i][j] = std::min({table[i - 1][j] + 1, table[i][j - 1] + 1,
                              table[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool is_swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swapped) table[i][j] = std::min(table[i][j], table[i - 2][j - 2] + 1);
    }
  }
  return table[a.size()][b.size()];
}

TEST(NearestName, IsWithinAThirdOfTheLongerName) {
  std::mt19937 random(1);
  int near = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto word = [&] {
      std::string text(3 + random() % 10, ' ');
      for (char& c : text) c = static_cast<char>('a' + random() % 3);
      return text;
    };
    const std::string a = word(), b = word();
    const bool is_part = a.starts_with(b) || b.starts_with(a);
    const bool is_similar = is_part || distance_by_table(a, b) <= std::max(a.size(), b.size()) / 3;
    const bool is_near = is_similar && a != b;  // the name itself is not a suggestion
    near += is_near ? 1 : 0;
    EXPECT_EQ(nearest_name(a, std::array<std::string_view, 1>{b}).has_value(), is_near)
        << a << ' ' << b;
  }
  EXPECT_GT(near, 500);
}

TEST(NearestName, FindsNothingFarAway) {
  EXPECT_EQ(nearest_name("temperature", kNames), std::nullopt);
  EXPECT_EQ(nearest_name("", kNames), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(1000, 'r'), kNames), std::nullopt);
}

}  // namespace
}  // namespace sdlc::lang
