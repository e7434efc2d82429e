#pragma once

#include <cstddef>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

/// Loops over the spheres of a scene on all threads of the calling arena; short ones stay on the
/// thread that calls, which they would only wait for others.
namespace sdlc::render {

/// Members of a range: some tens of microseconds.
inline constexpr std::size_t kRange = 16384;

/// body(i) for each i below `count`, in any order.
template <typename Body>
void for_each_index(std::size_t count, const Body& body) {
  const auto run = [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
  };
  const tbb::blocked_range<std::size_t> all(0, count, kRange);
  count <= kRange ? run(all) : tbb::parallel_for(all, run);
}

/// `add(sum, i)` for each i below `count`, in sums that begin as `none` and are put together by
/// `join(sum, later)`, neighbours always and the earlier one first: what does not depend on how
/// indices are grouped does not depend on threads.
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

/// The largest of `value(i)` and of `least`.
template <typename Value>
double largest_of(std::size_t count, double least, const Value& value) {
  const auto add = [&](double& largest, std::size_t i) {
    const double v = value(i);
    largest = v > largest ? v : largest;
  };
  return reduce_indices(count, least, add, [](double& largest, double other) {
    largest = other > largest ? other : largest;
  });
}

}  // namespace sdlc::render
