// The filter of one tile. Plain loops, which the compiler turns into vectors: compiled once per
// instruction set, so it has no include guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_DENOISE_FILTER_TILE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_DENOISE_FILTER_TILE_INL_H
#undef SDLC_RENDER_DENOISE_FILTER_TILE_INL_H
#else
#define SDLC_RENDER_DENOISE_FILTER_TILE_INL_H
#endif
// clang-format on

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include <hwy/highway.h>

#include "render/denoise/cross_filter.hpp"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

// Among some dozens of combinations those with the smallest errors in the examples. Twice or half
// of each changes the error by less than 5 %.
constexpr int kRadius = 5;          // of the pixels that are averaged
constexpr int kVarianceRadius = 1;  // of the pixels over which variances are averaged
constexpr float kStrength = 0.7f;   // the difference at which weights fall, in standard deviations
constexpr float kFeatures = 0.1f;   // likewise, the square of the difference of features
// Relative to the mean radiance, squared: differences of pixels without noise.
constexpr float kMinVariance = 1e-8f;

// Two replicates that decide on weights, and the two that are averaged with them.
struct Split {
  std::array<std::size_t, 2> guides, data;
};
constexpr std::array<Split, 6> kSplits{{{{0, 1}, {2, 3}},
                                        {{0, 2}, {1, 3}},
                                        {{0, 3}, {1, 2}},
                                        {{1, 2}, {0, 3}},
                                        {{1, 3}, {0, 2}},
                                        {{2, 3}, {0, 1}}}};

/// Values of the pixels of a tile and of those around it that its filter reads: at most 5 + 1
/// beyond each side.
class Around {
 public:
  static constexpr int kMargin = kRadius + 1;
  static constexpr int kSide = kFilterTile + 2 * kMargin;

  /// `value_of(x, y)`: of the pixel (x, y) of the tile.
  template <typename ValueOf>
  void fill(int width, int height, const ValueOf& value_of) {
    for (int y = -kMargin; y < height + kMargin; ++y) {
      for (int x = -kMargin; x < width + kMargin; ++x) row(y)[x] = value_of(x, y);
    }
  }
  /// The pixel (0, y).
  float* row(int y) noexcept { return values_.data() + (y + kMargin) * kSide + kMargin; }
  const float* row(int y) const noexcept { return const_cast<Around&>(*this).row(y); }

 private:
  std::array<float, kSide * kSide> values_;
};

/// Values of the pixels of a tile.
struct Inside {
  float* row(int y) noexcept { return values.data() + y * kFilterTile; }
  const float* row(int y) const noexcept { return values.data() + y * kFilterTile; }

  std::array<float, kFilterTile * kFilterTile> values{};
};

class TileFilter {
 public:
  TileFilter(const ReplicatePlanes& planes, const TileArea& area)
      : planes_(planes), area_(area), width_(area.x1 - area.x0), height_(area.y1 - area.y0) {
    for (std::size_t r = 0; r < kReplicates; ++r) {
      for (std::size_t c = 0; c < 3; ++c) copy(planes.means[r][c], means_[r][c]);
    }
    for (std::size_t f = 0; f < features_.size(); ++f) copy(planes.features[f], features_[f]);
    for (std::size_t i = 0; i < kSplits.size(); ++i) {
      const auto [a, b] = kSplits[i].guides;
      for (std::size_t c = 0; c < 3; ++c) {
        guides_[i][c].fill(width_, height_, [&, a = a, b = b](int x, int y) {
          return 0.5f * (means_[a][c].row(y)[x] + means_[b][c].row(y)[x]);
        });
      }
      smooth([&, a = a, b = b](std::size_t pixel) { return guide_variance(a, b, pixel); },
             guide_variances_[i]);
    }
    smooth([&](std::size_t pixel) { return variance(pixel); }, variances_);
  }

