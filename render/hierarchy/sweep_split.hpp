#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "render/hierarchy/build_primitives.hpp"

namespace sdlc::render {

/// Sweep builder: splits small ranges by the surface area heuristic at any position along any axis.
/// Primitives stay in place; only their order along each axis is split, which is computed once per
/// range and inherited by its parts. Threads may work on different ranges at the same time.
template <typename T>
class SweepSplitter {
 public:
  static constexpr std::size_t kMaxSwept = 64;

  explicit SweepSplitter(std::span<const Primitive<T>> primitives);

  /// Splits a range of 2 to kMaxSwept primitives.
  std::array<Range<T>, 2> split(const Range<T>& unsorted);
  /// Splits a sorted range into its first and second half along x.
  std::array<Range<T>, 2> split_in_halves(const Range<T>& whole);

  /// The sphere at a position within a range, sorted or not.
  std::uint32_t sphere_at(const Range<T>& range, std::size_t place) const noexcept {
    if (!range.is_sorted()) return primitives_[place].sphere();
    return primitives_[range.sorted_from + orders_[0][place]].sphere();
  }

 private:
  struct Cut;

  void sort(Range<T>& range);
  void find_cut(const Range<T>& whole, std::size_t axis, Cut& best) const;
  std::array<Range<T>, 2> split_at(const Range<T>& whole, const Cut& cut);

  std::span<const Primitive<T>> primitives_;
  /// Per axis and position, the index of the primitive there, relative to Range::sorted_from.
  std::array<std::unique_ptr<std::uint8_t[]>, 3> orders_;  // NOLINT: not initialised
};

extern template class SweepSplitter<float>;
extern template class SweepSplitter<double>;

}  // namespace sdlc::render
