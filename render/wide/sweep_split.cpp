#include "render/wide/sweep_split.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

namespace sdlc::render {

/// A place to split a group: along an axis, before so many members.
template <typename T>
struct SweepSplitter<T>::Cut {
  std::size_t axis, below;
  T cost = std::numeric_limits<T>::infinity();
};

template <typename T>
SweepSplitter<T>::SweepSplitter(std::span<const Member<T>> members) : members_(members) {
  static_assert(kMostSwept <= 256, "a place takes a byte");
  for (auto& order : orders_) order.reset(new std::uint8_t[members.size()]);
}

/// Finds the rank of each member by holding it against all others, eight at a time: half as long as
/// a sort of so few takes. Of equal ones the earlier comes first.
template <typename T>
void SweepSplitter<T>::sort(Group<T>& group) {
  using Count = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
  using Counts __attribute__((vector_size(16))) = Count;
  using Part = typename Axes<T>::Part;
  constexpr std::size_t kAtATime = 8, kLanes = Axes<T>::kLanes, kParts = kAtATime / kLanes;
  // From the place 7 − k on: the truth, which is −1, for those behind the k-th.
  static constexpr Count kBehind[2 * kAtATime] = {0,  0,  0,  0,  0,  0,  0,  0,
                                                  -1, -1, -1, -1, -1, -1, -1, -1};
  const std::size_t count = group.count();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<T, kMostSwept> middles;
    for (std::size_t i = 0; i < count; ++i) middles[i] = members_[group.begin + i].middle(axis);
    std::fill(middles.begin() + count, middles.end(), T{0});
    std::uint8_t* order = orders_[axis].get() + group.begin;
    for (std::size_t i = 0; i < count; i += kAtATime) {
      Part own[kParts];
      std::memcpy(own, middles.data() + i, sizeof own);
      Counts rank[kParts]{};
      for (std::size_t k = 0; k < i; ++k) {
        for (std::size_t p = 0; p < kParts; ++p) rank[p] -= middles[k] <= own[p];
      }
      const std::size_t end = std::min(count, i + kAtATime);
      for (std::size_t k = i; k < end; ++k) {
        Counts behind[kParts];
        std::memcpy(behind, kBehind + (kAtATime - 1 - (k - i)), sizeof behind);
        for (std::size_t p = 0; p < kParts; ++p) {
          rank[p] -= (middles[k] < own[p]) | ((middles[k] == own[p]) & behind[p]);
        }
      }
      for (std::size_t k = end; k < count; ++k) {
        for (std::size_t p = 0; p < kParts; ++p) rank[p] -= middles[k] < own[p];
      }
      for (std::size_t k = i; k < end; ++k) {
        order[rank[(k - i) / kLanes][(k - i) % kLanes]] = static_cast<std::uint8_t>(k);
      }
    }
  }
  group.sorted_from = group.begin;
}

template <typename T>
void SweepSplitter<T>::find_cut(const Group<T>& whole, std::size_t axis, Cut& best) const {
  const Member<T>* members = members_.data() + whole.sorted_from;
  const std::uint8_t* order = orders_[axis].get() + whole.begin;
  const std::size_t count = whole.count();
  // Of what comes before a place, and of what comes from there on.
  std::array<T, kMostSwept> below, above;
  BuildBox<T> from_below, from_above;
  for (std::size_t i = 1; i < count; ++i) {
    from_below.add(members[order[i - 1]].box());
    below[i] = from_below.half_area();
    from_above.add(members[order[count - i]].box());
    above[count - i] = from_above.half_area();
  }
  for (std::size_t i = 1; i < count; ++i) {
    const T cost = below[i] * leaf_cost<T>(i) + above[i] * leaf_cost<T>(count - i);
    if (cost < best.cost) best = {.axis = axis, .below = i, .cost = cost};
  }
}

template <typename T>
std::array<Group<T>, 2> SweepSplitter<T>::split(const Group<T>& unsorted) {
  Group<T> whole = unsorted;
  if (!whole.is_sorted()) sort(whole);
  Cut best{.axis = 0, .below = whole.count() / 2};
  for (std::size_t axis = 0; axis < 3; ++axis) find_cut(whole, axis, best);
  return split_at(whole, best);
}

template <typename T>
std::array<Group<T>, 2> SweepSplitter<T>::split_in_halves(const Group<T>& whole) {
  return split_at(whole, {.axis = 0, .below = whole.count() / 2});
}

template <typename T>
std::array<Group<T>, 2> SweepSplitter<T>::split_at(const Group<T>& whole, const Cut& cut) {
  const std::size_t count = whole.count(), middle = whole.begin + cut.below;
  const std::size_t from = whole.sorted_from;
  std::array<Group<T>, 2> parts{
      Group<T>{.begin = whole.begin, .end = middle, .box = {}, .sorted_from = from},
      Group<T>{.begin = middle, .end = whole.end, .box = {}, .sorted_from = from}};
  std::array<bool, kMostSwept> is_above;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t member = orders_[cut.axis][whole.begin + i];
    is_above[member] = i >= cut.below;
    parts[i >= cut.below].box.add(members_[from + member].box());
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis == cut.axis) continue;
    std::uint8_t* order = orders_[axis].get() + whole.begin;
    std::array<std::uint8_t, kMostSwept> sorted;
    std::array<std::size_t, 2> next{0, cut.below};
    for (std::size_t i = 0; i < count; ++i) sorted[next[is_above[order[i]]]++] = order[i];
    std::copy_n(sorted.begin(), count, order);
  }
  return parts;
}

template class SweepSplitter<float>;
template class SweepSplitter<double>;

}  // namespace sdlc::render
