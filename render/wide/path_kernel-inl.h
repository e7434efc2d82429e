// The wide path tracer, compiled once for each instruction set: no include guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_WIDE_PATH_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_WIDE_PATH_KERNEL_INL_H
#undef SDLC_RENDER_WIDE_PATH_KERNEL_INL_H
#else
#define SDLC_RENDER_WIDE_PATH_KERNEL_INL_H
#endif
// clang-format on

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>

#include <hwy/highway.h>

#include "render/sampler/sampler.hpp"
#include "render/wide/bvh_search-inl.h"
#include "render/wide/bvh_wave-inl.h"
#include "render/wide/path_kernel.hpp"
#include "render/wide/scatter-inl.h"
#include "render/wide/table_reader-inl.h"
#include "render/wide/vector_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// What a kernel has and what costs time where a scene does not need it.
template <bool motion, bool exact_spheres, bool bvh, bool instances = false>
struct Features {
  static constexpr bool kMotion = motion;
  static constexpr bool kExactSpheres = exact_spheres;
  static constexpr bool kBvh = bvh;
  static constexpr bool kInstances = instances;  // in double, through a hierarchy
};

/// All that a thread does: one path in every lane, a new one as soon as it ends.
template <typename T, typename F>
class WidePaths {
 public:
  HWY_INLINE WidePaths(const WideScene<T>& scene, const WideView<T>& view,
                       std::span<const SampleBlock<T>> blocks, std::span<LinearRgb> sums)
      : scene_(scene), view_(view), blocks_(blocks), sums_(sums) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) start_block(lane);
  }

  void trace(WideCounts& counts, const std::atomic<bool>& cancel);

 private:
  using D = hn::ScalableTag<T>;
  using DU = hn::RebindToUnsigned<D>;
  using V = hn::Vec<D>;
  using Bits = hn::Vec<DU>;
  using Mask = hn::Mask<D>;
  using Word = hn::TFromD<DU>;
  static constexpr std::size_t kLanes = hn::MaxLanes(D());
  static constexpr std::uint32_t kVertexStep = PathSampler::kPairIncrement * kVertexPairs;

  // As whole numbers, floating point numbers from 0 on have their own order, and all that are
  // negative, or none, come behind infinity: one minimum takes the place of three comparisons.
  static constexpr bool kOrdersAsWholeNumbers = sizeof(T) == 4 || HWY_TARGET == HWY_AVX3;

  struct Nearest {
    V t;         // infinite where nothing was hit
    Bits index;  // of the sphere: its slot; 0 there. kInstances: 2^32 rows of the instance more
  };
  static HWY_INLINE Bits slot_of(Bits index) {
    if constexpr (F::kInstances) return hn::And(index, word(0xFFFFFFFF));
    return index;
  }

  static HWY_INLINE V set(double v) { return hn::Set(D(), static_cast<T>(v)); }
  static HWY_INLINE Bits word(std::uint32_t v) { return hn::Set(DU(), v); }

  HWY_INLINE void start_block(std::size_t lane);
  HWY_INLINE void finish_blocks(Mask finished);
  HWY_INLINE Nearest intersect(Triple<V> origin, Triple<V> direction, V time, Bits departed,
                               V rehit, Mask alive) const;
  template <bool kAsks>
  HWY_INLINE void intersect_tables(Triple<V> origin, Triple<V> direction, V time, Bits departed,
                                   V rehit, Nearest& nearest) const;
  void intersect_exact(Triple<V> origin, Triple<V> direction, V time, Bits departed, V rehit,
                       Nearest& nearest) const;
  void intersect_bvh(Triple<V> origin, Triple<V> direction, V time, Bits departed, Mask alive,
                     Nearest& nearest) const;
  template <typename Find>
  static HWY_INLINE void find_one_by_one(Bits departed, Mask alive, Nearest& nearest,
                                         const Find& find);
  void intersect_placed(Triple<V> origin, Triple<V> direction, V time, Bits departed, Mask alive,
                        Nearest& nearest) const;
  HWY_INLINE V place_in_world(Bits index, V time, Triple<V>& center) const;
  HWY_INLINE TableReader<D> material_reader(const TableReader<D>& read) const {
    if constexpr (F::kBvh) return {read(scene_.material), scene_.materials};
    return read;
  }
  HWY_INLINE TableReader<D> optics_reader(const TableReader<D>& read_material) const {
    if constexpr (F::kBvh) return {read_material(scene_.optics), scene_.optics_rows};
    return read_material;
  }
  static HWY_INLINE V first_from_zero(V enters, V leaves);
  static HWY_INLINE void take_if_nearer(V t, Bits index, Nearest& nearest);
  HWY_INLINE void add_to_sums(Mask mask, Triple<V> value);

  const WideScene<T>& scene_;
  const WideView<T>& view_;
  std::span<const SampleBlock<T>> blocks_;
  std::span<LinearRgb> sums_;
  std::size_t next_block_ = 0;

  // What changes only with the block stays in memory.
  alignas(64) std::array<std::array<T, kLanes>, 3> corner_{};
  alignas(64) std::array<Word, kLanes> stream_key_{};    // its lower half
  alignas(64) std::array<Word, kLanes> mixer_{};         // its upper half
  alignas(64) std::array<Word, kLanes> sample_{};        // the index of the lane's next sample
  alignas(64) std::array<Word, kLanes> samples_left_{};  // 0: the lane has nothing to do
  alignas(64) std::array<std::array<double, kLanes>, 3> sum_{};
  std::array<std::size_t, kLanes> block_{};
};

