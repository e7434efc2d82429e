#include "render/film/film.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

/// The radiance of a sample, different in each replicate and channel.
LinearRgb sample(std::uint32_t replicate, std::uint32_t index) {
  const double v = std::exp(3 * std::sin(7.0 * replicate + index));
  return {v, 2 * v, std::sqrt(v)};
}

/// The result of a kernel for a run.
void trace(std::vector<SampleRun>& runs) {
  for (SampleRun& run : runs) {
    for (std::uint32_t i = 0; i < run.count; ++i) run.sum += sample(run.replicate, run.first + i);
  }
}

void bring_to(Film& film, std::size_t pixel, std::uint64_t samples, std::uint32_t max_blocks = 3) {
  Film::Target target;
  for (std::uint32_t i = 0; i < kReplicates; ++i) target[i] = samples_in_replicate(samples, i);
  film.reserve(target[0]);
  while (true) {
    std::vector<SampleRun> runs;
    film.plan(pixel, target, max_blocks, runs);
    if (runs.empty()) return;
    trace(runs);
    for (const SampleRun& run : runs) film.add(run);
  }
}

TEST(Film, HasTheSameBitsInOnePassAndInMany) {
  for (const std::uint64_t samples : {8u, 9u, 100u, 255u, 1024u, 5000u}) {
    Film at_once(10, 2), in_passes(10, 2);
    bring_to(at_once, 1, samples, 1000);
    for (std::uint64_t n = 1; n < samples; n += n / 4 + 1) bring_to(in_passes, 1, n);
    bring_to(in_passes, 1, samples);
    EXPECT_EQ(in_passes.samples(1), samples);
    EXPECT_EQ(in_passes.mean(1), at_once.mean(1)) << samples;
    EXPECT_EQ(in_passes.spread(1).covariance, at_once.spread(1).covariance);
    EXPECT_EQ(in_passes.samples(0), 0u);
    EXPECT_EQ(in_passes.mean(0), LinearRgb{});
  }
}

TEST(Film, PlansRunsThatEndWithTheirBlocks) {
  Film film(5, 1);
  bring_to(film, 0, 4 * 40);
  std::vector<SampleRun> runs;
  film.reserve(200);
  film.plan(0, {200, 40, 40, 40}, 2, runs);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].pixel, 5u);
  EXPECT_EQ(runs[0].first, 40u);
  EXPECT_EQ(runs[0].count, 24u);
  EXPECT_NE(runs[0].sum, LinearRgb{});
  EXPECT_EQ(runs[1].first, 64u);
  EXPECT_EQ(runs[1].count, 64u);
  EXPECT_EQ(runs[1].sum, LinearRgb{});
}

// Means of replicates 1, 2, 3 and 6 in red, a half in green, 7 in blue: x̄ = 3, Σ (x − x̄)² = 14.
TEST(Film, KnowsHowFarReplicatesAreApart) {
  Film film(0, 1);
  film.reserve(2);
  const std::array<double, kReplicates> red{1, 2, 3, 6};
  for (std::uint32_t i = 0; i < kReplicates; ++i) {
    film.add({.pixel = 0,
              .replicate = i,
              .first = 0,
              .count = 2,
              .sum = LinearRgb{red[i], red[i] / 2, 7} * 2});
  }
  EXPECT_EQ(film.mean(0), LinearRgb(3, 1.5, 7));
  EXPECT_DOUBLE_EQ(film.variance(0).r, 14.0 / 3 / 4);
  EXPECT_DOUBLE_EQ(film.variance(0).g, 14.0 / 3 / 4 / 4);
  EXPECT_EQ(film.variance(0).b, 0);
  const PixelSpread spread = film.spread(0);
  EXPECT_DOUBLE_EQ(spread.squared_error, 1.25 * 14.0 / 12);
  EXPECT_DOUBLE_EQ(spread.grey_variance, 0.25 * 14.0 / 12);
  // S has rank 1 and the trace 14 / 3 · 5 / 4: 0.9 (1 − 1 / 3) of its square.
  const double trace = 14.0 / 3 * 1.25;
  EXPECT_DOUBLE_EQ(spread.covariance, std::sqrt(0.6) * trace);
}

TEST(Film, KnowsItOfRadianceFarFromOne) {
  const auto relative = [](double unit) {
    Film film(0, 1);
    film.reserve(2);
    for (std::uint32_t i = 0; i < kReplicates; ++i) {
      film.add({.pixel = 0,
                .replicate = i,
                .first = 0,
                .count = 2,
                .sum = LinearRgb{1.0 + i * i, 2, 3} * (2 * unit)});
    }
    const PixelSpread spread = film.spread(0);
    return spread.covariance / spread.squared_error;
  };
  EXPECT_GT(relative(1), 0);
  EXPECT_NEAR(relative(0x1p340), relative(1), 1e-12);
  EXPECT_NEAR(relative(0x1p-340), relative(1), 1e-12);
}

}  // namespace
}  // namespace sdlc::render