  std::vector<FilteredPixel> run() {
    for (int dy = -kRadius; dy <= kRadius; ++dy) {
      for (int dx = -kRadius; dx <= kRadius; ++dx) add_neighbours(dx, dy);
    }
    return result();
  }

 private:
  /// The pixel (x, y) of the tile, or the nearest one of the picture.
  std::size_t nearest(int x, int y) const noexcept {
    return planes_.index(std::clamp(x + area_.x0, 0, planes_.width - 1),
                         std::clamp(y + area_.y0, 0, planes_.height - 1));
  }
  void copy(const std::vector<float>& from, Around& to) const {
    to.fill(width_, height_, [&](int x, int y) { return from[nearest(x, y)]; });
  }
  /// Means of `value_of(pixel)` over the pixels around each one.
  template <typename ValueOf>
  void smooth(const ValueOf& value_of, Around& to) const {
    constexpr int kSide = 2 * kVarianceRadius + 1;
    to.fill(width_, height_, [&](int x, int y) {
      float sum = 0;
      for (int v = -kVarianceRadius; v <= kVarianceRadius; ++v) {
        for (int u = -kVarianceRadius; u <= kVarianceRadius; ++u) {
          sum += value_of(nearest(x + u, y + v));
        }
      }
      return sum / (kSide * kSide);
    });
  }
  /// An estimate of the variance of the mean of two replicates, summed over channels.
  float guide_variance(std::size_t a, std::size_t b, std::size_t pixel) const noexcept {
    float squares = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const float d = planes_.means[a][c][pixel] - planes_.means[b][c][pixel];
      squares += d * d;
    }
    return squares / 4;
  }
  /// An estimate of the variance of one replicate, summed over channels.
  float variance(std::size_t pixel) const noexcept {
    float squares = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      float mean = 0;
      for (const auto& replicate : planes_.means) mean += replicate[c][pixel] / kReplicates;
      for (const auto& replicate : planes_.means) {
        const float d = replicate[c][pixel] - mean;
        squares += d * d;
      }
    }
    return squares / (kReplicates - 1);
  }

  /// Adds the neighbours at (dx, dy) of all pixels to their sums.
  void add_neighbours(int dx, int dy) {
    // The pixels that have this neighbour.
    const int x0 = std::max(0, -dx - area_.x0), y0 = std::max(0, -dy - area_.y0);
    const int x1 = std::min(width_, planes_.width - area_.x0 - dx),
              y1 = std::min(height_, planes_.height - area_.y0 - dy);
    if (x0 >= x1 || y0 >= y1) return;
    const std::ptrdiff_t shift = dy * Around::kSide + dx;
    for (int y = y0; y < y1; ++y) measure_features(y, x0, x1, shift);
    for (std::size_t i = 0; i < kSplits.size(); ++i) {
      for (int y = y0 - 1; y < y1 + 1; ++y) measure_guides(i, y, x0, x1, shift);
      for (int y = y0; y < y1; ++y) {
        weigh(y, x0, x1);
        add_weighted(i, y, x0, x1, shift);
      }
    }
  }

  void measure_features(int y, int x0, int x1, std::ptrdiff_t shift) {
    float* out = feature_distances_.row(y);
    std::fill(out + x0, out + x1, 0.f);
    for (const Around& feature : features_) {
      const float* values = feature.row(y);
      for (int x = x0; x < x1; ++x) {
        const float d = values[x] - values[x + shift];
        out[x] += d * d * (1 / kFeatures);
      }
    }
  }

  /// Sums of three distances each: of a pixel and of those to its left and right.
  void measure_guides(std::size_t split, int y, int x0, int x1, std::ptrdiff_t shift) {
    const float *red = guides_[split][0].row(y), *green = guides_[split][1].row(y),
                *blue = guides_[split][2].row(y), *variance = guide_variances_[split].row(y);
    std::array<float, kFilterTile + 2> distances;
    for (int x = x0 - 1; x < x1 + 1; ++x) {
      const float r = red[x] - red[x + shift], g = green[x] - green[x + shift],
                  b = blue[x] - blue[x + shift];
      const float own = variance[x], other = variance[x + shift];
      // Less what noise alone makes of the squares. A bright pixel of much variance does not count
      // as equal to pixels of little variance.
      distances[static_cast<std::size_t>(x + 1)] =
          (r * r + g * g + b * b - own - std::min(own, other)) /
          (kMinVariance + kStrength * kStrength * (own + other));
    }
    float* out = guide_distances_.data() + (y + 1) * kFilterTile;
    for (int x = x0; x < x1; ++x) {
      const float* of = distances.data() + x;
      out[x] = of[0] + of[1] + of[2];
    }
  }

  void weigh(int y, int x0, int x1) {
    const float* guides = guide_distances_.data() + y * kFilterTile;
    const float* features = feature_distances_.row(y);
    for (int x = x0; x < x1; ++x) {
      const float sum = guides[x] + guides[x + kFilterTile] + guides[x + 2 * kFilterTile];
      const float distance = std::max(0.f, sum / 9) + features[x];
      // About e^−distance, and 0 from a distance of 8 on.
      float weight = std::max(0.f, 1 - distance / 8);
      weight *= weight;
      weight *= weight;
      weights_[static_cast<std::size_t>(x)] = weight * weight;
    }
  }

  void add_weighted(std::size_t split, int y, int x0, int x1, std::ptrdiff_t shift) {
    Sums& sums = sums_[split];
    const float* w = weights_.data();
    float *weight = sums.weight.row(y), *variance = sums.variance.row(y);
    const float* variances = variances_.row(y) + shift;
    for (int x = x0; x < x1; ++x) {
      weight[x] += w[x];
      variance[x] += w[x] * w[x] * variances[x];
    }
    for (std::size_t d = 0; d < 2; ++d) {
      for (std::size_t c = 0; c < 3; ++c) {
        float* out = sums.values[d][c].row(y);
        const float* in = means_[kSplits[split].data[d]][c].row(y) + shift;
        for (int x = x0; x < x1; ++x) out[x] += w[x] * in[x];
      }
    }
  }

  std::vector<FilteredPixel> result() const {
    std::vector<FilteredPixel> pixels;
    pixels.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        FilteredPixel& pixel = pixels.emplace_back();
        pixel.variance = variances_.row(y)[x];
        for (std::size_t i = 0; i < kSplits.size(); ++i) {
          const Sums& sums = sums_[i];
          const float share = 1 / sums.weight.row(y)[x];
          pixel.own_weight += share / kSplits.size();
          pixel.filtered_variance += sums.variance.row(y)[x] * share * share / kSplits.size();
          for (std::size_t d = 0; d < 2; ++d) {
            std::array<float, 3>& without = pixel.without[kSplits[i].data[1 - d]];
            for (std::size_t c = 0; c < 3; ++c) {
              without[c] += sums.values[d][c].row(y)[x] * share / (kReplicates - 1);
            }
          }
        }
      }
    }
    return pixels;
  }

  struct Sums {
    Inside weight, variance;
    std::array<std::array<Inside, 3>, 2> values;  // by replicate of Split::data and channel
  };

  const ReplicatePlanes& planes_;
  TileArea area_;
  int width_, height_;
  std::array<std::array<Around, 3>, kReplicates> means_;
  std::array<Around, 6> features_;
  std::array<std::array<Around, 3>, kSplits.size()> guides_;
  std::array<Around, kSplits.size()> guide_variances_;
  Around variances_;
  // Of one offset.
  Inside feature_distances_;
  std::array<float, kFilterTile*(kFilterTile + 2)> guide_distances_;  // from row -1 on
  std::array<float, kFilterTile> weights_;
  std::array<Sums, kSplits.size()> sums_;
};

std::vector<FilteredPixel> filter_tile(const ReplicatePlanes& planes, const TileArea& area) {
  return std::make_unique<TileFilter>(planes, area)->run();
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
