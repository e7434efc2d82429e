#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "render/film/film.hpp"

namespace sdlc::test {

/// A picture without noise, by pixel, row by row.
using Limit = std::vector<render::LinearRgb>;

/// The left half is bright, the right half is dark; both have a texture of period 5.
inline Limit two_halves(int width, int height) {
  Limit limit;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double v = (2 * x < width ? 1.2 : 0.6) + 0.1 * ((x + 2 * y) % 5);
      limit.push_back({v, 0.8 * v, 0.5 * v});
    }
  }
  return limit;
}

/// A film with one sample in each replicate, which is normal around `limit`. `deviation`: of each
/// channel.
inline render::Film noisy_film(const Limit& limit, double deviation, unsigned seed) {
  using namespace render;
  Film film({.pixels = limit.size()});
  film.reserve(std::vector<ReplicateCounts>(limit.size(), split_in_replicates(kReplicates)));
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal(0, deviation);
  for (std::size_t pixel = 0; pixel < limit.size(); ++pixel) {
    for (std::uint32_t r = 0; r < kReplicates; ++r) {
      const double red = normal(engine), green = normal(engine), blue = normal(engine);
      std::array<LinearRgb, 2> values{limit[pixel] + LinearRgb{red, green, blue}};
      film.set(pixel, r, SampleSum(values, 0, 1));
    }
  }
  return film;
}

inline std::vector<render::PixelSpread> spreads_of(const render::Film& film) {
  std::vector<render::PixelSpread> spreads;
  for (std::size_t i = 0; i < film.size(); ++i) spreads.push_back(film.spread(i));
  return spreads;
}

}  // namespace sdlc::test
