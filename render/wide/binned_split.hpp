#pragma once

#include <array>
#include <span>

#include "render/wide/bvh_members.hpp"

namespace sdlc::render {

/// Both parts of a group of more than one member, which is split at the best place between
/// bins. Puts the members in order.
template <typename T>
std::array<Group<T>, 2> split_by_bins(std::span<Member<T>> members, const Group<T>& whole);

/// The first half of the members and the second one, as they come.
template <typename T>
std::array<Group<T>, 2> split_in_halves(std::span<const Member<T>> members, const Group<T>& whole);

extern template std::array<Group<float>, 2> split_by_bins(std::span<Member<float>>,
                                                          const Group<float>&);
extern template std::array<Group<double>, 2> split_by_bins(std::span<Member<double>>,
                                                           const Group<double>&);
extern template std::array<Group<float>, 2> split_in_halves(std::span<const Member<float>>,
                                                            const Group<float>&);
extern template std::array<Group<double>, 2> split_in_halves(std::span<const Member<double>>,
                                                             const Group<double>&);

}  // namespace sdlc::render