template <typename T, typename F>
void WidePaths<T, F>::start_block(std::size_t lane) {
  if (next_block_ == blocks_.size()) {
    samples_left_[lane] = 0;
    return;
  }
  const SampleBlock<T>& block = blocks_[next_block_];
  block_[lane] = next_block_++;
  for (std::size_t i = 0; i < 3; ++i) {
    corner_[i][lane] = block.corner[i];
    sum_[i][lane] = block.sum[i];
  }
  mixer_[lane] = static_cast<std::uint32_t>(block.stream_key >> 32);
  stream_key_[lane] = static_cast<std::uint32_t>(block.stream_key);
  sample_[lane] = block.first;
  samples_left_[lane] = block.count;
}

template <typename T, typename F>
void WidePaths<T, F>::finish_blocks(Mask finished) {
  alignas(64) std::array<Word, kLanes> flags;
  hn::Store(hn::VecFromMask(DU(), hn::RebindMask(DU(), finished)), DU(), flags.data());
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (flags[lane] == 0) continue;
    sums_[block_[lane]] = {sum_[0][lane], sum_[1][lane], sum_[2][lane]};
    start_block(lane);
  }
}

/// The nearest sphere, of several at one distance the first. Each is met at t ≥ 0, the one that the
/// path `departed` from at `rehit`, where that is positive.
template <typename T, typename F>
auto WidePaths<T, F>::intersect(Triple<V> origin, Triple<V> direction, V time, Bits departed,
                                V rehit, Mask alive) const -> Nearest {
  // Where spheres are few, some lane nearly always hits, and to ask costs 3 %; of 87 spheres
  // most are missed by all lanes, and to ask saves 25 to 35 %. The result is the same.
  constexpr std::size_t kFew = 16;
  Nearest nearest{hn::Set(D(), std::numeric_limits<T>::infinity()), hn::Zero(DU())};
  if constexpr (!F::kBvh) {
    if (scene_.slots <= kFew) {
      intersect_tables<false>(origin, direction, time, departed, rehit, nearest);
    } else {
      intersect_tables<true>(origin, direction, time, departed, rehit, nearest);
    }
  }
  if constexpr (F::kBvh) {  // in the order of the tables, where spheres met in double come last
    // Not from one of those, and not from none.
    const auto first_exact = word(static_cast<std::uint32_t>(scene_.first_exact));
    const Mask has_left = hn::RebindMask(D(), hn::Lt(slot_of(departed), first_exact));
    take_if_nearer(hn::IfThenElse(has_left, rehit, set(-1)), departed, nearest);
  }
  if constexpr (F::kExactSpheres) {
    intersect_exact(origin, direction, time, departed, rehit, nearest);
  }
  if constexpr (F::kInstances) {
    intersect_placed(origin, direction, time, departed, alive, nearest);
  } else if constexpr (F::kBvh) {
    intersect_bvh(origin, direction, time, departed, alive, nearest);
  }
  return nearest;
}

