#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "render/wide/bvh_members.hpp"

/// The places at which a group may be split by the surface area heuristic: a few along each axis,
/// between bins (Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007).
namespace sdlc::render {

inline constexpr std::size_t kBins = 16;  // along each axis

/// Which bin a member belongs to along each axis.
template <typename T>
class BinScale {
 public:
  explicit BinScale(const BuildBox<T>& middles) {
    const auto scale = [&](std::size_t axis) {
      const T of_axis = T{kBins} / (middles.high(axis) - middles.low(axis));
      // Where there is next to nothing between the middles, all are in the first bin.
      return std::isfinite(of_axis) ? of_axis : 0;
    };
    low_ = {middles.low(0), middles.low(1), middles.low(2), 0};
    scale_ = {scale(0), scale(1), scale(2), 0};
  }

  std::array<std::size_t, 3> bins_of(const Member<T>& member) const noexcept {
    constexpr T kLast = kBins - 1;
    const Axes<T> place =
        least((member.middles().lows - low_) * scale_, Axes<T>(kLast, kLast, kLast, kLast));
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

  /// Whether that along an axis is less than `bin`.
  bool is_below(const Member<T>& member, std::size_t axis, T bin) const noexcept {
    return (member.middle(axis) - low_[axis]) * scale_[axis] < bin;
  }

 private:
  Axes<T> low_, scale_;  // the last ones make 0 of what means nothing
};

/// How many members are in each bin, and the box around them.
template <typename T>
struct Bins {
  std::array<std::array<BuildBox<T>, kBins>, 3> boxes;
  std::array<std::array<std::uint32_t, kBins>, 3> counts{};

  /// Members in a box, and along each axis in a bin.
  void add(const BuildBox<T>& box, std::uint32_t count,
           const std::array<std::size_t, 3>& bin) noexcept {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      boxes[axis][bin[axis]].add(box);
      counts[axis][bin[axis]] += count;
    }
  }
};

/// A place to split a group: before a bin.
template <typename T>
struct Cut {
  std::size_t axis = 0, bin = 0;
  T cost = std::numeric_limits<T>::infinity();

  bool exists() const noexcept { return bin > 0; }
};

/// The best place along an axis, if it is better than `best`.
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
