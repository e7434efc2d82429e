#include "lang/value/colors.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace sdlc::lang {
namespace {

using render::LinearRgb;

TEST(Colors, DecodeBytesToFixedBits) {
  // The nearest doubles, from a computation with 60 decimal digits.
  EXPECT_EQ(decode_srgb(0), 0.0);
  EXPECT_EQ(decode_srgb(1), 1 / 255.0 / 12.92);
  EXPECT_EQ(decode_srgb(10), 10 / 255.0 / 12.92);
  EXPECT_EQ(decode_srgb(11), 0.003346535763899161);
  EXPECT_EQ(decode_srgb(128), 0.21586050011389926);
  EXPECT_EQ(decode_srgb(254), 0.9911020971138298);
  EXPECT_EQ(decode_srgb(255), 1.0);
}

TEST(Colors, DecodeFractionsByTheSameFunction) {
  EXPECT_EQ(decode_srgb(127.5), 0.21404114048223255);
  EXPECT_LT(decode_srgb(127.999999), decode_srgb(128));
  EXPECT_LT(decode_srgb(128), decode_srgb(128.000001));
}

TEST(Colors, ReadShortAndLongHexadecimals) {
  EXPECT_EQ(decode_hex_color("#fa0"), decode_hex_color("#ffAA00"));
  EXPECT_EQ(decode_hex_color("#80b3ff"), (LinearRgb{decode_srgb(0x80), decode_srgb(0xB3), 1}));
}

TEST(Colors, NameThe148OfCss) {
  const auto colors = named_colors();
  EXPECT_EQ(colors.size(), 148u);
  EXPECT_TRUE(
      std::is_sorted(colors.begin(), colors.end(),
                     [](const NamedColor& a, const NamedColor& b) { return a.name < b.name; }));
  EXPECT_EQ(find_named_color("white"), (LinearRgb{1, 1, 1}));
  EXPECT_EQ(find_named_color("rebeccapurple"), decode_hex_color("#663399"));
  EXPECT_EQ(find_named_color("tan"), decode_hex_color("#d2b48c"));
  EXPECT_EQ(find_named_color("grey"), find_named_color("gray"));
  EXPECT_FALSE(find_named_color("whit"));
}

TEST(Colors, OfHueSaturationAndLightness) {
  EXPECT_EQ(decode_hsl(0, 1, 0.5), (LinearRgb{1, 0, 0}));
  EXPECT_EQ(decode_hsl(120, 1, 0.5), (LinearRgb{0, 1, 0}));
  EXPECT_EQ(decode_hsl(-120, 1, 0.5), (LinearRgb{0, 0, 1}));
  EXPECT_EQ(decode_hsl(720, 1, 0.5), (LinearRgb{1, 0, 0}));
  EXPECT_EQ(decode_hsl(77, 0, 1), (LinearRgb{1, 1, 1}));
  EXPECT_EQ(decode_hsl(60, 1, 0.25), (LinearRgb{decode_srgb(127.5), decode_srgb(127.5), 0}));
}

}  // namespace
}  // namespace sdlc::lang