/// Meets all spheres but those of WideScene::exact. `kAsks` whether any lane hits before it goes
/// on.
template <typename T, typename F>
template <bool kAsks>
void WidePaths<T, F>::intersect_tables(Triple<V> origin, Triple<V> direction, V time, Bits departed,
                                       V rehit, Nearest& nearest) const {
  const D d;
  const DU du;
  for (std::size_t i = 0; i < scene_.first_exact; ++i) {
    Triple<V> center{hn::Set(d, scene_.center[0][i]), hn::Set(d, scene_.center[1][i]),
                     hn::Set(d, scene_.center[2][i])};
    if constexpr (F::kMotion) {
      center = plus_scaled(center,
                           {hn::Set(d, scene_.shift[0][i]), hn::Set(d, scene_.shift[1][i]),
                            hn::Set(d, scene_.shift[2][i])},
                           time);
    }
    const Triple<V> to_center = minus(center, origin);
    const V middle = dot(to_center, direction);
    const V discriminant =
        chord_discriminant(to_center, direction, middle, hn::Set(d, scene_.radius_squared[i]));
    const Bits index = hn::Set(du, static_cast<Word>(i));
    const Mask is_departed = hn::RebindMask(d, hn::Eq(departed, index));
    if constexpr (kAsks) {
      const Mask matters = hn::Or(hn::Ge(discriminant, hn::Zero(d)), is_departed);
      if (hn::AllFalse(d, matters)) continue;
    }
    // No number where the ray misses, and so no hit in what follows.
    const V half_chord = hn::Sqrt(discriminant);
    const V enters = hn::Sub(middle, half_chord), leaves = hn::Add(middle, half_chord);
    take_if_nearer(hn::IfThenElse(is_departed, rehit, first_from_zero(enters, leaves)), index,
                   nearest);
  }
}

/// `enters` where it is not negative, else `leaves`, which is not less; anything that is not from 0
/// on where both are negative or no numbers.
template <typename T, typename F>
auto WidePaths<T, F>::first_from_zero(V enters, V leaves) -> V {
  if constexpr (kOrdersAsWholeNumbers) {
    const DU du;
    return hn::BitCast(D(), hn::Min(hn::BitCast(du, enters), hn::BitCast(du, leaves)));
  } else {
    return hn::IfThenElse(hn::Ge(enters, hn::Zero(D())), enters, leaves);
  }
}

template <typename T, typename F>
void WidePaths<T, F>::take_if_nearer(V t, Bits index, Nearest& nearest) {
  const D d;
  const DU du;
  if constexpr (kOrdersAsWholeNumbers) {
    const Bits before = hn::BitCast(du, nearest.t);
    const Bits now = hn::Min(before, hn::BitCast(du, t));
    nearest.index = hn::IfThenElse(hn::Eq(before, now), nearest.index, index);
    nearest.t = hn::BitCast(d, now);
  } else {
    const Mask nearer = hn::And(hn::Ge(t, hn::Zero(d)), hn::Lt(t, nearest.t));
    nearest.index = hn::IfThenElse(hn::RebindMask(du, nearer), index, nearest.index);
    nearest.t = hn::IfThenElse(nearer, t, nearest.t);
  }
}

