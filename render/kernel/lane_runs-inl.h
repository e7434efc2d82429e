// Runs of samples, one per lane, and their sums. Compiled once per instruction set, so it has no
// include guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_KERNEL_LANE_RUNS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_KERNEL_LANE_RUNS_INL_H
#undef SDLC_RENDER_KERNEL_LANE_RUNS_INL_H
#else
#define SDLC_RENDER_KERNEL_LANE_RUNS_INL_H
#endif
// clang-format on

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include <hwy/highway.h>

#include "render/kernel/path_kernel.hpp"
#include "render/lanes/vector_math-inl.h"
#include "render/shading/sampler.hpp"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Gives each lane a run, and the next one when it ends. `kPilot` as in KernelFeatures.
template <typename T, bool kPilot>
class LaneRuns {
 public:
  using D = Lanes<T>;
  using DU = hn::RebindToUnsigned<D>;
  using V = hn::Vec<D>;
  using Bits = hn::Vec<DU>;
  using Mask = hn::Mask<D>;

  HWY_INLINE LaneRuns(const WideView<T>& view, std::span<PixelRun> runs)
      : view_(view), runs_(runs) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) start_run(lane);
  }

  /// The lanes that have samples left.
  HWY_INLINE Mask active() const {
    return hn::RebindMask(D(), hn::Ne(hn::Load(DU(), samples_left_.data()), hn::Zero(DU())));
  }
  /// The index of each lane's next sample; advances it in the lanes of `mask`.
  HWY_INLINE Bits take_samples(Mask mask) {
    const DU du;
    const Bits sample = hn::Load(du, sample_.data());
    const Bits next = add_low_32(sample, hn::Set(du, 1));
    hn::Store(hn::IfThenElse(hn::RebindMask(du, mask), next, sample), du, sample_.data());
    return sample;
  }
  /// The lower left corner of the pixel, as WideView::corner.
  HWY_INLINE Triple<V> corner() const {
    const D d;
    return {hn::Load(d, corner_[0].data()), hn::Load(d, corner_[1].data()),
            hn::Load(d, corner_[2].data())};
  }
  /// The halves of render::stream_key().
  HWY_INLINE Bits stream_key() const { return hn::Load(DU(), stream_key_.data()); }
  HWY_INLINE Bits mixer() const { return hn::Load(DU(), mixer_.data()); }

  const PixelRun& run(std::size_t lane) const { return *run_[lane]; }

  HWY_INLINE void add(Mask mask, Triple<V> contribution);
  HWY_INLINE bool end_samples(Mask ended);

 private:
  using Word = hn::TFromD<DU>;
  static constexpr std::size_t kLanes = hn::MaxLanes(D());

  template <typename Tag>
  static HWY_INLINE void put(Tag tag, hn::TFromD<Tag>* state, std::size_t lane,
                             hn::TFromD<Tag> value);
  Vec3 corner_of(const PixelRun& run) const;
  void start_run(std::size_t lane);
  bool start_part(std::size_t lane, std::uint32_t replicate);
  void finish_parts(Mask finished);

  const WideView<T>& view_;
  std::span<PixelRun> runs_;
  std::size_t next_run_ = 0;

  alignas(64) std::array<std::array<T, kLanes>, 3> corner_{};
  alignas(64) std::array<Word, kLanes> stream_key_{};    // lower half
  alignas(64) std::array<Word, kLanes> mixer_{};         // upper half
  alignas(64) std::array<Word, kLanes> sample_{};        // index of the next sample
  alignas(64) std::array<Word, kLanes> samples_left_{};  // 0: the lane is idle
  alignas(64) std::array<std::array<double, kLanes>, 3> sum_{};
  std::array<PixelRun*, kLanes> run_{};
  std::array<std::uint32_t, kLanes> replicate_{};
};

/// Adds contributions in double.
template <typename T, bool kPilot>
void LaneRuns<T, kPilot>::add(Mask mask, Triple<V> contribution) {
  const Lanes<double> dd;
  const std::array<V, 3> channels{hn::IfThenElseZero(mask, contribution.x),
                                  hn::IfThenElseZero(mask, contribution.y),
                                  hn::IfThenElseZero(mask, contribution.z)};
  for (std::size_t c = 0; c < 3; ++c) {
    double* sum = sum_[c].data();
    if constexpr (sizeof(T) == 4) {
      const auto halves = in_double(D(), channels[c]);
      hn::Store(hn::Add(hn::Load(dd, sum), halves[0]), dd, sum);
      sum += kLanes / 2;
      hn::Store(hn::Add(hn::Load(dd, sum), halves[1]), dd, sum);
    } else {
      hn::Store(hn::Add(hn::Load(dd, sum), channels[c]), dd, sum);
    }
  }
}

