#include "render/denoise/denoise.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "tests/render/denoise/noisy_film.hpp"

namespace sdlc::render {
namespace {

constexpr int kWidth = 40, kHeight = 30;

Denoised denoised(const Film& film) {
  return denoise(portable_filter, film, std::vector<PixelFeatures>(film.size()),
                 test::spreads_of(film), kWidth, kHeight);
}

/// Mean over all values of a picture.
double mean_of(const Film& film) {
  double sum = 0;
  for (std::size_t i = 0; i < film.size(); ++i) {
    const LinearRgb c = film.mean(i);
    sum += (c.r + c.g + c.b) / 3;
  }
  return sum / static_cast<double>(film.size());
}

/// The sum of the squared errors of a picture, in units of `unit`.
double squared_error(const Picture& picture, const test::Limit& limit, double unit) {
  double sum = 0;
  for (std::size_t i = 0; i < limit.size(); ++i) {
    const LinearRgb d = (picture.pixels[i] - limit[i]) * (1 / unit);
    sum += d.r * d.r + d.g * d.g + d.b * d.b;
  }
  return sum;
}

TEST(Denoise, LowersTheErrorOfNoise) {
  const test::Limit limit = test::two_halves(kWidth, kHeight);
  const Film film = test::noisy_film(limit, 0.4, 1);
  Picture plain(kWidth, kHeight);
  for (std::size_t i = 0; i < film.size(); ++i) plain.pixels[i] = film.mean(i);
  EXPECT_LT(squared_error(denoised(film).picture, limit, 1), squared_error(plain, limit, 1) / 3);
}

TEST(Denoise, KeepsAPictureWithoutNoise) {
  const test::Limit limit = test::two_halves(kWidth, kHeight);
  const Denoised result = denoised(test::noisy_film(limit, 0, 1));
  for (std::size_t i = 0; i < limit.size(); ++i) {
    EXPECT_NEAR(result.picture.pixels[i].r, limit[i].r, 1e-5);
    EXPECT_NEAR(result.errors[i].squared_error, 0, 1e-9);
  }
}

// Small noise hides little of the texture, much noise all of it: the error is noise, or bias.
TEST(Denoise, KnowsItsOwnErrorWithItsBias) {
  const test::Limit limit = test::two_halves(kWidth, kHeight);
  for (const double deviation : {0.05, 0.2, 1.0}) {
    constexpr int kPictures = 200;
    int covered = 0;
    double sum = 0, sum_of_squares = 0;
    for (int i = 0; i < kPictures; ++i) {
      const Film film = test::noisy_film(limit, deviation, static_cast<unsigned>(i));
      const Denoised result = denoised(film);
      double estimate = 0, variance = 0;
      for (const DenoisedError& error : result.errors) {
        estimate += error.squared_error;
        variance += error.variance;
      }
      const double off = estimate - squared_error(result.picture, limit, mean_of(film));
      covered += std::abs(off) < 1.96 * std::sqrt(variance);
      sum += off;
      sum_of_squares += off * off;
    }
    // An unbiased estimate is at most 4 standard errors off, but once in 16,000 times.
    EXPECT_LT(std::abs(sum), 4 * std::sqrt(sum_of_squares)) << deviation;
    // 95 %, less and more 3.5 binomial standard errors.
    EXPECT_GE(covered, 0.895 * kPictures) << deviation;
    EXPECT_LT(covered, kPictures) << deviation;
  }
}

// Radiances of all magnitudes give the same picture.
TEST(Denoise, ScalesWithTheRadiance) {
  test::Limit limit = test::two_halves(kWidth, kHeight);
  const Denoised expected = denoised(test::noisy_film(limit, 0.25, 3));
  for (const double scale : {0x1p-400, 0x1p400}) {
    for (LinearRgb& value : limit) value = value * scale;
    const Denoised result = denoised(test::noisy_film(limit, 0.25 * scale, 3));
    for (LinearRgb& value : limit) value = value * (1 / scale);
    for (std::size_t i = 0; i < limit.size(); ++i) {
      EXPECT_EQ(result.picture.pixels[i], expected.picture.pixels[i] * scale);
    }
  }
}

}  // namespace
}  // namespace sdlc::render
