#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "render/wide/bvh_members.hpp"

namespace sdlc::render {

/// Splits small groups by the surface area heuristic, at any place along any axis. Members stay
/// where they are: what is split is their order along each axis, which is found once for a group
/// and handed down to its parts. Threads may work on different groups at a time.
template <typename T>
class SweepSplitter {
 public:
  static constexpr std::size_t kMostSwept = 64;

  explicit SweepSplitter(std::span<const Member<T>> members);

  /// Both parts of a group of 2 to kMostSwept members.
  std::array<Group<T>, 2> split(const Group<T>& unsorted);
  /// The first half along x and the second one, of a group that is sorted.
  std::array<Group<T>, 2> split_in_halves(const Group<T>& whole);

  /// The sphere at a place within a group, sorted or not.
  std::uint32_t sphere_at(const Group<T>& group, std::size_t place) const noexcept {
    if (!group.is_sorted()) return members_[place].sphere();
    return members_[group.sorted_from + orders_[0][place]].sphere();
  }

 private:
  struct Cut;

  void sort(Group<T>& group);
  void find_cut(const Group<T>& whole, std::size_t axis, Cut& best) const;
  std::array<Group<T>, 2> split_at(const Group<T>& whole, const Cut& cut);

  std::span<const Member<T>> members_;
  /// Along each axis, for each place the member that comes there, counted from Group::sorted_from.
  std::array<std::unique_ptr<std::uint8_t[]>, 3> orders_;  // NOLINT: not initialised
};

extern template class SweepSplitter<float>;
extern template class SweepSplitter<double>;

}  // namespace sdlc::render