/// Meets the spheres of WideScene::exact in double, one half of the lanes after the other. The one
/// that the path departed from is met again where the ray leaves it, if `rehit` is not negative.
template <typename T, typename F>
void WidePaths<T, F>::intersect_exact(Triple<V> origin, Triple<V> direction, V time, Bits departed,
                                      V rehit, Nearest& nearest) const {
  const D d;
  const hn::Half<D> dh;
  const hn::Repartition<double, D> dd;
  using Wide = hn::Vec<decltype(dd)>;
  using Halves = std::array<Wide, 2>;
  const auto wide = [&](V v) HWY_ATTR {
    return Halves{hn::PromoteTo(dd, hn::LowerHalf(dh, v)), hn::PromoteTo(dd, hn::UpperHalf(dh, v))};
  };
  const auto narrow = [&](const Halves& v) HWY_ATTR {
    return hn::Combine(d, hn::DemoteTo(dh, v[1]), hn::DemoteTo(dh, v[0]));
  };
  const auto halves_of = [&](Triple<V> v) HWY_ATTR {
    const Halves x = wide(v.x), y = wide(v.y), z = wide(v.z);
    return std::array<Triple<Wide>, 2>{Triple<Wide>{x[0], y[0], z[0]},
                                       Triple<Wide>{x[1], y[1], z[1]}};
  };
  const auto origins = halves_of(origin);
  auto directions = halves_of(direction);
  const Halves times = wide(time);
  // A direction of unit length in float is off by some 1e-7, which times the distance to the far
  // side of a ground would be far more than that to its near side. 1 / √(1 + e) by two terms.
  Halves to_unit;
  for (std::size_t half = 0; half < 2; ++half) {
    const Wide e = hn::Sub(dot(directions[half], directions[half]), hn::Set(dd, 1.0));
    const Wide slope = hn::MulAdd(e, hn::Set(dd, 0.375), hn::Set(dd, -0.5));
    to_unit[half] = hn::MulAdd(e, slope, hn::Set(dd, 1.0));
    directions[half] = scaled(directions[half], to_unit[half]);
  }

  const Wide zero = hn::Zero(dd);
  for (std::size_t i = 0; i < scene_.exact_spheres; ++i) {
    const auto& sphere = scene_.exact[i];
    Halves middles, half_chords, t;
    for (std::size_t half = 0; half < 2; ++half) {
      Triple<Wide> center = spread(dd, sphere.center);
      if constexpr (F::kMotion) {
        center = plus_scaled(center, spread(dd, sphere.shift), times[half]);
      }
      const Triple<Wide> to_center = minus(center, origins[half]);
      middles[half] = dot(to_center, directions[half]);
      const Triple<Wide> across = minus_scaled(to_center, directions[half], middles[half]);
      half_chords[half] =
          hn::Sqrt(hn::Sub(hn::Set(dd, sphere.radius_squared), dot(across, across)));
      const Wide enters = hn::Sub(middles[half], half_chords[half]);
      t[half] =
          hn::IfThenElse(hn::Ge(enters, zero), enters, hn::Add(middles[half], half_chords[half]));
    }
    const Bits index = word(static_cast<std::uint32_t>(scene_.first_exact + i));
    const Mask is_departed = hn::RebindMask(d, hn::Eq(departed, index));
    const Mask is_inside = hn::And(is_departed, hn::Ge(rehit, hn::Zero(d)));
    if (HWY_UNLIKELY(!hn::AllFalse(d, is_inside))) {
      // The place where a path left it, rounded, is before or behind the surface by chance.
      const Halves inside = wide(hn::IfThenElseZero(is_inside, set(1)));
      for (std::size_t half = 0; half < 2; ++half) {
        const auto has_chord = hn::Gt(half_chords[half], zero);
        const Wide leaves =
            hn::Add(middles[half], hn::IfThenElseZero(has_chord, half_chords[half]));
        t[half] = hn::IfThenElse(hn::Gt(inside[half], zero), hn::Max(leaves, zero), t[half]);
      }
    }
    const V distance = narrow({hn::Mul(t[0], to_unit[0]), hn::Mul(t[1], to_unit[1])});
    const Mask stays_outside = hn::AndNot(is_inside, is_departed);
    take_if_nearer(hn::IfThenElse(stays_outside, set(-1), distance), index, nearest);
  }
}

