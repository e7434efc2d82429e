#include "render/hierarchy/binned_split.hpp"

#include "render/hierarchy/bins.hpp"

namespace sdlc::render {
namespace {

template <typename T>
BuildBox<T> box_of(std::span<const Primitive<T>> primitives) {
  BuildBox<T> box;
  for (const Primitive<T>& primitive : primitives) box.add(primitive.box());
  return box;
}

/// Both parts of a range that has been partitioned.
template <typename T>
std::array<Range<T>, 2> parts(const Range<T>& whole, const Bins<T>& bins, const Cut<T>& cut) {
  Range<T> below{.begin = whole.begin, .end = whole.begin, .box = {}};
  Range<T> above{.begin = whole.begin, .end = whole.end, .box = {}};
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    (bin < cut.bin ? below : above).box.add(bins.boxes[cut.axis][bin]);
    if (bin < cut.bin) below.end += bins.counts[cut.axis][bin];
  }
  above.begin = below.end;
  return {below, above};
}

/// Moves primitives in bins below the cut to the front; returns their number. Branchless: the
/// branch is unpredictable.
template <typename T>
std::size_t partition(std::span<Primitive<T>> primitives, const BinScale<T>& scale,
                      const Cut<T>& cut) {
  std::size_t below = 0;
  const T bin = static_cast<T>(cut.bin);
  for (Primitive<T>& place : primitives) {
    const bool is_below = scale.is_below(place, cut.axis, bin);
    const Primitive<T> primitive = place;
    place = primitives[below];
    primitives[below] = primitive;
    below += is_below;
  }
  return below;
}

}  // namespace

template <typename T>
std::array<Range<T>, 2> split_by_bins(std::span<Primitive<T>> all, const Range<T>& whole) {
  const auto primitives = all.subspan(whole.begin, whole.count());
  BuildBox<T> centroids;
  for (const Primitive<T>& primitive : primitives) centroids.add(primitive.centroids());
  const BinScale<T> scale(centroids);
  Bins<T> bins;
  for (const Primitive<T>& primitive : primitives)
    bins.add(primitive.box(), 1, scale.bins_of(primitive));
  const Cut<T> cut = best_cut(bins);
  if (!cut.exists()) return split_in_halves<T>(all, whole);
  partition(primitives, scale, cut);
  return parts(whole, bins, cut);
}

template <typename T>
std::array<Range<T>, 2> split_in_halves(std::span<const Primitive<T>> primitives,
                                        const Range<T>& whole) {
  const std::size_t half = whole.count() / 2, mid = whole.begin + half;
  return {Range<T>{.begin = whole.begin,
                   .end = mid,
                   .box = box_of<T>(primitives.subspan(whole.begin, half))},
          Range<T>{.begin = mid,
                   .end = whole.end,
                   .box = box_of<T>(primitives.subspan(mid, whole.end - mid))}};
}

template std::array<Range<float>, 2> split_by_bins(std::span<Primitive<float>>,
                                                   const Range<float>&);
template std::array<Range<double>, 2> split_by_bins(std::span<Primitive<double>>,
                                                    const Range<double>&);
template std::array<Range<float>, 2> split_in_halves(std::span<const Primitive<float>>,
                                                     const Range<float>&);
template std::array<Range<double>, 2> split_in_halves(std::span<const Primitive<double>>,
                                                      const Range<double>&);

}  // namespace sdlc::render
