#include "render/wide/binned_split.hpp"

#include "render/wide/bins.hpp"

namespace sdlc::render {
namespace {

template <typename T>
BuildBox<T> box_of(std::span<const Member<T>> members) {
  BuildBox<T> box;
  for (const Member<T>& member : members) box.add(member.box());
  return box;
}

/// Both parts of a group that has been put in order.
template <typename T>
std::array<Group<T>, 2> parts(const Group<T>& whole, const Bins<T>& bins, const Cut<T>& cut) {
  Group<T> below{.begin = whole.begin, .end = whole.begin, .box = {}};
  Group<T> above{.begin = whole.begin, .end = whole.end, .box = {}};
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    (bin < cut.bin ? below : above).box.add(bins.boxes[cut.axis][bin]);
    if (bin < cut.bin) below.end += bins.counts[cut.axis][bin];
  }
  above.begin = below.end;
  return {below, above};
}

/// Those in bins below the cut come first; how many they are. Nothing here for a processor to
/// guess: half of its guesses would be wrong.
template <typename T>
std::size_t partition(std::span<Member<T>> members, const BinScale<T>& scale, const Cut<T>& cut) {
  std::size_t below = 0;
  const T bin = static_cast<T>(cut.bin);
  for (Member<T>& place : members) {
    const bool is_below = scale.is_below(place, cut.axis, bin);
    const Member<T> member = place;
    place = members[below];
    members[below] = member;
    below += is_below;
  }
  return below;
}

}  // namespace

template <typename T>
std::array<Group<T>, 2> split_by_bins(std::span<Member<T>> all, const Group<T>& whole) {
  const auto members = all.subspan(whole.begin, whole.count());
  BuildBox<T> middles;
  for (const Member<T>& member : members) middles.add(member.middles());
  const BinScale<T> scale(middles);
  Bins<T> bins;
  for (const Member<T>& member : members) bins.add(member.box(), 1, scale.bins_of(member));
  const Cut<T> cut = best_cut(bins);
  if (!cut.exists()) return split_in_halves<T>(all, whole);
  partition(members, scale, cut);
  return parts(whole, bins, cut);
}

template <typename T>
std::array<Group<T>, 2> split_in_halves(std::span<const Member<T>> members, const Group<T>& whole) {
  const std::size_t half = whole.count() / 2, middle = whole.begin + half;
  return {Group<T>{.begin = whole.begin,
                   .end = middle,
                   .box = box_of<T>(members.subspan(whole.begin, half))},
          Group<T>{.begin = middle,
                   .end = whole.end,
                   .box = box_of<T>(members.subspan(middle, whole.end - middle))}};
}

template std::array<Group<float>, 2> split_by_bins(std::span<Member<float>>, const Group<float>&);
template std::array<Group<double>, 2> split_by_bins(std::span<Member<double>>,
                                                    const Group<double>&);
template std::array<Group<float>, 2> split_in_halves(std::span<const Member<float>>,
                                                     const Group<float>&);
template std::array<Group<double>, 2> split_in_halves(std::span<const Member<double>>,
                                                      const Group<double>&);

}  // namespace sdlc::render
