#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/shading/sampler.hpp"
#include "tests/support/reference/path_sampler.hpp"

// Neighbouring streams of random numbers, of pixels, samples, dimensions and seeds, must be
// independent: otherwise the mean of a picture is wrong, although every pixel looks right. (The
// frames of a film are distinguished by their seeds too.) The tests are validated with generators
// that are known to be bad, which they must reject.
namespace sdlc::render {
namespace {

using test::reference::PathSampler;
using test::reference::UniformPair;

/// The coordinates of a random number.
struct Place {
  std::uint64_t seed = 0, pixel = 0, sample = 0;
  std::uint32_t dimension = 0;
};

/// Our generator.
double path_number(const Place& place) {
  const PathSampler sampler(SamplerKind::Independent, stream_key(place.seed, place.pixel, 0),
                            static_cast<std::uint32_t>(place.sample));
  const UniformPair pair = sampler.pair(place.dimension / 2);
  return place.dimension % 2 == 0 ? pair.first : pair.second;
}

/// PCG32, XSH RR 64/32 (O'Neill, "PCG: A family of simple fast space-efficient statistically good
/// algorithms for random number generation", 2014), with consecutive samples in one stream.
class Pcg {
 public:
  static constexpr std::uint64_t kNumbersASample = 32;

  Pcg(std::uint64_t state, std::uint64_t stream) : state_(state), increment_(2 * stream + 1) {}

  /// The published initialisation: two steps from the caller's seed.
  static Pcg started(std::uint64_t state, std::uint64_t stream) {
    Pcg pcg(state, stream);
    pcg.state_ += pcg.increment_;
    pcg.advance(1);
    return pcg;
  }

  double number(std::uint64_t sample, std::uint32_t dimension) {
    advance(sample * kNumbersASample + dimension);
    const auto shifted = static_cast<std::uint32_t>(((state_ >> 18) ^ state_) >> 27);
    const auto turn = static_cast<std::uint32_t>(state_ >> 59);
    return ((shifted >> turn) | (shifted << (-turn & 31))) * 0x1p-32;
  }

 private:
  void advance(std::uint64_t steps) {
    std::uint64_t factor = 6364136223846793005u, increment = increment_;
    for (; steps > 0; steps /= 2) {
      if (steps % 2 == 1) state_ = state_ * factor + increment;
      increment *= factor + 1;
      factor *= factor;
    }
  }

  std::uint64_t state_, increment_;
};

/// The pixel's number selects the stream.
double pcg_by_stream(const Place& place) {
  return Pcg::started(place.seed, place.pixel).number(place.sample, place.dimension);
}

/// The pixel's number is the initial state.
double pcg_by_state(const Place& place) {
  return Pcg::started(place.pixel, place.seed).number(place.sample, place.dimension);
}

/// The same, without the initialisation: numbers of the first sample are small.
double pcg_by_raw_state(const Place& place) {
  return Pcg(place.pixel, place.seed).number(place.sample, place.dimension);
}

/// One stream for all pixels, each with different numbers: a good generator.
double pcg_in_one_stream(const Place& place) {
  constexpr std::uint64_t kSamplesAPixel = 1 << 12;
  return Pcg::started(42 + place.seed * 0x9E3779B97F4A7C15, 54)
      .number(place.pixel * kSamplesAPixel + place.sample, place.dimension);
}

using Generator = double (*)(const Place&);

/// The result of a test of H0 "independent and uniform", in standard errors.
struct Finding {
  std::string name;
  double z = 0;
};

/// Pairs of numbers at this distance from each other.
struct Distance {
  int seeds = 0, pixels = 0, samples = 0, dimensions = 0;

