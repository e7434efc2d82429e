#include "render/exactness/curve_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include "render/exactness/near_pairs.hpp"
#include "render/parallel/ranges.hpp"

namespace sdlc::render {
namespace {

constexpr int kKeyBits = 32;

struct Entry {
  std::uint32_t key, sphere;
};
using Entries = std::unique_ptr<Entry[]>;  // NOLINT: not initialised

/// The exponent e of v = m · 2^e, 1 ≤ m < 2, plus a constant; 0 for subnormal numbers.
int biased_exponent(double v) noexcept {
  return static_cast<int>(std::bit_cast<std::uint64_t>(v) >> 52);
}

/// Size classes by powers of 8; class 0 is the largest, and the last one includes everything
/// smaller.
class Sizes {
 public:
  explicit Sizes(const Crowd& crowd)
      : largest_(biased_exponent(crowd.max_radius())),
        count_(std::min((largest_ - biased_exponent(crowd.min_radius())) / kStep + 1, kMaxCount)) {}

  int count() const noexcept { return count_; }
  int bits() const noexcept { return std::bit_width(static_cast<unsigned>(count_ - 1)); }
  int of(double radius) const noexcept {
    return std::min((largest_ - biased_exponent(radius)) / kStep, count_ - 1);
  }

 private:
  static constexpr int kMaxCount = 32, kStep = 3;

  int largest_, count_;
};

/// Maps positions to keys along the curve: numbers of bits() bits.
class Curve {
 public:
  Curve(const Crowd& crowd, const Sizes& sizes) : low_(crowd.centers().low) {
    std::array<double, 3> side;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      side[axis] = crowd.centers().high[axis] - low_[axis];
    }
    const std::array<double, 3> whole = side;
    std::array<int, kKeyBits> axis_of_bit{};
    bits_of_size_.assign(static_cast<std::size_t>(sizes.count()), 0);
    while (bits_ < kKeyBits - sizes.bits()) {
      const auto longest = std::max_element(side.begin(), side.end());
      double radius = crowd.max_radius() / 8;
      for (int& bits : bits_of_size_) {
        if (*longest > radius) bits = bits_ + 1;
        radius /= 8;
      }
      if (bits_of_size_.back() == bits_) break;
      axis_of_bit[static_cast<std::size_t>(bits_++)] = static_cast<int>(longest - side.begin());
      *longest /= 2;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) set_axis(axis, axis_of_bit, whole[axis]);
  }

  int bits() const noexcept { return bits_; }

  /// The key of a sphere of the given size class, with a resolution of about its radius.
  std::uint32_t place(Vec3 center, int size) const noexcept {
    const std::uint64_t place = along(0, center.x) | along(1, center.y) | along(2, center.z);
    const int unused = bits_ - bits_of_size_[static_cast<std::size_t>(size)];
    return static_cast<std::uint32_t>(place >> unused << unused);
  }

 private:
  static constexpr std::size_t kBytes = kKeyBits / 8;

  void set_axis(std::size_t axis, const std::array<int, kKeyBits>& axis_of_bit, double side) {
    std::array<std::uint32_t, kKeyBits> value{};  // of a bit of the coordinate
    std::size_t count = 0;
    for (int bit = bits_ - 1; bit >= 0; --bit) {
      if (axis_of_bit[static_cast<std::size_t>(bit)] != static_cast<int>(axis)) continue;
      value[count++] = 1U << (bits_ - 1 - bit);
    }
    const double cells = std::ldexp(1.0, static_cast<int>(count));
    last_[axis] = cells - 1;
    const double scale = cells / side;
    scale_[axis] = std::isfinite(scale) ? scale : 0;  // infinite if the extent is next to nothing
    for (std::size_t byte = 0; byte < kBytes; ++byte) {
      for (std::size_t number = 0; number < 256; ++number) {
        std::uint32_t& entry = spread_[axis][byte][number];
        for (std::size_t bit = 0; bit < 8; ++bit) {
          if ((number >> bit & 1) != 0) entry |= value[byte * 8 + bit];
        }
      }
    }
  }

  std::uint32_t along(std::size_t axis, double coordinate) const noexcept {
    const double cell = std::clamp((coordinate - low_[axis]) * scale_[axis], 0.0, last_[axis]);
    const auto number = static_cast<std::uint64_t>(static_cast<std::int64_t>(cell));
    std::uint32_t place = 0;
    for (std::size_t byte = 0; byte < kBytes; ++byte) {
      place |= spread_[axis][byte][number >> (8 * byte) & 0xFF];
    }
    return place;
  }

  int bits_ = 0;
  std::vector<int> bits_of_size_;
  std::array<double, 3> low_, scale_{}, last_{};
  /// The key bits contributed by each byte of a coordinate.
  std::array<std::array<std::array<std::uint32_t, 256>, kBytes>, 3> spread_{};
};

/// A stable parallel radix sort by key, least significant digit first. Each thread handles ranges
/// of consecutive entries per digit.
class RadixSort {
 public:
  RadixSort(Entries& entries, std::size_t count)
      : entries_(entries),
        sorted_(std::make_unique_for_overwrite<Entry[]>(count)),  // NOLINT
        count_(count),
        ranges_(std::clamp<std::size_t>(count / kRange, 1, kMaxRanges)),
        next_(ranges_) {}

