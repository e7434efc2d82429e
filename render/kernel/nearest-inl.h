// Finds the first sphere on each lane's ray. Compiled once per instruction set, so it has no
// include guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_KERNEL_NEAREST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_KERNEL_NEAREST_INL_H
#undef SDLC_RENDER_KERNEL_NEAREST_INL_H
#else
#define SDLC_RENDER_KERNEL_NEAREST_INL_H
#endif
// clang-format on

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <hwy/highway.h>

#include "render/kernel/bvh_search-inl.h"
#include "render/kernel/wide_scene.hpp"
#include "render/lanes/vector_math-inl.h"
#if HWY_TARGET != HWY_SCALAR
#include "render/kernel/bvh_wave-inl.h"
#endif

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// KernelFeatures of a kernel.
template <bool motion, bool exact_spheres, bool bvh, bool instances, bool lights,
          bool pilot = false, bool lens = false, bool caustics = false>
struct Features {
  static constexpr bool kMotion = motion;
  static constexpr bool kExactSpheres = exact_spheres;
  static constexpr bool kBvh = bvh;
  static constexpr bool kInstances = instances;  // in double, through a BVH
  static constexpr bool kLights = lights;
  static constexpr bool kPilot = pilot;  // with kLights
  static constexpr bool kLens = lens;
  static constexpr bool kCaustics = caustics;  // with kLights
};

template <typename T, bool kMotion>
class BvhWave;

/// Decides, from the first rays of a batch, whether Search::All asks for each sphere if it meets
/// the ray of any lane, and skips it otherwise. The hits are the same. Asking takes a branch, which
/// pays where most answers are no: it saves 12 % with 32 small spheres on a ground (2 to 10 % of
/// the answers are yes), and costs 18 % among the 20 large ones of step8 (28 %).
class SphereTests {
 public:
  HWY_INLINE bool asks() const { return asks_; }
  /// Adds rays, one per lane, that met `met` of `spheres`.
  HWY_INLINE void learn(std::size_t met, std::size_t spheres) {
    if (HWY_LIKELY(vectors_ == kVectorsToLearn)) return;
    met_ += met;
    if (++vectors_ < kVectorsToLearn) return;
    asks_ = static_cast<double>(met_) < kOften * kVectorsToLearn * static_cast<double>(spheres);
  }

 private:
  static constexpr std::uint32_t kVectorsToLearn = 64;
  static constexpr double kOften = 0.12;

  std::uint32_t vectors_ = 0;
  std::size_t met_ = 0;
  bool asks_ = true;
};

/// Finds the nearest hit of each lane's ray.
template <typename T, typename F>
class NearestSphere {
 public:
  using D = Lanes<T>;
  using DU = hn::RebindToUnsigned<D>;
  using V = hn::Vec<D>;
  using Bits = hn::Vec<DU>;
  using Mask = hn::Mask<D>;

  struct Nearest {
    V t;         // infinite without a hit
    Bits index;  // slot of the sphere, 0 without a hit; with kInstances plus 2^32 · row of the
                 // instance
  };
  static HWY_INLINE Bits slot_of(Bits index) {
    if constexpr (F::kInstances) return hn::And(index, word(0xFFFFFFFF));
    return index;
  }

  explicit HWY_INLINE NearestSphere(const WideScene<T>& scene) : scene_(scene) {}

  /// `tests`: of this batch.
  HWY_INLINE Nearest find(Triple<V> origin, Triple<V> direction, V time, Bits departed, V rehit,
                          Mask alive, SphereTests& tests) const;
  HWY_INLINE V place_in_world(Bits index, V time, Triple<V>& center) const;

 private:
  using Word = hn::TFromD<DU>;
  static constexpr std::size_t kLanes = hn::MaxLanes(D());

  // As integers, floating-point numbers from 0 on keep their order, and negative numbers and NaN
  // come after infinity: one minimum replaces three comparisons.
  static constexpr bool kOrdersAsWholeNumbers = sizeof(T) == 4 || HWY_TARGET == HWY_AVX3;

  static HWY_INLINE V set(double v) { return hn::Set(D(), static_cast<T>(v)); }
  static HWY_INLINE Bits word(std::uint32_t v) { return hn::Set(DU(), v); }

