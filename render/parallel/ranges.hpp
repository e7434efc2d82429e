#pragma once

#include <cstddef>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

/// Parallel loops over the spheres of a scene, on all threads of the current arena. Short loops
/// stay on the calling thread, because distributing them would take longer.
namespace sdlc::render {

/// Elements per range: some tens of microseconds of work.
inline constexpr std::size_t kRange = 16384;

/// Calls body(i) for each i below `count`, in any order.
template <typename Body>
void for_each_index(std::size_t count, const Body& body) {
  const auto run = [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
  };
  const tbb::blocked_range<std::size_t> all(0, count, kRange);
  count <= kRange ? run(all) : tbb::parallel_for(all, run);
}

/// Parallel reduction: `add(sum, i)` for each i below `count`, starting from `none`; `join(sum,
/// later)` combines sums of adjacent ranges, the earlier one first. The result is deterministic if
/// it does not depend on how indices are split into ranges.
template <typename Sum, typename Add, typename Join>
Sum reduce_indices(std::size_t count, const Sum& none, const Add& add, const Join& join) {
  const auto run = [&](const tbb::blocked_range<std::size_t>& range, Sum sum) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) add(sum, i);
    return sum;
  };
  const tbb::blocked_range<std::size_t> all(0, count, kRange);
  if (count <= kRange) return run(all, none);
  return tbb::parallel_reduce(all, none, run, [&](Sum sum, const Sum& later) {
    join(sum, later);
    return sum;
  });
}

/// The maximum of `value(i)` and `initial`.
template <typename Value>
double largest_of(std::size_t count, double initial, const Value& value) {
  const auto add = [&](double& largest, std::size_t i) {
    const double v = value(i);
    largest = v > largest ? v : largest;
  };
  return reduce_indices(count, initial, add, [](double& largest, double other) {
    largest = other > largest ? other : largest;
  });
}

}  // namespace sdlc::render