  Place from(Place place) const {
    place.seed += static_cast<std::uint64_t>(seeds);
    place.pixel += static_cast<std::uint64_t>(pixels);
    place.sample += static_cast<std::uint64_t>(samples);
    place.dimension += static_cast<std::uint32_t>(dimensions);
    return place;
  }
  std::string name() const {
    return std::to_string(seeds) + " seeds, " + std::to_string(pixels) + " pixels, " +
           std::to_string(samples) + " samples, " + std::to_string(dimensions) +
           " dimensions apart";
  }
};

/// For a pair (a, b) the product, and the two waves that detect numbers with a fixed step between
/// them, or mirrored, or both: each has mean 0 and variance 1 if a and b are independent.
void find_correlations(Generator generator, int pairs, const Distance& distance,
                       std::vector<Finding>& findings) {
  constexpr int kDimensions = 16;
  constexpr double kTurn = 6.283185307179586;
  std::array<double, 3> sums{};
  for (int i = 0; i < pairs; ++i) {
    const auto index = static_cast<std::uint64_t>(i / kDimensions);
    const auto dimension = static_cast<std::uint32_t>(1 + i % kDimensions);
    // Between pixels; only samples are compared between samples.
    const bool is_along_samples = distance.samples > 0 && distance.pixels == 0;
    const Place place{.seed = index % 4,
                      .pixel = is_along_samples ? 11 : index,
                      .sample = is_along_samples ? index : 3,
                      .dimension = dimension};
    const double a = generator(place);
    const double b = generator(distance.from(place));
    sums[0] += 12 * (a - 0.5) * (b - 0.5);
    sums[1] += M_SQRT2 * std::cos(kTurn * (a - b));
    sums[2] += M_SQRT2 * std::cos(kTurn * (a + b));
  }
  constexpr std::array kNames{"product of ", "difference of ", "sum of "};
  for (std::size_t k = 0; k < sums.size(); ++k) {
    findings.push_back({kNames[k] + distance.name(), sums[k] / std::sqrt(double(pairs))});
  }
}

/// A picture of `pixels` pixels whose radiance is the product of two numbers of its path: its mean;
/// and the spread of the means of 64 neighbours, whose variance is 1/64 of that of a pixel.
void find_shifted_means(Generator generator, int pixels, Place place,
                        std::vector<Finding>& findings) {
  constexpr int kNeighbours = 64;
  constexpr double kVariance = 7.0 / 144;  // of a product of two
  constexpr double kKurtosis = 143.0 / 19200 / (kVariance * kVariance);
  double sum = 0, squares = 0;
  for (int first = 0; first < pixels; first += kNeighbours) {
    double part = 0;
    for (int i = 0; i < kNeighbours; ++i) {
      place.pixel = static_cast<std::uint64_t>(first + i);
      Place next = place;
      ++next.dimension;
      part += generator(place) * generator(next) - 0.25;
    }
    sum += part;
    squares += part * part / (kNeighbours * kVariance);
  }
  const double blocks = pixels / kNeighbours;
  const std::string of = " of sample " + std::to_string(place.sample) + ", dimension " +
                         std::to_string(place.dimension) + " and the next";
  findings.push_back({"mean" + of, sum / std::sqrt(pixels * kVariance)});
  const double spread = std::sqrt((2 + (kKurtosis - 3) / kNeighbours) * blocks);
  findings.push_back({"means of neighbours" + of, (squares - blocks) / spread});
}

/// All tests, with this many pairs each and four times as many pixels.
std::vector<Finding> examine(Generator generator, int pairs) {
  constexpr int kWidth = 1920;
  std::vector<Finding> findings;
  const auto correlate = [&](const Distance& distance) {
    find_correlations(generator, pairs, distance, findings);
  };
  for (const int late : {-1, 0, 1, 6}) {
    for (const int apart : {1, 2, kWidth}) {
      correlate({.pixels = apart, .dimensions = late});
      correlate({.samples = apart, .dimensions = late});
    }
    correlate({.seeds = 1, .dimensions = late});
    correlate({.seeds = 1, .pixels = 1, .dimensions = late});
    correlate({.seeds = 1, .pixels = -1, .dimensions = late});
    correlate({.pixels = 1, .samples = 1, .dimensions = late});
    correlate({.pixels = 1, .samples = -1, .dimensions = late});
  }
  for (const int apart : {1, 2, 3, 6, 12}) correlate({.dimensions = apart});
  for (const Place& place : {Place{}, Place{.dimension = 3}, Place{.sample = 1, .dimension = 5},
                             Place{.sample = 63, .dimension = 9}}) {
    find_shifted_means(generator, 4 * pairs, place, findings);
  }
  return findings;
}

Finding worst_of(const std::vector<Finding>& findings) {
  return *std::max_element(
      findings.begin(), findings.end(),
      [](const Finding& a, const Finding& b) { return std::fabs(a.z) < std::fabs(b.z); });
}

// H0: independent and uniform. 155 tests at |z| < 5: false alarm rate 9e-5. With 2^20 pairs a
// correlation of 0.005 is 5 standard errors; one of 0.015 would shift the mean of a product of the
// two by 0.5 %. A mean of 2^22 pixels that is shifted by 0.5 % itself is 12 of its standard errors.
TEST(RandomStreams, OfNeighboursAreIndependent) {
  for (const auto& [name, z] : examine(path_number, 1 << 20)) {
    EXPECT_LT(std::fabs(z), 5) << name;
  }
}

// Checks the power of the tests, with a quarter of the numbers: generators keyed by the pixel alone
// are rejected, mostly by the spread of the means of neighbours, 15 to 30 % too small or 5 % too
// large.
TEST(RandomStreams, OfAPlainGeneratorKeyedByThePixelAreRefused) {
  for (const Generator generator : {pcg_by_stream, pcg_by_state, pcg_by_raw_state}) {
    const Finding worst = worst_of(examine(generator, 1 << 18));
    EXPECT_GT(std::fabs(worst.z), 10) << worst.name;
  }
}

TEST(RandomStreams, OfAGeneratorThatIsNotAreAccepted) {
  const Finding worst = worst_of(examine(pcg_in_one_stream, 1 << 18));
  EXPECT_LT(std::fabs(worst.z), 5) << worst.name;
}

}  // namespace
}  // namespace sdlc::render
