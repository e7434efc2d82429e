#pragma once

#include <array>
#include <span>

#include "render/hierarchy/build_primitives.hpp"

namespace sdlc::render {

/// Splits a range of more than one primitive at the best bin boundary, and partitions its
/// primitives.
template <typename T>
std::array<Range<T>, 2> split_by_bins(std::span<Primitive<T>> primitives, const Range<T>& whole);

/// Splits a range into its first and second half, without reordering.
template <typename T>
std::array<Range<T>, 2> split_in_halves(std::span<const Primitive<T>> primitives,
                                        const Range<T>& whole);

extern template std::array<Range<float>, 2> split_by_bins(std::span<Primitive<float>>,
                                                          const Range<float>&);
extern template std::array<Range<double>, 2> split_by_bins(std::span<Primitive<double>>,
                                                           const Range<double>&);
extern template std::array<Range<float>, 2> split_in_halves(std::span<const Primitive<float>>,
                                                            const Range<float>&);
extern template std::array<Range<double>, 2> split_in_halves(std::span<const Primitive<double>>,
                                                             const Range<double>&);

}  // namespace sdlc::render