/// Counts the samples of these lanes as done. Returns whether active() may have changed.
template <typename T, bool kPilot>
bool LaneRuns<T, kPilot>::end_samples(Mask ended) {
  const D d;
  const DU du;
  const Bits one = hn::IfThenElseZero(hn::RebindMask(du, ended), hn::Set(du, 1));
  const Bits left = hn::Sub(hn::Load(du, samples_left_.data()), one);
  hn::Store(left, du, samples_left_.data());
  const Mask finished = hn::And(ended, hn::RebindMask(d, hn::Eq(left, hn::Zero(du))));
  if (HWY_LIKELY(hn::AllFalse(d, finished))) return false;
  finish_parts(finished);
  return true;
}

/// Sets one lane of a state. A vector is stored where a vector will be loaded: a load that spans
/// the store of a single lane would have to wait for it.
template <typename T, bool kPilot>
template <typename Tag>
void LaneRuns<T, kPilot>::put(Tag tag, hn::TFromD<Tag>* state, std::size_t lane,
                              hn::TFromD<Tag> value) {
  constexpr std::size_t kInVector = hn::MaxLanes(tag);
  state += lane / kInVector * kInVector;
  const auto lane_in_vector = static_cast<hn::TFromD<Tag>>(lane % kInVector);
  const auto is_lane = hn::Eq(hn::Iota(tag, 0), hn::Set(tag, lane_in_vector));
  hn::Store(hn::IfThenElse(is_lane, hn::Set(tag, value), hn::Load(tag, state)), tag, state);
}

template <typename T, bool kPilot>
Vec3 LaneRuns<T, kPilot>::corner_of(const PixelRun& run) const {
  if constexpr (kPilot) return view_.plain->corners[run.pixel];
  const auto x = static_cast<double>(run.pixel % view_.width);
  const auto y = static_cast<double>(run.pixel / view_.width + 1);  // the pixel's lower edge
  return view_.corner + view_.right * x + view_.down * y;
}

/// Gives the lane the next run, or makes it idle if there is none.
template <typename T, bool kPilot>
void LaneRuns<T, kPilot>::start_run(std::size_t lane) {
  while (next_run_ < runs_.size()) {
    PixelRun& run = runs_[next_run_++];
    run_[lane] = &run;
    const Vec3 corner = corner_of(run);
    const D d;
    put(d, corner_[0].data(), lane, static_cast<T>(corner.x));
    put(d, corner_[1].data(), lane, static_cast<T>(corner.y));
    put(d, corner_[2].data(), lane, static_cast<T>(corner.z));
    if (start_part(lane, 0)) return;
  }
  put(DU(), samples_left_.data(), lane, 0);
}

/// Gives the lane the samples of its run in `replicate`, or in the next one that has any; false if
/// none has.
template <typename T, bool kPilot>
bool LaneRuns<T, kPilot>::start_part(std::size_t lane, std::uint32_t replicate) {
  const PixelRun& run = *run_[lane];
  while (run.parts[replicate].count == 0) {
    if (++replicate == kReplicates) return false;
  }
  const PixelRun::Part& part = run.parts[replicate];
  replicate_[lane] = replicate;
  const std::uint64_t key = render::stream_key(view_.seed, run.pixel, replicate);
  const DU du;
  const Lanes<double> dd;
  put(du, mixer_.data(), lane, static_cast<std::uint32_t>(key >> 32));
  put(du, stream_key_.data(), lane, static_cast<std::uint32_t>(key));
  put(du, sample_.data(), lane, part.first);
  put(du, samples_left_.data(), lane, part.count);
  put(dd, sum_[0].data(), lane, part.sum.r);
  put(dd, sum_[1].data(), lane, part.sum.g);
  put(dd, sum_[2].data(), lane, part.sum.b);
  return true;
}

template <typename T, bool kPilot>
void LaneRuns<T, kPilot>::finish_parts(Mask finished) {
  for (std::uint32_t lanes = bits_of(D(), finished); lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    const std::uint32_t replicate = replicate_[lane];
    run_[lane]->parts[replicate].sum = {sum_[0][lane], sum_[1][lane], sum_[2][lane]};
    if (replicate + 1 == kReplicates || !start_part(lane, replicate + 1)) start_run(lane);
  }
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