  template <bool kAsks>
  HWY_INLINE std::size_t intersect_tables(Triple<V> origin, Triple<V> direction, V time,
                                          Bits departed, V rehit, Nearest& nearest) const;
  HWY_NOINLINE void intersect_exact(Triple<V> origin, Triple<V> direction, V time, Bits departed,
                                    V rehit, Nearest& nearest) const;
  HWY_NOINLINE void intersect_bvh(Triple<V> origin, Triple<V> direction, V time, Bits departed,
                                  Mask alive, Nearest& nearest) const;
  template <typename Find>
  static HWY_INLINE void find_one_by_one(Bits departed, Mask alive, Nearest& nearest,
                                         const Find& find);
  HWY_NOINLINE void intersect_placed(Triple<V> origin, Triple<V> direction, V time, Bits departed,
                                     Mask alive, Nearest& nearest) const;
  static HWY_INLINE V first_from_zero(V enters, V leaves);
  static HWY_INLINE void take_if_nearer(V t, Bits index, Nearest& nearest);

  const WideScene<T>& scene_;
};

/// Returns the nearest sphere; at equal distances the first. Hits are at t ≥ 0; the sphere
/// `departed` is hit at `rehit` if that is positive.
template <typename T, typename F>
auto NearestSphere<T, F>::find(Triple<V> origin, Triple<V> direction, V time, Bits departed,
                               V rehit, Mask alive, SphereTests& tests) const -> Nearest {
  Nearest nearest{hn::Set(D(), std::numeric_limits<T>::infinity()), hn::Zero(DU())};
  if constexpr (!F::kBvh) {
    if (tests.asks()) {
      const std::size_t met =
          intersect_tables<true>(origin, direction, time, departed, rehit, nearest);
      tests.learn(met, scene_.first_exact);
    } else {
      intersect_tables<false>(origin, direction, time, departed, rehit, nearest);
    }
  }
  if constexpr (F::kBvh) {  // in table order, where spheres in double come last
    // Excludes those, and no sphere.
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

/// Tests all spheres except those of WideScene::exact. Returns how many of them some lane's ray
/// meets; without `kAsks` all.
template <typename T, typename F>
template <bool kAsks>
std::size_t NearestSphere<T, F>::intersect_tables(Triple<V> origin, Triple<V> direction, V time,
                                                  Bits departed, V rehit, Nearest& nearest) const {
  const D d;
  const DU du;
  std::size_t met = scene_.first_exact;
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
    const V closest = dot(to_center, direction);
    const V discriminant =
        chord_discriminant(to_center, direction, closest, hn::Set(d, scene_.radius_squared[i]));
    const Bits index = hn::Set(du, static_cast<Word>(i));
    const Mask is_departed = hn::RebindMask(d, hn::Eq(departed, index));
    if constexpr (kAsks) {
      const Mask matters = hn::Or(hn::Ge(discriminant, hn::Zero(d)), is_departed);
      if (hn::AllFalse(d, matters)) {
        --met;
        continue;
      }
    }
    // NaN if the ray misses, so it never counts as a hit below.
    const V half_chord = hn::Sqrt(discriminant);
    const V enters = hn::Sub(closest, half_chord), leaves = hn::Add(closest, half_chord);
    take_if_nearer(hn::IfThenElse(is_departed, rehit, first_from_zero(enters, leaves)), index,
                   nearest);
  }
  return met;
}

/// `enters` if it is not negative, otherwise `leaves`, which is not less. If both are negative or
/// NaN, the result is negative or NaN.
template <typename T, typename F>
auto NearestSphere<T, F>::first_from_zero(V enters, V leaves) -> V {
  if constexpr (kOrdersAsWholeNumbers) {
    const DU du;
    return hn::BitCast(D(), hn::Min(hn::BitCast(du, enters), hn::BitCast(du, leaves)));
  } else {
    return hn::IfThenElse(hn::Ge(enters, hn::Zero(D())), enters, leaves);
  }
}

template <typename T, typename F>
void NearestSphere<T, F>::take_if_nearer(V t, Bits index, Nearest& nearest) {
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

/// Tests the spheres of WideScene::exact in double, one half of the lanes after the other. The
/// sphere of departure is hit again where the ray leaves it, if `rehit` is not negative.
template <typename T, typename F>
void NearestSphere<T, F>::intersect_exact(Triple<V> origin, Triple<V> direction, V time,
                                          Bits departed, V rehit, Nearest& nearest) const {
  const D d;
  const hn::Repartition<double, D> dd;
  using Wide = hn::Vec<decltype(dd)>;
  using Halves = std::array<Wide, 2>;
  const auto wide = [&](V v) HWY_ATTR { return in_double(d, v); };
  const auto halves_of = [&](Triple<V> v) HWY_ATTR {
    const Halves x = wide(v.x), y = wide(v.y), z = wide(v.z);
    return std::array<Triple<Wide>, 2>{Triple<Wide>{x[0], y[0], z[0]},
                                       Triple<Wide>{x[1], y[1], z[1]}};
  };
  const auto origins = halves_of(origin);
  auto directions = halves_of(direction);
  const Halves times = wide(time);
  // A float direction has a length error of about 1e-7. Multiplied by the distance to the far side
  // of a large ground sphere, that would exceed the distance to its near side. Two terms of 1 / √(1
  // + e).
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
    Halves closest, half_chords, t;
    for (std::size_t half = 0; half < 2; ++half) {
      Triple<Wide> center = spread(dd, sphere.center);
      if constexpr (F::kMotion) {
        center = plus_scaled(center, spread(dd, sphere.shift), times[half]);
      }
      const Triple<Wide> to_center = minus(center, origins[half]);
      closest[half] = dot(to_center, directions[half]);
      const Triple<Wide> across = minus_scaled(to_center, directions[half], closest[half]);
      half_chords[half] =
          hn::Sqrt(hn::Sub(hn::Set(dd, sphere.radius_squared), dot(across, across)));
      const Wide enters = hn::Sub(closest[half], half_chords[half]);
      t[half] =
          hn::IfThenElse(hn::Ge(enters, zero), enters, hn::Add(closest[half], half_chords[half]));
    }
    const Bits index = word(static_cast<std::uint32_t>(scene_.first_exact + i));
    const Mask is_departed = hn::RebindMask(d, hn::Eq(departed, index));
    const Mask is_inside = hn::And(is_departed, hn::Ge(rehit, hn::Zero(d)));
    if (HWY_UNLIKELY(!hn::AllFalse(d, is_inside))) {
      // The rounded point of departure may be on either side of the surface.
      const Halves inside = wide(hn::IfThenElseZero(is_inside, set(1)));
      for (std::size_t half = 0; half < 2; ++half) {
        const auto has_chord = hn::Gt(half_chords[half], zero);
        const Wide leaves =
            hn::Add(closest[half], hn::IfThenElseZero(has_chord, half_chords[half]));
        t[half] = hn::IfThenElse(hn::Gt(inside[half], zero), hn::Max(leaves, zero), t[half]);
      }
    }
    const V distance = in_float(d, {hn::Mul(t[0], to_unit[0]), hn::Mul(t[1], to_unit[1])});
    const Mask stays_outside = hn::AndNot(is_inside, is_departed);
    take_if_nearer(hn::IfThenElse(stays_outside, set(-1), distance), index, nearest);
  }
}

/// Tests the spheres of WideScene::bvh, in all lanes at the same time or one after the other.
template <typename T, typename F>
void NearestSphere<T, F>::intersect_bvh(Triple<V> origin, Triple<V> direction, V time,
                                        Bits departed, Mask alive, Nearest& nearest) const {
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

/// Calls `find(lane, departed, t, index)` for each lane of `alive`; `find` updates the last two,
/// which are those of `nearest`.
template <typename T, typename F>
template <typename Find>
void NearestSphere<T, F>::find_one_by_one(Bits departed, Mask alive, Nearest& nearest,
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

/// The same if some spheres belong to instances.
template <typename T, typename F>
void NearestSphere<T, F>::intersect_placed(Triple<V> origin, Triple<V> direction, V time,
                                           Bits departed, Mask alive, Nearest& nearest) const {
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

/// Transforms centres from prototype to world coordinates at `time`. Returns the scales of the
/// instances.
template <typename T, typename F>
auto NearestSphere<T, F>::place_in_world(Bits index, V time, Triple<V>& center) const -> V {
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

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
