// Counts the paths that reach emitters. Compiled once per instruction set, so it has no include
// guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_KERNEL_EMITTER_COUNTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_KERNEL_EMITTER_COUNTS_INL_H
#undef SDLC_RENDER_KERNEL_EMITTER_COUNTS_INL_H
#else
#define SDLC_RENDER_KERNEL_EMITTER_COUNTS_INL_H
#endif
// clang-format on

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "render/kernel/wide_scene.hpp"
#include "render/lanes/vector_math-inl.h"
#include "render/shading/bsdf-inl.h"
#include "render/shading/emitter_tally.hpp"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Fills an EmitterTally, and keeps the history of each lane's path for it. `kInstances` as in
/// KernelFeatures; spheres of instances are not counted.
template <typename T, bool kInstances>
class EmitterCounts {
 public:
  using D = Lanes<T>;
  using DU = hn::RebindToUnsigned<D>;
  using Bits = hn::Vec<DU>;
  using Mask = hn::Mask<D>;

  /// `tally` may be null.
  HWY_INLINE EmitterCounts(const WideScene<T>& scene, EmitterTally* tally)
      : scene_(scene), tally_(tally != nullptr && tally->is_counting() ? tally : nullptr) {}

  HWY_INLINE bool is_counting() const { return tally_ != nullptr; }
  /// Counts the emitters of `reached`, and adds the surfaces to the paths that have not `ended`.
  void add_vertices(Mask reached, Bits index, Mask ended, Bits surface);
  /// Counts what paths by way of casters contribute, as the root mean square over channels.
  void add_contributions(Mask found, hn::Vec<D> radiance);
  /// Counts lights that shadow rays reached.
  void add_connections(Mask visible, Bits index) {
    count(visible, index, [](std::size_t) { return LightPath::Direct; });
  }

 private:
  using Word = hn::TFromD<DU>;
  static constexpr std::size_t kLanes = hn::MaxLanes(D());
  enum : Word { kHasScattered = 1, kHasMetWide = 2, kLeavesWide = 4 };  // PathHistory

  template <typename KindOf>
  void count(Mask mask, Bits index, const KindOf& kind_of);

  const WideScene<T>& scene_;
  EmitterTally* tally_;
  alignas(64) std::array<Word, kLanes> history_{};
};

template <typename T, bool kInstances>
void EmitterCounts<T, kInstances>::add_vertices(Mask reached, Bits index, Mask ended,
                                                Bits surface) {
  const DU du;
  count(reached, index, [&](std::size_t lane) {
    return light_path({.has_scattered = (history_[lane] & kHasScattered) != 0,
                       .has_met_wide = (history_[lane] & kHasMetWide) != 0,
                       .leaves_wide = (history_[lane] & kLeavesWide) != 0});
  });
  const auto word = [](Word v) HWY_ATTR { return hn::Set(DU(), v); };
  const Bits history = hn::Load(du, history_.data());
  const Bits after_wide = word(kHasScattered | kHasMetWide | kLeavesWide);
  const Bits after_narrow = hn::Or(hn::And(history, word(kHasMetWide)), word(kHasScattered));
  const auto is_wide = hn::RebindMask(du, Bsdf<T>::is_wide(surface));
  const Bits next = hn::IfThenElse(is_wide, after_wide, after_narrow);
  hn::Store(hn::IfThenElse(hn::RebindMask(du, ended), hn::Zero(du), next), du, history_.data());
}

template <typename T, bool kInstances>
void EmitterCounts<T, kInstances>::add_contributions(Mask found, hn::Vec<D> radiance) {
  alignas(64) std::array<T, kLanes> of_lanes;
  hn::Store(radiance, D(), of_lanes.data());
  for (std::uint32_t lanes = bits_of(D(), found); lanes != 0; lanes &= lanes - 1) {
    tally_->count_contribution(of_lanes[static_cast<std::size_t>(std::countr_zero(lanes))]);
  }
}

template <typename T, bool kInstances>
template <typename KindOf>
void EmitterCounts<T, kInstances>::count(Mask mask, Bits index, const KindOf& kind_of) {
  alignas(64) std::array<Word, kLanes> indices;
  hn::Store(index, DU(), indices.data());
  for (std::uint32_t lanes = bits_of(D(), mask); lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    const Word sphere = indices[lane];
    if constexpr (kInstances) {
      if (sphere >> 32 != 0) continue;
    }
    tally_->count(scene_.index_in_scene[sphere], kind_of(lane));
  }
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
