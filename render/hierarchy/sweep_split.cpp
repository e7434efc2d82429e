#include "render/hierarchy/sweep_split.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

namespace sdlc::render {

/// A position to split a range: along an axis, before the primitive with this rank.
template <typename T>
struct SweepSplitter<T>::Cut {
  std::size_t axis, below;
  T cost = std::numeric_limits<T>::infinity();
};

template <typename T>
SweepSplitter<T>::SweepSplitter(std::span<const Primitive<T>> primitives)
    : primitives_(primitives) {
  static_assert(kMaxSwept <= 256, "a place takes a byte");
  for (auto& order : orders_) order.reset(new std::uint8_t[primitives.size()]);
}

/// Computes the rank of each primitive by comparing it with all others, eight at a time: half the
/// time of a sort at these sizes. Ties keep their order.
template <typename T>
void SweepSplitter<T>::sort(Range<T>& range) {
  using Count = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
  using Counts __attribute__((vector_size(16))) = Count;
  using Part = typename Axes<T>::Part;
  constexpr std::size_t kBatch = 8, kLanes = Axes<T>::kLanes, kParts = kBatch / kLanes;
  // From index 7 − k on: a mask (−1) of the elements after the k-th.
  static constexpr Count kAfter[2 * kBatch] = {0,  0,  0,  0,  0,  0,  0,  0,
                                               -1, -1, -1, -1, -1, -1, -1, -1};
  const std::size_t count = range.count();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<T, kMaxSwept> centroids;
    for (std::size_t i = 0; i < count; ++i)
      centroids[i] = primitives_[range.begin + i].centroid(axis);
    std::fill(centroids.begin() + count, centroids.end(), T{0});
    std::uint8_t* order = orders_[axis].get() + range.begin;
    for (std::size_t i = 0; i < count; i += kBatch) {
      Part own[kParts];
      std::memcpy(own, centroids.data() + i, sizeof own);
      Counts rank[kParts]{};
      for (std::size_t k = 0; k < i; ++k) {
        for (std::size_t p = 0; p < kParts; ++p) rank[p] -= centroids[k] <= own[p];
      }
      const std::size_t end = std::min(count, i + kBatch);
      for (std::size_t k = i; k < end; ++k) {
        Counts after[kParts];
        std::memcpy(after, kAfter + (kBatch - 1 - (k - i)), sizeof after);
        for (std::size_t p = 0; p < kParts; ++p) {
          rank[p] -= (centroids[k] < own[p]) | ((centroids[k] == own[p]) & after[p]);
        }
      }
      for (std::size_t k = end; k < count; ++k) {
        for (std::size_t p = 0; p < kParts; ++p) rank[p] -= centroids[k] < own[p];
      }
      for (std::size_t k = i; k < end; ++k) {
        order[rank[(k - i) / kLanes][(k - i) % kLanes]] = static_cast<std::uint8_t>(k);
      }
    }
  }
  range.sorted_from = range.begin;
}

template <typename T>
void SweepSplitter<T>::find_cut(const Range<T>& whole, std::size_t axis, Cut& best) const {
  const Primitive<T>* primitives = primitives_.data() + whole.sorted_from;
  const std::uint8_t* order = orders_[axis].get() + whole.begin;
  const std::size_t count = whole.count();
  // Half areas of the bounds before a position, and from there on.
  std::array<T, kMaxSwept> below, above;
  BuildBox<T> from_below, from_above;
  for (std::size_t i = 1; i < count; ++i) {
    from_below.add(primitives[order[i - 1]].box());
    below[i] = from_below.half_area();
    from_above.add(primitives[order[count - i]].box());
    above[count - i] = from_above.half_area();
  }
  for (std::size_t i = 1; i < count; ++i) {
    const T cost = below[i] * leaf_cost<T>(i) + above[i] * leaf_cost<T>(count - i);
    if (cost < best.cost) best = {.axis = axis, .below = i, .cost = cost};
  }
}

template <typename T>
std::array<Range<T>, 2> SweepSplitter<T>::split(const Range<T>& unsorted) {
  Range<T> whole = unsorted;
  if (!whole.is_sorted()) sort(whole);
  Cut best{.axis = 0, .below = whole.count() / 2};
  for (std::size_t axis = 0; axis < 3; ++axis) find_cut(whole, axis, best);
  return split_at(whole, best);
}

template <typename T>
std::array<Range<T>, 2> SweepSplitter<T>::split_in_halves(const Range<T>& whole) {
  return split_at(whole, {.axis = 0, .below = whole.count() / 2});
}

template <typename T>
std::array<Range<T>, 2> SweepSplitter<T>::split_at(const Range<T>& whole, const Cut& cut) {
  const std::size_t count = whole.count(), mid = whole.begin + cut.below;
  const std::size_t from = whole.sorted_from;
  std::array<Range<T>, 2> parts{
      Range<T>{.begin = whole.begin, .end = mid, .box = {}, .sorted_from = from},
      Range<T>{.begin = mid, .end = whole.end, .box = {}, .sorted_from = from}};
  std::array<bool, kMaxSwept> is_above;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t primitive = orders_[cut.axis][whole.begin + i];
    is_above[primitive] = i >= cut.below;
    parts[i >= cut.below].box.add(primitives_[from + primitive].box());
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis == cut.axis) continue;
    std::uint8_t* order = orders_[axis].get() + whole.begin;
    std::array<std::uint8_t, kMaxSwept> sorted;
    std::array<std::size_t, 2> next{0, cut.below};
    for (std::size_t i = 0; i < count; ++i) sorted[next[is_above[order[i]]]++] = order[i];
    std::copy_n(sorted.begin(), count, order);
  }
  return parts;
}

template class SweepSplitter<float>;
template class SweepSplitter<double>;

}  // namespace sdlc::render
