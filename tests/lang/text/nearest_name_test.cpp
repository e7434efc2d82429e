#include "lang/text/nearest_name.hpp"

#include <array>

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

TEST(NearestName, FindsNothingFarAway) {
  EXPECT_EQ(nearest_name("temperature", kNames), std::nullopt);
  EXPECT_EQ(nearest_name("", kNames), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(1000, 'r'), kNames), std::nullopt);
}

}  // namespace
}  // namespace sdlc::lang
