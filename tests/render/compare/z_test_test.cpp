#include "render/compare/z_test.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace sdlc::test {
namespace {

using render::LinearRgb;
using render::NoisyPicture;
using render::Picture;
using render::z_test;
using render::ZTest;

struct Estimated {
  Picture mean, variance;

  operator NoisyPicture() const { return {.mean = mean, .variance = variance}; }
};

/// Pictures like those of a path tracer: noise that differs between pixels and has a long tail,
/// with a variance estimated from four replicates.
class Renders {
 public:
  explicit Renders(unsigned seed) : random_(seed) {}

  using Change = std::function<double(int pixel)>;  ///< of the radiance, as a factor

  Estimated render(const Change& change = [](int) { return 1.0; }) {
    constexpr int kReplicates = 4, kSide = 32;
    Estimated result{Picture(kSide, kSide), Picture(kSide, kSide)};
    for (int i = 0; i < kSide * kSide; ++i) {
      const double radiance = 0.5 + 0.01 * (i % 50), spread = 0.1 + 0.02 * (i % 7);
      const auto draw = [&] {
        std::array<double, kReplicates> replicates;
        double mean = 0, squares = 0;
        for (double& v : replicates) {
          // Exponential noise has expectation 1, which is subtracted.
          v = change(i) * (radiance + spread * (exponential_(random_) - 1));
          mean += v / kReplicates;
        }
        for (const double v : replicates) squares += (v - mean) * (v - mean);
        return std::array{mean, squares / (kReplicates - 1) / kReplicates};
      };
      const auto r = draw(), g = draw(), b = draw();
      const auto at = static_cast<std::size_t>(i);
      result.mean.pixels[at] = {r[0], g[0], b[0]};
      result.variance.pixels[at] = {r[1], g[1], b[1]};
    }
    return result;
  }

 private:
  std::mt19937_64 random_;
  std::exponential_distribution<double> exponential_;
};

/// How many of these pairs are rejected at 5 %, by their means and by their noise.
struct Rejections {
  int pairs = 1000, mean = 0, noise = 0;

  explicit Rejections(const Renders::Change& change) {
    Renders renders(7);
    for (int i = 0; i < pairs; ++i) {
      const Estimated a = renders.render(change), b = renders.render();
      const ZTest test = z_test(a, b);
      mean += test.mean_p < 0.05 ? 1 : 0;
      noise += test.noise_p < 0.05 ? 1 : 0;
    }
  }
};

// H0: both are of the same scene. Of 1000 pairs 50 ± 6.9 are expected to be rejected at 5 %. Four
// standard deviations: a false alarm for 1 of 16,000 choices of the seed, for each test.
// Bonferroni's bound over three independent channels, 4.92 %, is within that.
TEST(ZTest, RejectsOneInTwentyPairsOfTheSameScene) {
  const Rejections rejections([](int) { return 1.0; });
  EXPECT_NEAR(rejections.mean, 50, 4 * 6.9);
  EXPECT_NEAR(rejections.noise, 50, 4 * 6.9);
}

TEST(ZTest, FindsALittleLightThatIsMissingEverywhere) {
  const Rejections rejections([](int) { return 0.97; });
  EXPECT_GT(rejections.mean, 990);
}

// As much more here as less there: the mean is the same, the pictures are not.
TEST(ZTest, FindsWhatDiffersWhileTheMeanStays) {
  const Rejections rejections([](int i) { return i % 2 == 0 ? 1.1 : 0.9; });
  EXPECT_LT(rejections.mean, 80);
  EXPECT_GT(rejections.noise, 990);
}

TEST(ZTest, HasTheValuesOfItsFormulas) {
  Estimated a{Picture(2, 1, LinearRgb(1)), Picture(2, 1, LinearRgb(0.25))};
  const Estimated b{Picture(2, 1, LinearRgb(1)), Picture(2, 1, LinearRgb(0.25))};
  a.mean.at(0, 0).r = 3;
  a.mean.at(1, 0).g = -1;
  const ZTest test = z_test(a, b);
  EXPECT_EQ(test.mean_z, LinearRgb(2, -2, 0));
  EXPECT_NEAR(test.mean_p, 3 * 0.0455003, 1e-6);
  // Either pixel: 4 - 3 · 0.5.
  EXPECT_DOUBLE_EQ(test.noise_z, 5 / std::sqrt(2 * 2.5 * 2.5));
  EXPECT_NEAR(test.noise_p, 0.0786496, 1e-6);
  EXPECT_EQ(test.largest(), 2);
}

TEST(ZTest, FindsNothingBetweenEqualPicturesWithoutNoise) {
  const Estimated a{Picture(3, 3, LinearRgb(1)), Picture(3, 3)};
  const ZTest test = z_test(a, a);
  EXPECT_EQ(test.mean_z, LinearRgb(0));
  EXPECT_EQ(test.mean_p, 1);
  EXPECT_EQ(test.noise_z, 0);
  EXPECT_EQ(test.noise_p, 0.5);
}

TEST(ZTest, IsWithoutBoundWhereThereIsADifferenceAndNoNoise) {
  const Estimated a{Picture(3, 3, {1, 2, 1}), Picture(3, 3)};
  const Estimated b{Picture(3, 3, {1, 1, 2}), Picture(3, 3)};
  const ZTest test = z_test(a, b);
  EXPECT_EQ(test.mean_z.r, 0);
  EXPECT_TRUE(std::isinf(test.mean_z.g) && test.mean_z.g > 0);
  EXPECT_TRUE(std::isinf(test.mean_z.b) && test.mean_z.b < 0);
  EXPECT_EQ(test.mean_p, 0);
}

}  // namespace
}  // namespace sdlc::test