/// Meets the spheres of WideScene::bvh, in all lanes at a time or one after the other.
template <typename T, typename F>
void WidePaths<T, F>::intersect_bvh(Triple<V> origin, Triple<V> direction, V time, Bits departed,
                                    Mask alive, Nearest& nearest) const {
  using Search = BvhSearch<T, F::kMotion>;
  const typename Search::Rays rays(origin, direction, time);
  if constexpr (Search::kParts == 1) {
    const D d;
    const DU du;
    using Wave = BvhWave<T, F::kMotion>;
    typename Wave::Hits hits;
    alignas(64) std::array<std::uint32_t, kLanes> left;
    hn::Store(nearest.t, d, hits.t.data());
    hn::Store(nearest.index, du, hits.slot.data());
    hn::Store(departed, du, left.data());
    Wave::find(scene_, 0, bits_of(d, alive), rays, left, hits);
    nearest = {hn::Load(d, hits.t.data()), hn::Load(du, hits.slot.data())};
  } else {
    const Search search(scene_);
    const auto find = [&](std::size_t lane, Word left, T& t, Word& index) HWY_ATTR {
      typename Search::Hit hit{t, static_cast<std::uint32_t>(index)};
      search.find(0, typename Search::Ray(rays, lane), static_cast<std::uint32_t>(left), hit);
      t = hit.t;
      index = hit.slot;
    };
    find_one_by_one(departed, alive, nearest, find);
  }
}

/// Calls `find(lane, departed, t, index)` with the numbers of each lane of `alive`, the last two of
/// `nearest`, to be replaced.
template <typename T, typename F>
template <typename Find>
void WidePaths<T, F>::find_one_by_one(Bits departed, Mask alive, Nearest& nearest,
                                      const Find& find) {
  const D d;
  const DU du;
  alignas(64) std::array<T, kLanes> distances;
  alignas(64) std::array<Word, kLanes> left, indices;
  hn::Store(nearest.t, d, distances.data());
  hn::Store(departed, du, left.data());
  hn::Store(nearest.index, du, indices.data());
  for (std::uint32_t lanes = bits_of(d, alive); lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    find(lane, left[lane], distances[lane], indices[lane]);
  }
  nearest = {hn::Load(d, distances.data()), hn::Load(du, indices.data())};
}

/// The same where some of them are instances'.
template <typename T, typename F>
void WidePaths<T, F>::intersect_placed(Triple<V> origin, Triple<V> direction, V time, Bits departed,
                                       Mask alive, Nearest& nearest) const {
  using Search = BvhSearch<T, F::kMotion>;
  const typename Search::Rays rays(origin, direction, time);
  const Search search(scene_);
  const auto placed = [](Word index) {
    return typename Search::Placed{static_cast<std::uint32_t>(index),
                                   static_cast<std::uint32_t>(index >> 32)};
  };
  const auto find = [&](std::size_t lane, Word left, T& t, Word& index) HWY_ATTR {
    typename Search::PlacedHit hit{t, placed(index)};
    search.find_placed(rays, lane, placed(left), hit);
    t = hit.t;
    index = Word{hit.sphere.row} << 32 | hit.sphere.slot;
  };
  find_one_by_one(departed, alive, nearest, find);
}

/// Moves centres from where prototypes have them to where their instances put them at `time`. The
/// instances' scales.
template <typename T, typename F>
auto WidePaths<T, F>::place_in_world(Bits index, V time, Triple<V>& center) const -> V {
  const D d;
  const hn::RebindToSigned<D> di;
  const InstanceTable& table = scene_.instances;
  const auto row = hn::BitCast(di, hn::ShiftRight<32>(index));
  const auto first = hn::ShiftLeft<4>(row);
  static_assert(InstanceTable::kRowSize == 16);
  const auto column = [&](std::size_t i)
                          HWY_ATTR { return hn::GatherIndex(d, table.rows.data() + i, first); };
  const auto triple = [&](std::size_t i) HWY_ATTR {
    return Triple<V>{column(i), column(i + 1), column(i + 2)};
  };
  const V scale = column(InstanceTable::kScale);
  const Triple<V> scaled_center = scaled(center, scale);
  center =
      plus_scaled(triple(InstanceTable::kTranslate), triple(InstanceTable::kAxes), scaled_center.x);
  center = plus_scaled(center, triple(InstanceTable::kAxes + 3), scaled_center.y);
  center = plus_scaled(center, triple(InstanceTable::kAxes + 6), scaled_center.z);
  if constexpr (F::kMotion) {
    if (!table.shift[0].empty()) {
      const auto of = [&](std::size_t axis)
                          HWY_ATTR { return hn::GatherIndex(d, table.shift[axis].data(), row); };
      center = plus_scaled(center, Triple<V>{of(0), of(1), of(2)}, time);
    }
  }
  return scale;
}