  void run(int key_bits) {
    for (int shift = 0; shift < key_bits; shift += kDigitBits) sort_by_digit(shift);
  }

 private:
  static constexpr int kDigitBits = 11;
  static constexpr std::size_t kDigits = 1 << kDigitBits, kMaxRanges = 16;

  template <typename Body>
  void for_ranges(int shift, const Body& body) {
    parallel_for(ranges_, [&](std::size_t range) {
      auto& next = next_[range];
      const std::size_t end = count_ * (range + 1) / ranges_;
      for (std::size_t i = count_ * range / ranges_; i < end; ++i) {
        body(entries_[i], next[entries_[i].key >> shift & (kDigits - 1)]);
      }
    });
  }

  void sort_by_digit(int shift) {
    for (auto& next : next_) next.fill(0);
    for_ranges(shift, [](const Entry& /*entry*/, std::uint32_t& next) { ++next; });
    std::uint32_t place = 0;
    for (std::size_t digit = 0; digit < kDigits; ++digit) {
      for (auto& next : next_) place += std::exchange(next[digit], place);
    }
    for_ranges(shift, [&](const Entry& entry, std::uint32_t& next) { sorted_[next++] = entry; });
    std::swap(entries_, sorted_);
  }

  Entries& entries_;
  Entries sorted_;
  std::size_t count_, ranges_;
  std::vector<std::array<std::uint32_t, kDigits>> next_;  // per range, for each digit
};

void sort_run_by_radius(const Crowd& crowd, Entry* begin, Entry* end) {
  const auto is_before = [&](const Entry& a, const Entry& b) {
    const double of_a = crowd.radius(a.sphere), of_b = crowd.radius(b.sphere);
    return of_a != of_b ? of_a < of_b : a.sphere < b.sphere;
  };
  std::sort(begin, end, is_before);
}

/// Sorts every run of equal keys. The ranges of threads never split a run.
void sort_runs_by_radius(const Crowd& crowd, Entry* entries, std::size_t count) {
  const std::size_t ranges = (count + kRange - 1) / kRange;
  std::vector<std::size_t> begin(ranges + 1, count);
  for (std::size_t range = ranges; range-- > 0;) {
    const std::size_t end = std::min(count, (range + 1) * kRange);
    std::size_t i = range * kRange;
    while (i > 0 && i < end && entries[i].key == entries[i - 1].key) ++i;
    begin[range] = i < end ? i : begin[range + 1];
  }
  parallel_for(ranges, [&](std::size_t range) {
    for (std::size_t i = begin[range], end; i < begin[range + 1]; i = end) {
      end = i + 1;
      while (end < begin[range + 1] && entries[end].key == entries[i].key) ++end;
      if (end > i + 1) sort_run_by_radius(crowd, entries + i, entries + end);
    }
  });
}

}  // namespace

Crowd::Crowd(const CameraView& view, std::span<const std::uint32_t> left_out)
    : CameraView(view), left_out_(left_out) {
  const auto add = [&](Sum& sum, std::size_t index) {
    const auto i = static_cast<std::uint32_t>(index);
    if (!has(i)) return;
    ++sum.size;
    sum.extent = std::max(sum.extent, extent(i));
    sum.min_radius = std::min(sum.min_radius, radius(i));
    sum.max_radius = std::max(sum.max_radius, radius(i));
    sum.centers.add(opening(i), 0);
  };
  const auto join = [](Sum& sum, const Sum& later) {
    sum.size += later.size;
    sum.extent = std::max(sum.extent, later.extent);
    sum.min_radius = std::min(sum.min_radius, later.min_radius);
    sum.max_radius = std::max(sum.max_radius, later.max_radius);
    sum.centers.add(later.centers);
  };
  sum_ = reduce_indices(count(), Sum{}, add, join);
}

bool Crowd::has(std::uint32_t sphere) const noexcept {
  return is_seen(sphere) && !contains(left_out_, sphere);
}

std::vector<std::uint32_t> curve_order(const Crowd& crowd) {
  constexpr std::uint32_t kLast = 0xFFFFFFFF;  // the key of spheres that are not in the crowd
  const Sizes sizes(crowd);
  const Curve curve(crowd, sizes);
  const std::size_t count = crowd.count();
  auto entries = std::make_unique_for_overwrite<Entry[]>(count);  // NOLINT
  for_each_index(count, [&](std::size_t index) {
    const auto i = static_cast<std::uint32_t>(index);
    entries[i] = {kLast, i};
    if (!crowd.has(i)) return;
    const int size = sizes.of(crowd.radius(i));
    const std::uint64_t key =
        static_cast<std::uint64_t>(size) << curve.bits() | curve.place(crowd.opening(i), size);
    entries[i].key = static_cast<std::uint32_t>(std::min<std::uint64_t>(key, kLast - 1));
  });
  const bool are_all = crowd.size() == count;
  RadixSort(entries, count).run(are_all ? sizes.bits() + curve.bits() : kKeyBits);
  sort_runs_by_radius(crowd, entries.get(), crowd.size());
  std::vector<std::uint32_t> order(crowd.size());
  for_each_index(order.size(), [&](std::size_t i) { order[i] = entries[i].sphere; });
  return order;
}

}  // namespace sdlc::render
