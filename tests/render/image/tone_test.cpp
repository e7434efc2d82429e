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
  constexpr std::array kNames{"Srgb", "Sqrt", "Linear", "Neutral"};
  return std::string(kNames[static_cast<std::size_t>(tested.param)]);
};
INSTANTIATE_TEST_SUITE_P(Tone, EveryTone,
                         testing::Values(Tone::Srgb, Tone::Sqrt, Tone::Linear, Tone::Neutral),
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

TEST(ToneMapping, ExposureMultipliesByAPowerOfTwoBeforeTheCurve) {
  const LinearRgb color(0.1, 0.3, 0.02);
  for (const Tone tone : {Tone::Srgb, Tone::Sqrt, Tone::Linear, Tone::Neutral}) {
    for (const double stops : {-3.0, 0.5, 2.0}) {
      EXPECT_EQ(to_codes8({tone, stops}, color), to_codes8({tone}, color * std::exp2(stops)));
    }
  }
  EXPECT_EQ(to_codes8({Tone::Linear, 1}, {0.1, 0.2, 0.3}),
            (std::array<std::uint8_t, 3>{51, 102, 153}));
}

TEST(ToneMapping, OfAnyExposureGivesCodes) {
  using Codes = std::array<std::uint8_t, 3>;
  EXPECT_EQ(to_codes8({Tone::Neutral, 1e6}, {0, 0, 0}), (Codes{0, 0, 0}));
  EXPECT_EQ(to_codes8({Tone::Srgb, 1e6}, {0, 1, 1}), (Codes{0, 255, 255}));
  EXPECT_EQ(to_codes8({Tone::Neutral, -1e6}, {1, 1, 1}), (Codes{0, 0, 0}));
}

TEST(ToneMapping, IsDescribedWithItsExposureIfItHasOne) {
  EXPECT_EQ(describe(ToneMapping{Tone::Neutral}), "neutral");
  EXPECT_EQ(describe(ToneMapping{Tone::Srgb, -1.5}), "srgb with exposure -1.5");
}

// The expected values were computed by hand from the specification.
TEST(Neutral, GivesTheValuesOfTheSpecification) {
  const auto expect_near = [](LinearRgb made, LinearRgb expected) {
    for (double LinearRgb::*c : {&LinearRgb::r, &LinearRgb::g, &LinearRgb::b}) {
      EXPECT_NEAR(made.*c, expected.*c, 1e-12);
    }
  };
  // f = 0.04, the peak 0.46 is below 0.76.
  expect_near(compress_neutrally({0.5, 0.2, 0.1}), {0.46, 0.16, 0.06});
  // f = 0.04 - 0.04² / 0.16 = 0.03.
  expect_near(compress_neutrally({0.5, 0.2, 0.04}), {0.47, 0.17, 0.01});
  // p = 2, pn = 1 - 0.0576 / 1.48, g = 1 / (0.15 (2 - pn) + 1).
  const double pn = 1 - 0.0576 / 1.48, g = 1 / (0.15 * (2 - pn) + 1);
  expect_near(compress_neutrally({2, 1, 0}), {pn, pn * g / 2 + pn * (1 - g), pn * (1 - g)});
}

TEST(Neutral, KeepsGreysGreyAndBlackBlack) {
  EXPECT_EQ(compress_neutrally({0, 0, 0}), LinearRgb());
  for (const double v : {0.01, 0.08, 0.5, 0.8, 0.81, 3.0, 1e6}) {
    const LinearRgb grey = compress_neutrally(LinearRgb(v));
    EXPECT_NEAR(grey.g, grey.r, 1e-15);
    EXPECT_NEAR(grey.b, grey.r, 1e-15);
  }
}

/// The position of the middle component between the smallest and the largest, which is the hue.
double hue(LinearRgb c) { return (c.g - c.b) / (c.r - c.b); }

TEST(Neutral, KeepsTheHueWhereItDesaturates) {
  const LinearRgb color(1, 0.4, 0.1);
  double last_saturation = 1;
  for (const double brightness : {0.1, 0.5, 0.79, 0.81, 2.0, 10.0, 1000.0}) {
    const LinearRgb made = compress_neutrally(color * brightness);
    EXPECT_NEAR(hue(made), hue(color), 1e-9) << brightness;
    const double saturation = 1 - made.b / made.r;
    if (brightness > 1) {
      EXPECT_LT(saturation, last_saturation) << brightness;
    }
    last_saturation = saturation;
  }
  EXPECT_LT(last_saturation, 0.01);  // nearly white
}

// At 2 F90 in the smallest component, and at Ks in the peak.
TEST(Neutral, IsContinuousAndMonotone) {
  for (const LinearRgb color : {LinearRgb(1), LinearRgb(1, 0.5, 0.1), LinearRgb(1, 0, 0)}) {
    LinearRgb last = compress_neutrally({0, 0, 0});
    constexpr double kStep = 1e-4;
    for (int i = 1; i < 30000; ++i) {
      const LinearRgb made = compress_neutrally(color * (i * kStep));
      for (double LinearRgb::*c : {&LinearRgb::r, &LinearRgb::g, &LinearRgb::b}) {
        ASSERT_GE(made.*c, last.*c) << i;
        ASSERT_LE(made.*c, last.*c + 1.001 * kStep) << i;
      }
      last = made;
    }
  }
}

TEST(Neutral, ApproachesOneAndRefusesNothing) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double v : {1e9, 1e300, kInfinity}) {
    const LinearRgb made = compress_neutrally({v, 0.1, std::nan("")});
    EXPECT_NEAR(made.r, 1, 1e-9);
    EXPECT_NEAR(made.g, 1, 1e-6);
    EXPECT_LE(made.r, 1);
  }
  EXPECT_EQ(compress_neutrally({-1, std::nan(""), -kInfinity}), LinearRgb());
}

TEST(Tone, IsNothingByAnotherName) { EXPECT_EQ(tone_of("gamma"), std::nullopt); }

}  // namespace
}  // namespace sdlc::render
