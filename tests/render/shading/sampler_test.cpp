#include "render/shading/sampler.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/reference/path_sampler.hpp"

namespace sdlc::render {
namespace {

using test::reference::PathSampler;
using test::reference::UniformPair;
using test::reference::vertex_pair;

constexpr std::array kKinds{SamplerKind::Sobol, SamplerKind::Independent};

PathSampler independent(std::uint64_t pixel, std::uint64_t sample, std::uint64_t seed = 0) {
  return {SamplerKind::Independent, stream_key(seed, pixel, 0), static_cast<std::uint32_t>(sample)};
}

TEST(PathSampler, IsAFunctionOfSeedPixelReplicateSampleAndPair) {
  for (const SamplerKind kind : kKinds) {
    const auto value = [&](std::uint64_t seed, std::uint64_t pixel, std::uint64_t replicate,
                           std::uint32_t sample, std::uint32_t pair) {
      const PathSampler sampler(kind, stream_key(seed, pixel, replicate), sample);
      return sampler.pair(pair).first;
    };
    const double base = value(1, 2, 3, 4, 5);
    EXPECT_EQ(value(1, 2, 3, 4, 5), base);
    EXPECT_NE(value(2, 2, 3, 4, 5), base);
    EXPECT_NE(value(1, 3, 3, 4, 5), base);
    EXPECT_NE(value(1, 2, 2, 4, 5), base);
    EXPECT_NE(value(1, 2, 3, 5, 5), base);
    EXPECT_NE(value(1, 2, 3, 4, 6), base);
  }
}

// The defining property of Sobol' points: of the first 2^k points each elementary box of area 2^-k
// contains exactly one, for every shape.
TEST(SobolSampler, PutsOnePointIntoEachElementaryInterval) {
  for (const std::uint32_t pair : {0u, 1u, 2u, 17u}) {
    for (int k = 0; k <= 10; ++k) {
      const std::uint32_t points = 1u << k;
      for (int columns_log = 0; columns_log <= k; ++columns_log) {
        const double columns = std::ldexp(1, columns_log), rows = std::ldexp(1, k - columns_log);
        std::vector<int> found(points);
        for (std::uint32_t i = 0; i < points; ++i) {
          const PathSampler sampler(SamplerKind::Sobol, stream_key(5, 77, 1), i);
          const auto [x, y] = sampler.pair(pair);
          ++found[static_cast<std::size_t>(std::floor(x * columns) * rows + std::floor(y * rows))];
        }
        ASSERT_EQ(found, std::vector<int>(points, 1))
            << points << " points in " << columns << " columns, pair " << pair;
      }
    }
  }
}

// H0: the mean of f over the first 16 points of a stream has the expectation 1/4, and streams are
// independent. 4 tests, |z| < 4.5: false alarm rate 3e-5.
TEST(SobolSampler, IsUnbiasedOverStreams) {
  constexpr int kStreams = 1 << 14;
  const std::array<double (*)(const UniformPair&, const UniformPair&), 4> functions{
      [](const UniformPair& a, const UniformPair&) { return a.first * a.second; },
      [](const UniformPair& a, const UniformPair& b) { return a.first * b.first; },
      [](const UniformPair& a, const UniformPair& b) { return a.second * b.first; },
      [](const UniformPair& a, const UniformPair& b) {
        return a.first < 0.37 && b.second < 0.37 ? 0.25 / (0.37 * 0.37) : 0.0;
      }};
  for (std::size_t f = 0; f < functions.size(); ++f) {
    double sum = 0, squares = 0;
    for (std::uint64_t stream = 0; stream < kStreams; ++stream) {
      const std::uint64_t key = stream_key(3, stream / 4, stream % 4);
      double mean = 0;
      for (std::uint32_t i = 0; i < 16; ++i) {
        const PathSampler sampler(SamplerKind::Sobol, key, i);
        mean += functions[f](sampler.pair(2), sampler.pair(5)) / 16;
      }
      sum += mean - 0.25;
      squares += (mean - 0.25) * (mean - 0.25);
    }
    EXPECT_LT(std::fabs(sum) / std::sqrt(squares), 4.5) << "function " << f;
  }
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
  const auto first = [](std::uint64_t pixel, std::uint64_t sample, std::uint32_t pair) {
    return independent(pixel, sample).pair(pair).first;
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
    const auto pixel = static_cast<std::uint64_t>(i);
    return std::pair{first(pixel, 0, 0), first(pixel + 1, 0, 0)};
  });
  check("samples", [&](int i) {
    const auto sample = static_cast<std::uint64_t>(i);
    return std::pair{first(5, sample, 3), first(5, sample + 1, 3)};
  });
  check("numbers of a pair", [&](int i) {
    const UniformPair pair = independent(static_cast<std::uint64_t>(i), 9).pair(6);
    return std::pair{pair.first, pair.second};
  });
  check("pairs", [&](int i) {
    const auto pixel = static_cast<std::uint64_t>(i);
    return std::pair{first(pixel, 9, 6), first(pixel, 9, 7)};
  });
}

// H0: the samples of a pixel are independent of each other, and of those of the next pixel. The
// variance of the mean of 64 then is 1/64 of that of one (kurtosis 3 − 6/5/64), and means of
// neighbours do not correlate. 16 tests at |z| < 4.5: false alarm rate 1.1e-4.
TEST(PathSampler, MakesPixelMeansThatSpreadAsThoseOfIndependentSamples) {
  constexpr int kPixels = 1 << 16, kSamples = 64;
  for (const std::uint32_t pair :
       {kPixel + 0u, vertex_pair(0, kDirection), vertex_pair(0, kLight), vertex_pair(3, kChoice)}) {
    for (std::uint64_t seed = 0; seed < 2; ++seed) {
      double variance = 0, covariance = 0, last = 0;
      for (std::uint64_t pixel = 0; pixel < kPixels; ++pixel) {
        double sum = 0;
        for (std::uint64_t i = 0; i < kSamples; ++i) {
          sum += independent(pixel, i, seed).pair(pair).second - 0.5;
        }
        const double mean = sum / std::sqrt(kSamples / 12.0);
        variance += mean * mean;
        covariance += mean * last;
        last = mean;
      }
      const double spread = std::sqrt((2 - 1.2 / kSamples) / kPixels);
      EXPECT_LT(std::fabs(variance / kPixels - 1) / spread, 4.5) << "pair " << pair;
      EXPECT_LT(std::fabs(covariance) / std::sqrt(kPixels), 4.5) << "pair " << pair;
    }
  }
}

TEST(PathSampler, StaysBelowOne) {
  for (const SamplerKind kind : kKinds) {
    const PathSampler sampler(kind, stream_key(3, 1, 0), 4);
    for (std::uint32_t pair = 0; pair < 100000; ++pair) {
      const auto [a, b] = sampler.pair(pair);
      ASSERT_GE(std::min(a, b), 0);
      ASSERT_LT(std::max(a, b), 1);
    }
  }
}

}  // namespace
}  // namespace sdlc::render