/// Adds `value` in the lanes of `mask`, in double.
template <typename T, typename F>
void WidePaths<T, F>::add_to_sums(Mask mask, Triple<V> value) {
  const hn::ScalableTag<double> dd;
  const std::array<V, 3> channels{hn::IfThenElseZero(mask, value.x),
                                  hn::IfThenElseZero(mask, value.y),
                                  hn::IfThenElseZero(mask, value.z)};
  for (std::size_t c = 0; c < 3; ++c) {
    double* sum = sum_[c].data();
    if constexpr (sizeof(T) == 4) {
      const hn::Half<D> dh;
      const auto low = hn::PromoteTo(dd, hn::LowerHalf(dh, channels[c]));
      const auto high = hn::PromoteTo(dd, hn::UpperHalf(dh, channels[c]));
      hn::Store(hn::Add(hn::Load(dd, sum), low), dd, sum);
      sum += kLanes / 2;
      hn::Store(hn::Add(hn::Load(dd, sum), high), dd, sum);
    } else {
      hn::Store(hn::Add(hn::Load(dd, sum), channels[c]), dd, sum);
    }
  }
}

template <typename T, typename F>
void WidePaths<T, F>::trace(WideCounts& counts, const std::atomic<bool>& cancel) {
  const D d;
  const DU du;
  const V zero = hn::Zero(d), one = set(1);
  const V infinity = hn::Set(d, std::numeric_limits<T>::infinity());

  Triple<V> origin{zero, zero, zero}, direction{zero, zero, zero};
  Triple<V> next{zero, zero, one};     // direction of the next ray, of any length
  Triple<V> normal{zero, zero, zero};  // outward, where the path left the last sphere
  Triple<V> beta{zero, zero, zero};    // throughput of the path so far
  V time = zero, radius = zero;        // of the last sphere
  Bits departed = hn::Zero(du), depth_left = hn::Zero(du);
  Bits stream = hn::Zero(du), order = hn::Zero(du);  // of the path's random numbers
  Mask alive = hn::RebindMask(d, hn::Gt(hn::Load(du, samples_left_.data()), hn::Zero(du)));
  Mask fresh = alive;
  std::uint32_t step = 0;

  while (!hn::AllFalse(d, alive)) {
    constexpr std::uint32_t kStepsBetweenLooks = 1024;
    if (++step % kStepsBetweenLooks == 0 && cancel.load(std::memory_order_relaxed)) return;

    const Bits mixer = hn::Load(du, mixer_.data());
    if (!hn::AllFalse(d, fresh)) {
      const auto fresh_bits = hn::RebindMask(du, fresh);
      const Bits sample = hn::Load(du, sample_.data());
      hn::Store(hn::IfThenElse(fresh_bits, add_low_32(sample, word(1)), sample), du,
                sample_.data());
      Bits start = hn::Load(du, stream_key_.data());
      if (view_.sampler == SamplerKind::Independent) {
        start = add_low_32(start, mul_low_32(sample, PathSampler::kIncrement));
      }
      start = mix_lanes(start, mixer);
      start = hn::Xor(start, hn::ShiftRight<16>(start));
      order = hn::IfThenElse(fresh_bits, reverse_lane_bits(sample), order);
      const LaneSampler<D> sampler(view_.sampler, start, mixer, order);
      const auto in_pixel = sampler.pair(kPixel);
      const Triple<V> corner{hn::Load(d, corner_[0].data()), hn::Load(d, corner_[1].data()),
                             hn::Load(d, corner_[2].data())};
      const Triple<V> place =
          plus_scaled(plus_scaled(corner, spread(d, view_.right), in_pixel.first),
                      spread(d, view_.up), in_pixel.second);
      if constexpr (F::kMotion) time = hn::IfThenElse(fresh, sampler.first(kTime), time);
      stream = hn::IfThenElse(
          fresh_bits, add_low_32(start, word(PathSampler::kPairIncrement * kCameraPairs)), stream);
      next = choose(fresh, place, next);
      origin = choose(fresh, Triple<V>{zero, zero, zero}, origin);
      beta = choose(fresh, Triple<V>{one, one, one}, beta);
      depth_left = hn::IfThenElse(fresh_bits, word(scene_.max_depth), depth_left);
      Bits under_camera = word(scene_.camera_sphere);
      if constexpr (F::kInstances) {
        const Bits row = word(scene_.instances.camera_row);
        under_camera = hn::Or(under_camera, hn::ShiftLeft<32>(row));
      }
      departed = hn::IfThenElse(fresh_bits, under_camera, departed);
      if (HWY_UNLIKELY(scene_.camera_sphere != scene_.kNoCameraSphere)) {
        normal = choose(fresh, spread(d, scene_.camera_normal), normal);
        radius = hn::IfThenElse(fresh, hn::Set(d, scene_.camera_sphere_radius), radius);
      }
    }

    // Camera rays, scattered and refracted ones get their length here, in one place.
    V length_squared = dot(next, next);
    const Mask vanishes = hn::Lt(length_squared, set(1e-12));
    if (HWY_UNLIKELY(!hn::AllFalse(d, vanishes))) {
      // Next to −n the sum of normal and unit vector has no digits left: straight off the surface.
      const V side = hn::IfThenElse(hn::Gt(dot(direction, normal), zero), hn::Neg(one), one);
      next = choose(vanishes, scaled(normal, side), next);
      length_squared = hn::IfThenElse(vanishes, one, length_squared);
    }
    direction = scaled(next, hn::Div(one, hn::Sqrt(length_squared)));

    const V inwards = dot(direction, normal);
    const V rehit = hn::IfThenElse(hn::Lt(inwards, zero),
                                   hn::Mul(hn::Mul(set(-2), inwards), radius), hn::Neg(one));
    const Nearest nearest = intersect(origin, direction, time, departed, rehit, alive);
    counts.rays += hn::CountTrue(d, alive);

    const Mask hit = hn::Lt(nearest.t, infinity);
    const TableReader<D> read(slot_of(nearest.index), scene_.slots);
    const TableReader<D> read_material = material_reader(read);
    const TableReader<D> read_optics = optics_reader(read_material);
    const Bits surface = hn::IfThenElseZero(hn::RebindMask(du, hit), read_optics(scene_.surface));
    const Triple<V> color = read_material(scene_.color);
    const Triple<V> sky =
        plus_scaled(spread(d, scene_.sky_middle), spread(d, scene_.sky_slope), direction.y);
    const Triple<V> factor = choose(hit, color, sky);
    beta = {hn::Mul(beta.x, factor.x), hn::Mul(beta.y, factor.y), hn::Mul(beta.z, factor.z)};

    // From the centre, never from the point in the world: the distance to the origin cancels.
    Triple<V> center = read(scene_.center);
    if constexpr (F::kMotion) center = plus_scaled(center, read(scene_.shift), time);
    V scale = one;
    if constexpr (F::kInstances) scale = place_in_world(nearest.index, time, center);
    const Mask is_rehit = hn::RebindMask(d, hn::Eq(nearest.index, departed));
    const Triple<V> from_center = plus_scaled(minus(origin, center), direction, nearest.t);
    Triple<V> outward =
        choose(is_rehit, minus_scaled(normal, direction, hn::Add(inwards, inwards)), from_center);
    outward = scaled(outward, hn::Div(one, hn::Sqrt(dot(outward, outward))));
    const V cosine = dot(direction, outward);

    Mask absorbed = hn::MaskFromVec(hn::Zero(d));
    const LaneSampler<D> sampler(view_.sampler, stream, mixer, order);
    next = Scattering<T>(scene_, read_optics)
               .scatter(direction, outward, cosine, surface, sampler, absorbed);
    stream = add_low_32(stream, word(kVertexStep));
    radius = read(scene_.radius);
    if constexpr (F::kInstances) radius = hn::Mul(radius, scale);
    const Triple<V> on_ray = plus_scaled(origin, direction, nearest.t);
    origin = plus_scaled(center, outward, radius);
    if constexpr (F::kExactSpheres) {
      // But on one met in double from the ray, whose distance to it is right: its size cancels.
      const auto first_exact = word(static_cast<std::uint32_t>(scene_.first_exact));
      origin = choose(hn::RebindMask(d, hn::Lt(nearest.index, first_exact)), origin, on_ray);
    }
    normal = outward;
    departed = nearest.index;

    depth_left = hn::Sub(depth_left, word(1));
    const Mask shines =
        hn::And(alive, hn::Or(hn::Not(hit), Scattering<T>::has(surface, kEndsPath)));
    const Mask exhausted = hn::And(alive, hn::RebindMask(d, hn::Eq(depth_left, hn::Zero(du))));
    const Mask ended = hn::Or(shines, hn::And(alive, absorbed));
    counts.truncated_paths += hn::CountTrue(d, hn::AndNot(ended, exhausted));
    Mask is_sound = shines;
    const V total = hn::Add(hn::Add(beta.x, beta.y), beta.z);
    const Mask is_finite = hn::Lt(hn::Abs(total), infinity);
    if (HWY_UNLIKELY(!hn::AllFalse(d, hn::AndNot(is_finite, shines)))) {
      counts.nonfinite_samples += hn::CountTrue(d, hn::AndNot(is_finite, shines));
      is_sound = hn::And(shines, is_finite);
    }
    add_to_sums(is_sound, beta);

    fresh = hn::Or(ended, exhausted);
    const Bits left = hn::Sub(hn::Load(du, samples_left_.data()),
                              hn::IfThenElseZero(hn::RebindMask(du, fresh), word(1)));
    hn::Store(left, du, samples_left_.data());
    const Mask finished = hn::And(fresh, hn::RebindMask(d, hn::Eq(left, hn::Zero(du))));
    if (HWY_UNLIKELY(!hn::AllFalse(d, finished))) {
      finish_blocks(finished);
      alive = hn::RebindMask(d, hn::Ne(hn::Load(du, samples_left_.data()), hn::Zero(du)));
      fresh = hn::And(fresh, alive);
    }
  }
}

