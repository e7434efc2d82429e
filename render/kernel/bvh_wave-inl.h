// Finds the first spheres on the rays of all lanes. Compiled once per instruction set, so it has no
// include guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_KERNEL_BVH_WAVE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_KERNEL_BVH_WAVE_INL_H
#undef SDLC_RENDER_KERNEL_BVH_WAVE_INL_H
#else
#define SDLC_RENDER_KERNEL_BVH_WAVE_INL_H
#endif
// clang-format on

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include <hwy/highway.h>

#include "render/kernel/bvh_search-inl.h"
#include "render/kernel/wide_scene.hpp"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// BvhSearch for many rays at the same time: every round advances each ray by one node or leaf. For
/// vectors that hold all children of a node. A single ray waits for every result and every
/// mispredicted branch; here the next ray's step is independent, and no step branches on hits. With
/// vectors of half a node, and so half as many rays, this takes twice the time of BvhSearch.
template <typename T, bool kMotion>
class BvhWave {
 public:
  using Search = BvhSearch<T, kMotion>;
  using Ray = typename Search::Ray;
  using Rays = typename Search::Rays;
  template <typename U>
  using Row = typename Search::template Row<U>;

  struct Hits {
    alignas(64) Row<T> t;
    alignas(64) Row<std::uint32_t> slot;
  };

  /// BvhSearch::find for the rays in the bit mask `lanes`.
  static HWY_INLINE void find(const WideScene<T>& scene, std::uint32_t root, std::uint32_t lanes,
                              const Rays& rays, const Row<std::uint32_t>& departed, Hits& hits) {
    BvhWave wave(scene, rays, departed, hits);
    wave.start(root, lanes);
    wave.run(lanes);
  }

 private:
  using D = typename Search::D;
  using V = typename Search::V;
  using DI = hn::RebindToSigned<D>;
  using VI = hn::Vec<DI>;
  /// The entry distance of a box as an integer with the same order; its lowest bits hold the
  /// child's index in the node.
  using Key = hn::TFromD<DI>;
  static constexpr Key kChildBits = kBvhWidth - 1;
  static constexpr Key kEntryBits = std::numeric_limits<Key>::max() - kChildBits;
  /// The bottom of the stack holds this many keys of 0, which compare below any hit.
  static constexpr std::uint32_t kBottom = kBvhWidth;
  static constexpr std::size_t kMaxSorted = 4;

  struct Stack {
    // A whole vector is written from the first free entry on.
    static constexpr std::size_t kRoom = kBottom + WideBvh<T>::kMaxWaiting + kBvhWidth;
    alignas(64) std::array<Key, kRoom> keys;
    std::array<std::uint32_t, kRoom> parents;  // the parent node of each entry
  };

  HWY_INLINE BvhWave(const WideScene<T>& scene, const Rays& rays,
                     const Row<std::uint32_t>& departed, Hits& hits)
      : scene_(scene), search_(scene), rays_(rays), departed_(departed), hits_(hits) {}

