#include "render/compare/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "render/math/color.hpp"
#include "render/parallel/parallel_for.hpp"

// Constants are named as in the paper and its supplement. Where these are ambiguous, this follows
// the published program, version 1.x: borders repeat, filters are cut at three standard deviations
// and normalised there, and the largest colour difference is the one between green and blue.
namespace sdlc::render {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Linear sRGB to XYZ with the D65 white point, as exact fractions.
constexpr Matrix kRgbToXyz{{{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                            {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                            {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}}};

/// Divides each row by its sum, so that white is (1, 1, 1). Every later step is relative to white.
constexpr Matrix relative_to_white(Matrix m) noexcept {
  for (auto& row : m) {
    const double white = row[0] + row[1] + row[2];
    for (double& v : row) v /= white;
  }
  return m;
}

constexpr Matrix inverse(const Matrix& m) noexcept {
  const auto minor = [&](int i, int j) {
    const int r = (i + 1) % 3, s = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[r][c] * m[s][d] - m[r][d] * m[s][c];
  };
  const double det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  Matrix result{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result[i][j] = minor(j, i) / det;
  }
  return result;
}

constexpr Matrix kToXyz = relative_to_white(kRgbToXyz);
constexpr Matrix kFromXyz = inverse(kToXyz);

constexpr std::array<double, 3> times(const Matrix& m, double a, double b, double c) noexcept {
  return {m[0][0] * a + m[0][1] * b + m[0][2] * c, m[1][0] * a + m[1][1] * b + m[1][2] * c,
          m[2][0] * a + m[2][1] * b + m[2][2] * c};
}

/// The opponent space YCxCz without its scale, which linear filters do not depend on.
struct Opponent {
  double luminance, red_green, blue_yellow;  // y, x - y, y - z
};

double shown(double v) noexcept { return std::clamp(v, 0.0, 1.0); }

Opponent to_opponent(LinearRgb c) noexcept {
  const auto [x, y, z] = times(kToXyz, shown(c.r), shown(c.g), shown(c.b));
  return {y, x - y, y - z};
}

/// CIELAB with the Hunt effect: dark colours count less.
struct HuntLab {
  double l, a, b;
};

HuntLab to_hunt_lab(double red, double green, double blue) noexcept {
  const auto f = [](double t) {
    constexpr double kDelta = 6.0 / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
  };
  const auto [x, y, z] = times(kToXyz, red, green, blue);
  const double fx = f(x), fy = f(y), fz = f(z);
  const double l = 116 * fy - 16;
  return {l, 0.01 * l * 500 * (fx - fy), 0.01 * l * 200 * (fy - fz)};
}

/// A filtered colour can be outside the gamut of a display; it is clamped.
HuntLab to_hunt_lab(const Opponent& c) noexcept {
  const double y = c.luminance;
  const auto [r, g, b] = times(kFromXyz, y + c.red_green, y, y - c.blue_yellow);
  return to_hunt_lab(shown(r), shown(g), shown(b));
}

double hyab(const HuntLab& p, const HuntLab& q) noexcept {
  const double a = p.a - q.a, b = p.b - q.b;
  return std::abs(p.l - q.l) + std::sqrt(a * a + b * b);
}

/// A colour difference relative to the largest one, compressed so that small differences get most
/// of the range.
class ColorDifference {
 public:
  ColorDifference() : max_(std::pow(hyab(to_hunt_lab(0, 1, 0), to_hunt_lab(0, 0, 1)), kQc)) {}

  double operator()(const HuntLab& p, const HuntLab& q) const noexcept {
    constexpr double kPc = 0.4, kPt = 0.95;
    const double distance = hyab(p, q);
    if (distance == 0) return 0;
    const double error = std::pow(distance, kQc);
    const double knee = kPc * max_;
    return error < knee ? kPt / knee * error : kPt + (error - knee) / (max_ - knee) * (1 - kPt);
  }

 private:
  static constexpr double kQc = 0.7;
  double max_;
};

/// The weights of a one-dimensional filter; the middle one applies to the pixel itself.
struct Taps {
  std::vector<double> weights;

  int radius() const noexcept { return static_cast<int>(weights.size() / 2); }
};

template <typename Weight>
Taps make_taps(int radius, Weight weight) {
  Taps taps;
  for (int i = -radius; i <= radius; ++i) taps.weights.push_back(weight(i));
  return taps;
}

Taps with_sum_one(Taps taps) {
  const double sum = std::accumulate(taps.weights.begin(), taps.weights.end(), 0.0);
  for (double& w : taps.weights) w /= sum;
  return taps;
}

/// Scales the weights so that the positive ones sum to 1 and the negative ones to -1. The signs do
/// not depend on the other dimension, so this is also the normalisation in two dimensions.
Taps with_balanced_sums(Taps taps) {
  double positive = 0, negative = 0;
  for (const double w : taps.weights) (w > 0 ? positive : negative) += std::abs(w);
  for (double& w : taps.weights) w /= w > 0 ? positive : negative;
  return taps;
}

/// All filters. Each is separable: a product of two one-dimensional filters.
struct Filters {
  // Contrast sensitivity: a Gaussian each for luminance and red-green, a sum of two for
  // blue-yellow.
  Taps luminance, red_green, blue_yellow_wide, blue_yellow_narrow;
  double wide_share = 0;  ///< of the wide Gaussian in that sum
  // Feature detection: a Gaussian, its first derivative (edges) and its second one (points).
  Taps smooth, edge, point;

  explicit Filters(double pixels_per_degree) {
    constexpr double kPi2 = std::numbers::pi * std::numbers::pi;
    struct Gaussian {
      double a, b;
    };
    constexpr Gaussian kLuminance{1, 0.0047}, kRedGreen{1, 0.0053}, kWide{34.1, 0.04},
        kNarrow{13.5, 0.025};
    const int radius =
        static_cast<int>(std::ceil(3 * std::sqrt(kWide.b / (2 * kPi2)) * pixels_per_degree));
    const auto gaussian = [&](Gaussian g) {
      return make_taps(radius, [&](int i) {
        const double x = i / pixels_per_degree;
        return std::exp(-kPi2 * x * x / g.b);
      });
    };
    // The integral of a Gaussian in two dimensions, before the sum is normalised.
    const auto mass = [&](Gaussian g, const Taps& taps) {
      const double sum = std::accumulate(taps.weights.begin(), taps.weights.end(), 0.0);
      return g.a * std::sqrt(std::numbers::pi / g.b) * sum * sum;
    };
    const Taps wide = gaussian(kWide), narrow = gaussian(kNarrow);
    wide_share = mass(kWide, wide) / (mass(kWide, wide) + mass(kNarrow, narrow));
    luminance = with_sum_one(gaussian(kLuminance));
    red_green = with_sum_one(gaussian(kRedGreen));
    blue_yellow_wide = with_sum_one(wide);
    blue_yellow_narrow = with_sum_one(narrow);

    constexpr double kFeatureWidth =
        0.082;  // degrees from the peak of an edge filter to its trough
    const double deviation = 0.5 * kFeatureWidth * pixels_per_degree;
    const double variance = deviation * deviation;
    const int feature_radius = static_cast<int>(std::ceil(3 * deviation));
    const auto bell = [&](int i) { return std::exp(-i * i / (2 * variance)); };
    smooth = with_sum_one(make_taps(feature_radius, bell));
    edge = with_balanced_sums(make_taps(feature_radius, [&](int i) { return -i * bell(i); }));
    point = with_balanced_sums(
        make_taps(feature_radius, [&](int i) { return (i * i / variance - 1) * bell(i); }));
  }

  int radius() const noexcept { return std::max(luminance.radius(), smooth.radius()); }
};

/// Several rows with one value per pixel.
class Rows {
 public:
  Rows(int width, int height)
      : width_(static_cast<std::size_t>(width)),
        values_(width_ * static_cast<std::size_t>(height)) {}

  std::span<double> operator[](int y) noexcept {
    return {values_.data() + static_cast<std::size_t>(y) * width_, width_};
  }
  std::span<const double> operator[](int y) const noexcept { return const_cast<Rows&>(*this)[y]; }

 private:
  std::size_t width_;
  std::vector<double> values_;
};

/// `padded` has `margin` more values than `result` on either side.
void filter_across(std::span<const double> padded, int margin, const Taps& taps,
                   std::span<double> result) noexcept {
  std::ranges::fill(result, 0);
  const double* source = padded.data() + margin - taps.radius();
  for (const double weight : taps.weights) {
    for (std::size_t x = 0; x < result.size(); ++x) result[x] += weight * source[x];
    ++source;
  }
}

void filter_down(const Rows& rows, int y, const Taps& taps, std::span<double> result) noexcept {
  std::ranges::fill(result, 0);
  int row = y - taps.radius();
  for (const double weight : taps.weights) {
    const std::span<const double> source = rows[row++];
    for (std::size_t x = 0; x < result.size(); ++x) result[x] += weight * source[x];
  }
}

/// A band of rows of a picture after the filters of human vision.
class BandView {
 public:
  /// Covers the rows [begin, end).
  BandView(const Picture& picture, const Filters& filters, int begin, int end)
      : filters_(filters),
        margin_(filters.radius()),
        luminance_(picture.width, end - begin + 2 * margin_),
        red_green_(luminance_),
        wide_(luminance_),
        narrow_(luminance_),
        smooth_(luminance_),
        edge_(luminance_),
        point_(luminance_) {
    const int padded_width = picture.width + 2 * margin_;
    Rows padded(padded_width, 3);
    for (int i = 0; i < end - begin + 2 * margin_; ++i) {
      const int y = std::clamp(begin + i - margin_, 0, picture.height - 1);
      for (int x = 0; x < padded_width; ++x) {
        const Opponent c =
            to_opponent(picture.at(std::clamp(x - margin_, 0, picture.width - 1), y));
        const auto at = static_cast<std::size_t>(x);
        padded[0][at] = c.luminance;
        padded[1][at] = c.red_green;
        padded[2][at] = c.blue_yellow;
      }
      filter_across(padded[0], margin_, filters.luminance, luminance_[i]);
      filter_across(padded[1], margin_, filters.red_green, red_green_[i]);
      filter_across(padded[2], margin_, filters.blue_yellow_wide, wide_[i]);
      filter_across(padded[2], margin_, filters.blue_yellow_narrow, narrow_[i]);
      filter_across(padded[0], margin_, filters.smooth, smooth_[i]);
      filter_across(padded[0], margin_, filters.edge, edge_[i]);
      filter_across(padded[0], margin_, filters.point, point_[i]);
    }
  }

  /// One filtered row: colours, and the strength of edges and points.
  struct Row {
    explicit Row(int width)
        : values(width, 8),
          colors(static_cast<std::size_t>(width)),
          edges(colors.size()),
          points(colors.size()) {}

    Rows values;
    std::vector<HuntLab> colors;
    std::vector<double> edges, points;
  };

  /// Computes row `y` of the band.
  void see(int y, Row& row) const noexcept {
    const int center = y + margin_;
    Rows& v = row.values;
    filter_down(luminance_, center, filters_.luminance, v[0]);
    filter_down(red_green_, center, filters_.red_green, v[1]);
    filter_down(wide_, center, filters_.blue_yellow_wide, v[2]);
    filter_down(narrow_, center, filters_.blue_yellow_narrow, v[3]);
    filter_down(edge_, center, filters_.smooth, v[4]);
    filter_down(smooth_, center, filters_.edge, v[5]);
    filter_down(point_, center, filters_.smooth, v[6]);
    filter_down(smooth_, center, filters_.point, v[7]);
    const double share = filters_.wide_share;
    for (std::size_t x = 0; x < row.colors.size(); ++x) {
      row.colors[x] = to_hunt_lab({v[0][x], v[1][x], share * v[2][x] + (1 - share) * v[3][x]});
      row.edges[x] = std::sqrt(v[4][x] * v[4][x] + v[5][x] * v[5][x]);
      row.points[x] = std::sqrt(v[6][x] * v[6][x] + v[7][x] * v[7][x]);
    }
  }

 private:
  const Filters& filters_;
  int margin_;  // rows above and below the band that the filters need
  Rows luminance_, red_green_, wide_, narrow_, smooth_, edge_, point_;  // filtered horizontally
};

}  // namespace

FlipMap flip(const Picture& picture, const Picture& reference, double pixels_per_degree) {
  // Rows that are filtered together: larger bands waste less on margins, smaller ones balance
  // better.
  constexpr int kBand = 32;
  const Filters filters(pixels_per_degree);
  const ColorDifference color_difference;
  const int width = picture.width, height = picture.height;
  FlipMap map{.width = width, .height = height, .values = {}};
  map.values.resize(picture.pixels.size());

  const auto compare_band = [&](int begin) {
    const int end = std::min(begin + kBand, height);
    const BandView view(picture, filters, begin, end), other(reference, filters, begin, end);
    BandView::Row row(width), other_row(width);
    for (int y = begin; y < end; ++y) {
      view.see(y - begin, row);
      other.see(y - begin, other_row);
      float* const values =
          map.values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
      for (std::size_t x = 0; x < row.colors.size(); ++x) {
        const double color = color_difference(row.colors[x], other_row.colors[x]);
        // The exponent of the paper, 0.5, is a square root.
        const double feature = std::sqrt(std::max(std::abs(row.edges[x] - other_row.edges[x]),
                                                  std::abs(row.points[x] - other_row.points[x])) /
                                         std::numbers::sqrt2);
        values[x] = static_cast<float>(color == 0 ? 0 : std::pow(color, 1 - feature));
      }
    }
  };
  const auto bands = static_cast<std::size_t>((height + kBand - 1) / kBand);
  parallel_for(bands, [&](std::size_t band) { compare_band(static_cast<int>(band) * kBand); });
  // Sum sequentially, so that rounding does not depend on the number of threads.
  map.mean = std::accumulate(map.values.begin(), map.values.end(), 0.0) /
             static_cast<double>(map.values.size());
  return map;
}

}  // namespace sdlc::render
