#include "render/sampler/sampler.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

TEST(PathSampler, IsAFunctionOfSeedPixelSampleAndDimension) {
  const auto value = [](std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample,
                        std::uint32_t d) {
    return PathSampler(PathSampler::pixel_key(seed, pixel), sample).uniform(d);
  };
  const double base = value(1, 2, 3, 4);
  EXPECT_EQ(value(1, 2, 3, 4), base);
  EXPECT_NE(value(2, 2, 3, 4), base);
  EXPECT_NE(value(1, 3, 3, 4), base);
  EXPECT_NE(value(1, 2, 4, 4), base);
  EXPECT_NE(value(1, 2, 3, 5), base);
}

/// The statistic's p-value by the normal approximation to χ² (Wilson, Hilferty, 1931).
double chi_square_p(double statistic, double degrees) {
  const double z =
      (std::cbrt(statistic / degrees) - (1 - 2 / (9 * degrees))) / std::sqrt(2 / (9 * degrees));
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

// H0: pairs of neighbouring pixels, samples and dimensions are uniform on the square. χ² over 32 ×
// 32 cells, significance 1e-4 each.
TEST(PathSampler, FillsTheSquareEvenlyAcrossPixelsSamplesAndDimensions) {
  constexpr int kCells = 32, kPairs = 1 << 20;
  const auto key = [](int pixel) {
    return PathSampler::pixel_key(0, static_cast<std::uint64_t>(pixel));
  };
  const auto check = [&](const char* name, auto&& pair) {
    std::array<std::array<int, kCells>, kCells> counts{};
    for (int i = 0; i < kPairs; ++i) {
      const auto [a, b] = pair(i);
      ++counts[static_cast<std::size_t>(a * kCells)][static_cast<std::size_t>(b * kCells)];
    }
    const double expected = static_cast<double>(kPairs) / (kCells * kCells);
    double statistic = 0;
    for (const auto& row : counts) {
      for (const int count : row) statistic += (count - expected) * (count - expected) / expected;
    }
    const double p = chi_square_p(statistic, kCells * kCells - 1);
    EXPECT_GT(p, 1e-4) << name;
    EXPECT_LT(p, 1 - 1e-4) << name << " is too even to be random";
  };
  check("pixels", [&](int i) {
    return std::pair{PathSampler(key(i), 0).uniform(0), PathSampler(key(i + 1), 0).uniform(0)};
  });
  check("samples", [&](int i) {
    const auto sample = static_cast<std::uint64_t>(i);
    return std::pair{PathSampler(key(5), sample).uniform(3),
                     PathSampler(key(5), sample + 1).uniform(3)};
  });
  check("dimensions", [&](int i) {
    const PathSampler sampler(key(i), 9);
    return std::pair{sampler.uniform(6), sampler.uniform(7)};
  });
}

// H0: the samples of a pixel are independent of each other, and of those of the next pixel. The
// variance of the mean of 64 then is 1/64 of that of one (kurtosis 3 − 6/5/64), and means of
// neighbours do not correlate. 16 tests at |z| < 4.5: false alarm rate 1.1e-4.
TEST(PathSampler, MakesPixelMeansThatSpreadAsThoseOfIndependentSamples) {
  constexpr int kPixels = 1 << 16, kSamples = 64;
  for (const std::uint32_t dimension :
       {kPixelX + 0u, vertex_dimension(0, kDirectionZ), vertex_dimension(0, kDirectionTurn),
        vertex_dimension(3, kChoice)}) {
    for (std::uint64_t seed = 0; seed < 2; ++seed) {
      double variance = 0, covariance = 0, last = 0;
      for (std::uint64_t pixel = 0; pixel < kPixels; ++pixel) {
        const std::uint64_t key = PathSampler::pixel_key(seed, pixel);
        double sum = 0;
        for (std::uint64_t i = 0; i < kSamples; ++i) {
          sum += PathSampler(key, i).uniform(dimension) - 0.5;
        }
        const double mean = sum / std::sqrt(kSamples / 12.0);
        variance += mean * mean;
        covariance += mean * last;
        last = mean;
      }
      const double spread = std::sqrt((2 - 1.2 / kSamples) / kPixels);
      EXPECT_LT(std::fabs(variance / kPixels - 1) / spread, 4.5) << "dimension " << dimension;
      EXPECT_LT(std::fabs(covariance) / std::sqrt(kPixels), 4.5) << "dimension " << dimension;
    }
  }
}

TEST(PathSampler, StaysBelowOne) {
  const PathSampler sampler(PathSampler::pixel_key(3, 1), 4);
  for (std::uint32_t d = 0; d < 100000; ++d) {
    ASSERT_GE(sampler.uniform(d), 0);
    ASSERT_LT(sampler.uniform(d), 1);
  }
}

}  // namespace
}  // namespace sdlc::render
