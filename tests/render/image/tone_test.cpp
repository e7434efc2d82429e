#include "render/image/tone.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

TEST(Tone, SrgbGivesTheKnownCodes) {
  EXPECT_EQ(to_code8(Tone::Srgb, 0.18), 118);  // 117.65: truncation would give 117
  EXPECT_EQ(to_code8(Tone::Srgb, 0.5), 188);   // 187.52
  EXPECT_EQ(to_code8(Tone::Srgb, 0.001), 3);   // 3.29, in the straight part of the curve
}

TEST(Tone, SqrtGivesTheKnownCodes) {
  EXPECT_EQ(to_code8(Tone::Sqrt, 0.18), 108);  // 108.19
  EXPECT_EQ(to_code8(Tone::Sqrt, 0.001), 8);   // 8.06
  EXPECT_EQ(to_code8(Tone::Sqrt, 0.035), 48);  // 47.71: truncation would give 47
}

TEST(Tone, LinearScalesAndRounds) {
  EXPECT_EQ(to_code8(Tone::Linear, 0.5), 128);  // 127.5
  EXPECT_EQ(to_code8(Tone::Linear, 1.4 / 255), 1);
  EXPECT_EQ(to_code8(Tone::Linear, 1.6 / 255), 2);
}

class EveryTone : public testing::TestWithParam<Tone> {};
const auto kToneName = [](const testing::TestParamInfo<Tone>& tested) {
  constexpr std::array kNames{"Srgb", "Sqrt", "Linear"};
  return std::string(kNames[static_cast<std::size_t>(tested.param)]);
};
INSTANTIATE_TEST_SUITE_P(Tone, EveryTone, testing::Values(Tone::Srgb, Tone::Sqrt, Tone::Linear),
                         kToneName);

TEST_P(EveryTone, ClampsWhatIsOutOfRange) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double v : {-kInfinity, -1.0, -0.0, 0.0, std::nan("")}) {
    EXPECT_EQ(to_code8(GetParam(), v), 0) << v;
    EXPECT_EQ(encode_tone(GetParam(), v), 0) << v;
  }
  for (const double v : {1.0, 1.001, 1e300, kInfinity}) {
    EXPECT_EQ(to_code8(GetParam(), v), 255) << v;
    EXPECT_EQ(encode_tone(GetParam(), v), 1) << v;
  }
}

TEST_P(EveryTone, EncodesTheValueBehindEachCodeAsThatCode) {
  for (int code = 0; code <= 255; ++code) {
    EXPECT_EQ(to_code8(GetParam(), decode_tone(GetParam(), code / 255.0)), code);
  }
}

TEST_P(EveryTone, HasANameThatLeadsBackToIt) {
  EXPECT_EQ(tone_of(name_of(GetParam())), GetParam());
}

TEST(Tone, IsNothingByAnotherName) { EXPECT_EQ(tone_of("gamma"), std::nullopt); }

}  // namespace
}  // namespace sdlc::render