template <typename T, typename F>
void trace_blocks(const WideScene<T>& scene, const WideView<T>& view,
                  std::span<const SampleBlock<T>> blocks, std::span<LinearRgb> sums,
                  WideCounts& counts, const std::atomic<bool>& cancel) noexcept {
  WidePaths<T, F>(scene, view, blocks, sums).trace(counts, cancel);
}

template <typename T, bool kMotion, bool kExactSpheres>
TraceBlocks<T>* choose_search(WideFeatures features) noexcept {
  return features.bvh ? &trace_blocks<T, Features<kMotion, kExactSpheres, true>>
                      : &trace_blocks<T, Features<kMotion, kExactSpheres, false>>;
}

template <typename T>
TraceBlocks<T>* choose_kernel(WideFeatures features) noexcept {
  if constexpr (sizeof(T) == 8) {
    if (features.instances) {
      return features.motion ? &trace_blocks<T, Features<true, false, true, true>>
                             : &trace_blocks<T, Features<false, false, true, true>>;
    }
  }
  if constexpr (sizeof(T) == 4) {
    if (features.exact_spheres) {
      return features.motion ? choose_search<T, true, true>(features)
                             : choose_search<T, false, true>(features);
    }
  }
  return features.motion ? choose_search<T, true, false>(features)
                         : choose_search<T, false, false>(features);
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
