#include "render/compare/difference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

namespace sdlc::render {
namespace {

/// Keeps nearly black pixels from dominating the mean, as in the paper.
constexpr double kMinSquare = 0.01;

/// The mean without the largest 1 % of values. Takes `values` by value because it reorders them.
double trimmed_mean(std::vector<double> values) {
  const std::size_t kept = values.size() - values.size() / 100;
  const auto end = values.begin() + static_cast<std::ptrdiff_t>(kept);
  if (kept < values.size()) std::nth_element(values.begin(), end, values.end());
  return std::accumulate(values.begin(), end, 0.0) / static_cast<double>(kept);
}

}  // namespace

Difference measure_difference(const Picture& picture, const Picture& reference) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto width = static_cast<std::size_t>(picture.width);
  const std::size_t pixels = picture.pixels.size();
  const double values = 3 * static_cast<double>(pixels);
  double squares = 0, reference_sum = 0;
  std::vector<double> relative(pixels);  // per pixel: mean over the channels
  LargestDifference largest;
  for (std::size_t i = 0; i < pixels; ++i) {
    const LinearRgb p = picture.pixels[i], r = reference.pixels[i];
    const LinearRgb difference = p - r;
    const std::array differences{difference.r, difference.g, difference.b};
    const std::array references{r.r, r.g, r.b};
    for (std::size_t c = 0; c < 3; ++c) {
      const double square = differences[c] * differences[c];
      squares += square;
      relative[i] += square / (references[c] * references[c] + kMinSquare) / 3;
      reference_sum += references[c];
      if (std::abs(differences[c]) > std::abs(largest.value)) {
        largest = {.value = differences[c],
                   .x = static_cast<int>(i % width),
                   .y = static_cast<int>(i / width),
                   .channel = static_cast<int>(c)};
      }
    }
  }
  Difference result{.rmse = std::sqrt(squares / values), .largest = largest};
  const double mean = reference_sum / values;
  result.relative_error = result.rmse == 0 ? 0 : mean > 0 ? result.rmse / mean : kInfinity;
  result.relative_mse =
      std::accumulate(relative.begin(), relative.end(), 0.0) / static_cast<double>(pixels);
  result.psnr = result.rmse == 0 ? kInfinity : -20 * std::log10(result.rmse);
  result.trimmed_relative_mse = trimmed_mean(std::move(relative));
  return result;
}

}  // namespace sdlc::render
