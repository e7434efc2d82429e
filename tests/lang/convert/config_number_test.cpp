#include "lang/convert/config_number.hpp"

#include <array>
#include <bit>
#include <cstdint>

#include <gtest/gtest.h>

#include "tests/support/configs/config_generator.hpp"

namespace sdlc::lang {
namespace {

TEST(ConfigNumber, IsTheShortestAndKeepsTheSignOfZero) {
  EXPECT_EQ(config_number(0.1), "0.1");
  EXPECT_EQ(config_number(1e300), "1e300");
  EXPECT_EQ(config_number(-1e-7), "-1e-7");
  EXPECT_EQ(config_number(0), "0");
  EXPECT_EQ(config_number(-0.0), "-0");
}

TEST(ToConfigScale, FindsTheNumbersThatPeopleWrite) {
  // Multiplying the quotient gives a different number for some: 63.9 / 255 * 255.
  for (const double number : {0.0, 1.0, 63.9, 127.5, 178.5, 254.9, 255.0, 1020.3, 1e-300}) {
    const ScaledComponent scaled = to_config_scale(number / 255, {});
    EXPECT_EQ(scaled.number, number);
    EXPECT_TRUE(scaled.is_exact) << number;
  }
}

TEST(ToConfigScale, PrefersTheNumberThatTheSceneSpellsOut) {
  const double shorter = 63.9,
               other = std::bit_cast<double>(std::bit_cast<std::uint64_t>(63.9) + 1);
  ASSERT_EQ(shorter / 255, other / 255);
  EXPECT_EQ(to_config_scale(other / 255, {}).number, shorter);
  const std::array preferred{0.5, other, 300.0};
  EXPECT_EQ(to_config_scale(other / 255, preferred).number, other);
}

TEST(ToConfigScale, IsExactOrNearestForEveryComponent) {
  test::SplitMix64 random(7);
  int exact = 0;
  constexpr int kCount = 100'000;
  for (int i = 0; i < kCount; ++i) {
    // Every mantissa is equally likely.
    const double component = std::bit_cast<double>((random.next() >> 12) | 0x3FF0000000000000u);
    const ScaledComponent scaled = to_config_scale(component, {});
    exact += scaled.is_exact;
    EXPECT_EQ(scaled.is_exact, scaled.number / 255 == component);
    EXPECT_NEAR(scaled.number / 255, component, component * 0x1p-52);
  }
  // The spacing of the quotients is larger by a 255th than that of the components: so many
  // components have none.
  EXPECT_GT(exact, kCount * 0.99);
  EXPECT_LT(exact, kCount);
}

}  // namespace
}  // namespace sdlc::lang
