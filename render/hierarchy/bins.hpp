#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "render/hierarchy/build_primitives.hpp"

/// Binned surface area heuristic: a range may be split at a few positions along each axis, between
/// bins (Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007).
namespace sdlc::render {

inline constexpr std::size_t kBins = 16;  // along each axis

/// Maps a primitive to its bin along each axis.
template <typename T>
class BinScale {
 public:
  explicit BinScale(const BuildBox<T>& centroids) {
    const auto scale = [&](std::size_t axis) {
      const T of_axis = T{kBins} / (centroids.high(axis) - centroids.low(axis));
      // If the centroids almost coincide, all are in the first bin.
      return std::isfinite(of_axis) ? of_axis : 0;
    };
    low_ = {centroids.low(0), centroids.low(1), centroids.low(2), 0};
    scale_ = {scale(0), scale(1), scale(2), 0};
  }

  std::array<std::size_t, 3> bins_of(const Primitive<T>& primitive) const noexcept {
    constexpr T kLast = kBins - 1;
    const Axes<T> place = lanewise_min((primitive.centroids().lows - low_) * scale_,
                                       Axes<T>(kLast, kLast, kLast, kLast));
    const auto bin = [](auto of_axis) {
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(of_axis));
    };
    if constexpr (Axes<T>::kParts == 1) {
      using Bins __attribute__((vector_size(16))) = std::int32_t;
      const auto bins = __builtin_convertvector(place.parts[0], Bins);
      return {bin(bins[0]), bin(bins[1]), bin(bins[2])};
    }
    return {bin(place[0]), bin(place[1]), bin(place[2])};
  }

  /// Whether the bin along an axis is below `bin`.
  bool is_below(const Primitive<T>& primitive, std::size_t axis, T bin) const noexcept {
    return (primitive.centroid(axis) - low_[axis]) * scale_[axis] < bin;
  }

 private:
  Axes<T> low_, scale_;  // the last elements turn the unused lane into 0
};

/// The number of primitives in each bin, and their bounds.
template <typename T>
struct Bins {
  std::array<std::array<BuildBox<T>, kBins>, 3> boxes;
  std::array<std::array<std::uint32_t, kBins>, 3> counts{};

  /// Adds primitives with this bounding box to a bin along each axis.
  void add(const BuildBox<T>& box, std::uint32_t count,
           const std::array<std::size_t, 3>& bin) noexcept {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      boxes[axis][bin[axis]].add(box);
      counts[axis][bin[axis]] += count;
    }
  }
};

/// A position to split a range: before a bin.
template <typename T>
struct Cut {
  std::size_t axis = 0, bin = 0;
  T cost = std::numeric_limits<T>::infinity();

  bool exists() const noexcept { return bin > 0; }
};

/// Updates `best` if there is a better position along an axis.
template <typename T>
void find_cut(const Bins<T>& bins, std::size_t axis, Cut<T>& best) {
  const auto& boxes = bins.boxes[axis];
  const auto& counts = bins.counts[axis];
  std::array<T, kBins> cost_above{};
  BuildBox<T> above;
  std::size_t count = 0;
  for (std::size_t bin = kBins - 1; bin > 0; --bin) {
    above.add(boxes[bin]);
    count += counts[bin];
    cost_above[bin] = count > 0 ? above.half_area() * leaf_cost<T>(count) : 0;
  }
  if (count == 0) return;
  const std::size_t all = count + counts[0];
  BuildBox<T> below;
  count = 0;
  for (std::size_t bin = 1; bin < kBins; ++bin) {
    below.add(boxes[bin - 1]);
    count += counts[bin - 1];
    if (count == 0 || count == all) continue;
    const T cost = below.half_area() * leaf_cost<T>(count) + cost_above[bin];
    if (cost < best.cost) best = {.axis = axis, .bin = bin, .cost = cost};
  }
}

template <typename T>
Cut<T> best_cut(const Bins<T>& bins) {
  Cut<T> best;
  for (std::size_t axis = 0; axis < 3; ++axis) find_cut(bins, axis, best);
  return best;
}

}  // namespace sdlc::render