  HWY_INLINE void start(std::uint32_t root, std::uint32_t lanes) {
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
      current_[lane] = root;
      waiting_[lane] = kBottom;
      farthest_[lane] = Search::max_entry(hits_.t[lane]);
      hn::Store(hn::Zero(DI()), DI(), stacks_[lane].keys.data());
      stacks_[lane].parents[kBottom - 1] = root;
    }
  }

  HWY_INLINE void run(std::uint32_t lanes) {
    while (lanes != 0) {
      std::uint32_t at_leaf = lanes & lanes_at_leaf();
      std::uint32_t at_node = lanes ^ at_leaf, pops = at_leaf;
      for (; at_leaf != 0; at_leaf &= at_leaf - 1) meet_leaf(first_of(at_leaf));
      for (; at_node != 0; at_node &= at_node - 1) {
        const std::size_t lane = first_of(at_node);
        pops |= open(lane) << lane;
      }
      for (; pops != 0; pops &= pops - 1) {
        const std::size_t lane = first_of(pops);
        lanes ^= pop(lane) << lane;
      }
    }
  }

  HWY_INLINE std::uint32_t lanes_at_leaf() const {
    const hn::RebindToUnsigned<D> du;
    static_assert(WideBvh<T>::kLeaf == 0x80000000);
    const auto current = hn::BitCast(DI(), hn::Load(du, current_.data()));
    return bits_of(DI(), hn::Lt(current, hn::Zero(DI())));
  }

  static HWY_INLINE std::size_t first_of(std::uint32_t lanes) {
    return static_cast<std::size_t>(std::countr_zero(lanes));
  }

  /// Pushes the children that the ray hits, sorted, and descends to the nearest. Returns 1 if there
  /// are none, otherwise 0.
  HWY_INLINE std::uint32_t open(std::size_t lane) {
    const D d;
    const DI di;
    const Ray ray(rays_, lane);
    const std::uint32_t index = current_[lane], before = waiting_[lane];
    const auto& node = scene_.bvh.nodes[index];
    const auto boxes = Search::meet_part(node, 0, ray, hn::Set(d, farthest_[lane]));
    const VI keys = hn::Or(hn::And(hn::BitCast(di, boxes.entry), hn::Set(di, kEntryBits)),
                           hn::Iota(di, Key{0}));
    const auto met = hn::RebindMask(di, boxes.met);
    const VI packed = hn::Compress(hn::IfThenElseZero(met, keys), met);  // followed by zeros
    const auto count = static_cast<std::uint32_t>(std::popcount(bits_of(d, boxes.met)));
    Key* const place = stacks_[lane].keys.data() + before;
    std::uint32_t* const parents = stacks_[lane].parents.data() + before;
    if (HWY_LIKELY(count <= kMaxSorted)) {
      const hn::Full128<Key> d4;
      const hn::Full128<std::uint32_t> du4;
      hn::StoreU(sorted_four(hn::LowerHalf(hn::LowerHalf(packed))), d4, place);
      hn::StoreU(hn::Set(du4, index), du4, parents);
    } else {
      const hn::RebindToUnsigned<D> du;
      hn::StoreU(packed, di, place);
      hn::StoreU(hn::Set(du, index), du, parents);
      sort(place, count);
    }
    current_[lane] = node.children[child_of(*(place + count - 1))];
    const std::uint32_t is_none = count == 0 ? 1 : 0;
    waiting_[lane] = before + count - (is_none ^ 1);
    return is_none;
  }

  /// Sorting network; the greatest first.
  static HWY_INLINE hn::Vec<hn::Full128<Key>> sorted_four(hn::Vec<hn::Full128<Key>> v) {
    const hn::Full128<Key> d;
    alignas(16) static constexpr std::array<Key, 4> kInnerSwapped{0, 2, 1, 3};
    auto other = hn::Shuffle2301(v);
    v = hn::OddEven(hn::Min(v, other), hn::Max(v, other));
    other = hn::Shuffle1032(v);
    v = hn::ConcatUpperLower(d, hn::Min(v, other), hn::Max(v, other));
    other = hn::TableLookupLanes(v, hn::SetTableIndices(d, kInnerSwapped.data()));
    return hn::ConcatUpperLower(d, hn::Min(v, other), hn::Max(v, other));
  }
  static HWY_INLINE void sort(Key* keys, std::size_t count) {
    for (std::size_t i = 1; i < count; ++i) {
      const Key key = keys[i];
      std::size_t place = i;
      for (; place > 0 && keys[place - 1] < key; --place) keys[place] = keys[place - 1];
      keys[place] = key;
    }
  }

  static HWY_INLINE std::size_t child_of(Key key) {
    return static_cast<std::size_t>(key & kChildBits);
  }

  /// Pops the top entry that begins before the hit. Returns 1 if there is none, otherwise 0.
  HWY_INLINE std::uint32_t pop(std::size_t lane) {
    const DI di;
    const Stack& stack = stacks_[lane];
    Key farthest;
    std::memcpy(&farthest, &farthest_[lane], sizeof farthest);
    const VI beyond = hn::Set(di, static_cast<Key>((farthest | kChildBits) + 1));
    const auto before_hit = [&](std::uint32_t end) HWY_ATTR {
      const VI keys = hn::LoadU(di, stack.keys.data() + end - kBvhWidth);
      return bits_of(di, hn::Lt(keys, beyond));
    };
    std::uint32_t end = waiting_[lane];
    std::uint32_t fit = before_hit(end);
    while (HWY_UNLIKELY(fit == 0)) fit = before_hit(end -= kBvhWidth);
    const std::uint32_t highest =
        end - kBvhWidth + static_cast<std::uint32_t>(std::bit_width(fit)) - 1;
    waiting_[lane] = highest;
    const auto& parent = scene_.bvh.nodes[stack.parents[highest]];
    current_[lane] = parent.children[child_of(stack.keys[highest])];
    return highest < kBottom ? 1 : 0;
  }

  HWY_INLINE void meet_leaf(std::size_t lane) {
    const D d;
    const DI di;
    const std::uint32_t first = (current_[lane] & ~WideBvh<T>::kLeaf) * kBvhWidth;
    const V t = search_.cut_spheres(first, Ray(rays_, lane)).first_place();
    const V before = hn::Set(d, hits_.t[lane]);
    const auto departed = hn::Set(di, static_cast<Key>(departed_[lane] - first));
    const auto is_other = hn::RebindMask(d, hn::Ne(hn::Iota(di, Key{0}), departed));
    const auto is_near = hn::And(is_other, hn::And(hn::Ge(t, hn::Zero(d)), hn::Le(t, before)));
    const V near = hn::IfThenElse(is_near, t, hn::Set(d, std::numeric_limits<T>::infinity()));
    const V nearest = hn::MinOfLanes(d, near);
    const std::uint32_t found =
        first + static_cast<std::uint32_t>(std::countr_zero(bits_of(d, hn::Eq(near, nearest))));
    take_if_nearer(lane, hn::GetLane(nearest), found,
                   !hn::AllFalse(d, hn::And(is_near, hn::Eq(t, before))));
  }

  /// `is_tie`: a sphere is as near as the current hit.
  HWY_INLINE void take_if_nearer(std::size_t lane, T t, std::uint32_t slot, bool is_tie) {
    T& hit_t = hits_.t[lane];
    std::uint32_t& hit_slot = hits_.slot[lane];
    bool is_nearer = t < hit_t;
    if (HWY_UNLIKELY(is_tie)) is_nearer |= t == hit_t && search_.comes_first(slot, hit_slot);
    // Branchless: the branch is unpredictable.
    const std::uint32_t keeps = static_cast<std::uint32_t>(is_nearer) - 1;
    hit_slot = (hit_slot & keeps) | (slot & ~keeps);
    hit_t = std::min(t, hit_t);
    farthest_[lane] = Search::max_entry(hit_t);
  }

  const WideScene<T>& scene_;
  const Search search_;
  const Rays& rays_;
  const Row<std::uint32_t>& departed_;
  Hits& hits_;
  alignas(64) Row<std::uint32_t> current_;
  Row<std::uint32_t> waiting_;
  Row<T> farthest_;  // max entry distance of boxes, from the hit so far
  Row<Stack> stacks_;
};

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
