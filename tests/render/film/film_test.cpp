#include "render/film/film.hpp"

#include <array>
#include <cmath>
#include <span>
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
void trace(std::vector<PixelRun>& runs) {
  for (PixelRun& run : runs) {
    for (std::uint32_t r = 0; r < kReplicates; ++r) {
      PixelRun::Part& part = run.parts[r];
      for (std::uint32_t i = 0; i < part.count; ++i) part.sum += sample(r, part.first + i);
    }
  }
}

void bring_to(Film& film, std::size_t pixel, std::uint64_t samples, std::uint32_t max_blocks = 3) {
  const ReplicateCounts counts = split_in_replicates(samples);
  film.reserve(std::span(&counts, 1));
  OpenPixels open(film, pixel, pixel + 1, [&](std::size_t) { return counts; });
  while (true) {
    std::vector<PixelRun> runs;
    open.plan(max_blocks, runs);
    if (runs.empty()) break;
    trace(runs);
    for (const PixelRun& run : runs) open.add(run);
  }
  open.close();
}

TEST(Film, HasTheSameBitsInOnePassAndInMany) {
  for (const std::uint64_t samples : {8u, 9u, 100u, 255u, 256u, 1024u, 5000u}) {
    Film at_once({.first_pixel = 10, .pixels = 2}), in_passes({.first_pixel = 10, .pixels = 2});
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

TEST(Film, TakesOneValueForAPowerOfTwoOfBlocks) {
  constexpr std::size_t kOneEach = kReplicates * (sizeof(LinearRgb) + sizeof(std::uint32_t));
  static_assert(kOneEach <= 128);
  for (const std::uint64_t samples : {8u, 100u, 255u, 256u, 1024u, 1u << 20}) {
    EXPECT_EQ(Film::bytes_per_pixel(samples), kOneEach) << samples;
  }
  EXPECT_EQ(Film::bytes_per_pixel(1), sizeof(LinearRgb) + sizeof(std::uint32_t));
}

// The pixel's sums have fewer values at the target than on the way there.
TEST(Film, DropsSamplesShortOfTheTargetThatHaveNoRoom) {
  const ReplicateCounts all = split_in_replicates(4 * 256), some = split_in_replicates(4 * 192);
  Film film({.pixels = 1});
  film.reserve(std::span(&all, 1));
  for (const ReplicateCounts& stop : {some, all}) {
    OpenPixels open(film, 0, 1, [&](std::size_t) { return all; });
    std::vector<PixelRun> runs;
    open.plan(stop[0] / SampleSum::kBlock, runs);
    trace(runs);
    for (const PixelRun& run : runs) open.add(run);
    open.close();
    EXPECT_EQ(film.samples(0), stop == all ? 1024u : 0u);
  }
  Film at_once({.pixels = 1});
  bring_to(at_once, 0, 1024);
  EXPECT_EQ(film.mean(0), at_once.mean(0));
}

TEST(Film, PlansRunsThatEndWithTheirBlocks) {
  Film film({.first_pixel = 5, .pixels = 1});
  bring_to(film, 0, 4 * 40);
  const ReplicateCounts target{200, 40, 40, 41};
  film.reserve(std::span(&target, 1));
  OpenPixels open(film, 0, 1, [&](std::size_t) { return target; });
  std::vector<PixelRun> runs;
  open.plan(2, runs);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].pixel, 5u);
  EXPECT_EQ(runs[0].parts[0].first, 40u);
  EXPECT_EQ(runs[0].parts[0].count, 24u);
  EXPECT_NE(runs[0].parts[0].sum, LinearRgb{});
  EXPECT_EQ(runs[0].parts[1].count, 0u);
  EXPECT_EQ(runs[0].parts[3].count, 1u);
  EXPECT_EQ(runs[1].parts[0].first, 64u);
  EXPECT_EQ(runs[1].parts[0].count, 64u);
  EXPECT_EQ(runs[1].parts[0].sum, LinearRgb{});
  EXPECT_EQ(runs[1].samples(), 64u);
}

/// A film of one pixel with two samples in each replicate.
Film with_sums(const std::array<LinearRgb, kReplicates>& sums) {
  Film film({.pixels = 1});
  const ReplicateCounts two{2, 2, 2, 2};
  film.reserve(std::span(&two, 1));
  OpenPixels open(film, 0, 1, [&](std::size_t) { return two; });
  PixelRun run;
  for (std::uint32_t i = 0; i < kReplicates; ++i) run.parts[i] = {0, 2, sums[i]};
  open.add(run);
  open.close();
  return film;
}

// Means of replicates 1, 2, 3 and 6 in red, a half in green, 7 in blue: x̄ = 3, Σ (x − x̄)² = 14.
TEST(Film, KnowsHowFarReplicatesAreApart) {
  const auto twice = [](double red) { return LinearRgb{red, red / 2, 7} * 2; };
  const Film film = with_sums({twice(1), twice(2), twice(3), twice(6)});
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
    const auto twice = [&](double red) { return LinearRgb{red, 2, 3} * (2 * unit); };
    const PixelSpread spread = with_sums({twice(1), twice(2), twice(5), twice(10)}).spread(0);
    return spread.covariance / spread.squared_error;
  };
  EXPECT_GT(relative(1), 0);
  EXPECT_NEAR(relative(0x1p340), relative(1), 1e-12);
  EXPECT_NEAR(relative(0x1p-340), relative(1), 1e-12);
}

}  // namespace
}  // namespace sdlc::render
