#include "render/denoise/denoise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "render/denoise/cross_filter.hpp"
#include "render/parallel/parallel_for.hpp"

namespace sdlc::render {
namespace {

std::array<double, 3> channels(LinearRgb c) noexcept { return {c.r, c.g, c.b}; }

template <typename Body>
void for_each(int count, const Body& body) {
  parallel_for(static_cast<std::size_t>(count), [&](std::size_t i) { body(static_cast<int>(i)); });
}

/// `scale`: of radiance.
ReplicatePlanes planes_of(const Film& film, std::span<const PixelFeatures> features, int width,
                          int height, double scale) {
  ReplicatePlanes planes{.width = width, .height = height, .means = {}, .features = {}};
  for (auto& replicate : planes.means) {
    for (auto& plane : replicate) plane.resize(film.size());
  }
  for (auto& plane : planes.features) plane.resize(film.size());
  for_each(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t pixel = planes.index(x, y);
      for (std::uint32_t r = 0; r < kReplicates; ++r) {
        const auto values = channels(film.mean(pixel, r) * scale);
        for (std::size_t c = 0; c < 3; ++c) {
          planes.means[r][c][pixel] = static_cast<float>(values[c]);
        }
      }
      const PixelFeatures& of = features[pixel];
      const std::array values{of.normal.x, of.normal.y, of.normal.z,
                              of.albedo.r, of.albedo.g, of.albedo.b};
      for (std::size_t f = 0; f < values.size(); ++f) {
        planes.features[f][pixel] = static_cast<float>(values[f]);
      }
    }
  });
  return planes;
}

double square(double v) noexcept { return v * v; }

}  // namespace

Denoised denoise(CrossFilter& filter, const Film& film, std::span<const PixelFeatures> features,
                 std::span<const PixelSpread> spreads, int width, int height) {
  Denoised denoised{.picture = Picture(width, height), .errors = {}};
  denoised.errors.resize(film.size());
  double total = 0;
  for (std::size_t i = 0; i < film.size(); ++i) {
    for (const double value : channels(film.mean(i))) total += value;
  }
  const double unit = total / (3 * static_cast<double>(film.size()));
  const ReplicatePlanes planes = planes_of(film, features, width, height, 1 / unit);

  const auto finish = [&](std::size_t pixel, const FilteredPixel& filtered) {
    std::array<double, 3> value{};
    double distance = 0, variance = 0, disagreement = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      double mean = 0;
      for (std::size_t r = 0; r < kReplicates; ++r) {
        value[c] += filtered.without[r][c] / kReplicates;
        mean += planes.means[r][c][pixel] / double{kReplicates};
      }
      for (std::size_t r = 0; r < kReplicates; ++r) {
        const double x = planes.means[r][c][pixel], f = filtered.without[r][c];
        distance += square(f - x) / kReplicates;
        disagreement += square(f - value[c]) / kReplicates;
        variance += square(x - mean) / (kReplicates - 1);
      }
    }
    denoised.picture.pixels[pixel] = LinearRgb{value[0], value[1], value[2]} * unit;
    DenoisedError& error = denoised.errors[pixel];
    const double squared_error = distance - variance - disagreement;
    const double own = filtered.own_weight, around = filtered.variance;
    const double noise = filtered.filtered_variance;
    const double others = noise - own * own * around;
    const double bias = squared_error - noise / 4;
    error.squared_error = squared_error;
    error.noise = noise / 4;
    error.variance_of_noise = square(spreads[pixel].covariance / unit / unit * (1 - 2 * own)) / 6 +
                              4 * around * std::max(others, 0.0) / 6;
    error.variance = error.variance_of_noise + around * bias;
  };
  const int columns = (width + kFilterTile - 1) / kFilterTile,
            rows = (height + kFilterTile - 1) / kFilterTile;
  for_each(columns * rows, [&](int tile) {
    const int x0 = tile % columns * kFilterTile, y0 = tile / columns * kFilterTile;
    const int x1 = std::min(x0 + kFilterTile, width), y1 = std::min(y0 + kFilterTile, height);
    const std::vector<FilteredPixel> pixels = filter(planes, {x0, y0, x1, y1});
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        finish(planes.index(x, y), pixels[static_cast<std::size_t>((y - y0) * (x1 - x0) + x - x0)]);
      }
    }
  });
  return denoised;
}

}  // namespace sdlc::render
