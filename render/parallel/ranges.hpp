#pragma once

#include <cstddef>
#include <vector>

#include "render/parallel/parallel_for.hpp"

/// Parallel loops over the spheres of a scene. Short loops stay on the calling thread, because
/// distributing them would take longer.
namespace sdlc::render {

/// Elements per range: some tens of microseconds of work.
inline constexpr std::size_t kRange = 16384;

/// Calls body(i) for each i below `count`, in any order.
template <typename Body>
void for_each_index(std::size_t count, const Body& body) {
  parallel_for(count, body, kRange);
}

/// Parallel reduction: `add(sum, i)` for each i below `count`, starting from `none` in each range
/// of kRange indices; `join(sum, later)` combines the sums of the ranges in order. The result does
/// not depend on the number of threads.
template <typename Sum, typename Add, typename Join>
Sum reduce_indices(std::size_t count, const Sum& none, const Add& add, const Join& join) {
  std::vector<Sum> sums((count + kRange - 1) / kRange, none);
  parallel_ranges(count, kRange, [&](std::size_t begin, std::size_t end) {
    Sum sum = none;
    for (std::size_t i = begin; i < end; ++i) add(sum, i);
    sums[begin / kRange] = sum;
  });
  Sum all = none;
  for (const Sum& sum : sums) join(all, sum);
  return all;
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
