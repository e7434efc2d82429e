// The wide path tracer. Compiled once per instruction set, so it has no include guard but
// Highway's.
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

#include "render/shading/sampler.hpp"
#include "render/wide/light_connections-inl.h"
#include "render/wide/nearest-inl.h"
#include "render/wide/path_kernel.hpp"
#include "render/wide/scatter-inl.h"
#include "render/wide/table_reader-inl.h"
#include "render/wide/vector_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The work of a thread: one path per lane, replaced as soon as it ends.
template <typename T, typename F>
class WidePaths {
 public:
  HWY_INLINE WidePaths(const WideScene<T>& scene, const WideView<T>& view, std::span<PixelRun> runs)
      : scene_(scene), view_(view), runs_(runs) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) start_run(lane);
  }

  void trace(TraceCounts& counts, const std::atomic<bool>& cancel);

 private:
  using D = Lanes<T>;
  using DU = hn::RebindToUnsigned<D>;
  using V = hn::Vec<D>;
  using Bits = hn::Vec<DU>;
  using Mask = hn::Mask<D>;
  using Word = hn::TFromD<DU>;
  static constexpr std::size_t kLanes = hn::MaxLanes(D());
  static constexpr std::uint32_t kVertexStep = PathSampler::kPairIncrement * kVertexPairs;
  using Search = NearestSphere<T, F>;
  using Nearest = typename Search::Nearest;

  static HWY_INLINE V set(double v) { return hn::Set(D(), static_cast<T>(v)); }
  static HWY_INLINE Bits word(std::uint32_t v) { return hn::Set(DU(), v); }

  template <typename Tag>
  static HWY_INLINE void put(Tag tag, hn::TFromD<Tag>* state, std::size_t lane,
                             hn::TFromD<Tag> value);
  void start_run(std::size_t lane);
  bool start_part(std::size_t lane, std::uint32_t replicate);
  void finish_parts(Mask finished);
  /// The distance at which a ray hits the sphere that it leaves again, negative if it does not;
  /// `inwards` is the cosine of ray and outward normal.
  static HWY_INLINE V rehit_distance(V inwards, V radius) {
    return hn::IfThenElse(hn::Lt(inwards, hn::Zero(D())),
                          hn::Mul(hn::Mul(set(-2), inwards), radius), hn::Neg(set(1)));
  }
  HWY_INLINE TableReader<D> material_reader(const TableReader<D>& read) const {
    if constexpr (F::kBvh) return {read(scene_.material), scene_.materials};
    return read;
  }
  HWY_INLINE TableReader<D> optics_reader(const TableReader<D>& read_material) const {
    if constexpr (F::kBvh) return {read_material(scene_.optics), scene_.optics_rows};
    return read_material;
  }
  HWY_INLINE void add_to_sums(Mask mask, Triple<V> value);
  void meet_camera_spheres(Mask fresh, Triple<V> direction, Nearest& nearest, Bits& departed,
                           Triple<V>& normal, V& inwards) const;
  /// The mean over the channels.
  static HWY_INLINE V mean_square(Triple<V> color) { return hn::Div(dot(color, color), set(3)); }
  static HWY_INLINE double sum_of(Mask mask, V value) {
    return hn::GetLane(hn::SumOfLanes(D(), hn::IfThenElseZero(mask, value)));
  }
  template <typename KindOf>
  void count_reached(Mask mask, Bits index, const KindOf& kind_of, EmitterTally& emitters) const;
  /// Adds the hits of camera rays to the sums of their pixels.
  void add_first_hits(Mask first, const Nearest& nearest, Triple<V> direction, Triple<V> outward,
                      Triple<V> color) const;
  /// Counts the paths that end on the spheres of `mask`, and updates the history of the others.
  void follow_paths(Mask ends, Bits index, Mask fresh, Bits surface, EmitterTally& emitters);

  const WideScene<T>& scene_;
  const WideView<T>& view_;
  std::span<PixelRun> runs_;
  std::size_t next_run_ = 0;

  // State that changes only with the part of a run stays in memory.
  alignas(64) std::array<std::array<T, kLanes>, 3> corner_{};
  alignas(64) std::array<Word, kLanes> stream_key_{};    // lower half
  alignas(64) std::array<Word, kLanes> mixer_{};         // upper half
  alignas(64) std::array<Word, kLanes> sample_{};        // index of the lane's next sample
  alignas(64) std::array<Word, kLanes> samples_left_{};  // 0: the lane is idle
  alignas(64) std::array<std::array<double, kLanes>, 3> sum_{};
  std::array<PixelRun*, kLanes> run_{};
  std::array<std::uint32_t, kLanes> replicate_{};
  // What a path has hit so far, for EmitterTally; maintained only while it counts.
  enum : Word { kHasScattered = 1, kHasMetDiffuse = 2, kLeavesDiffuse = 4 };
  alignas(64) std::array<Word, kLanes> history_{};
};

/// Sets one lane of a state. A vector is stored where a vector will be loaded: a load that spans
/// the store of a single lane would have to wait for it.
template <typename T, typename F>
template <typename Tag>
HWY_INLINE void WidePaths<T, F>::put(Tag tag, hn::TFromD<Tag>* state, std::size_t lane,
                                     hn::TFromD<Tag> value) {
  constexpr std::size_t kInVector = hn::MaxLanes(tag);
  state += lane / kInVector * kInVector;
  const auto lane_in_vector = static_cast<hn::TFromD<Tag>>(lane % kInVector);
  const auto is_lane = hn::Eq(hn::Iota(tag, 0), hn::Set(tag, lane_in_vector));
  hn::Store(hn::IfThenElse(is_lane, hn::Set(tag, value), hn::Load(tag, state)), tag, state);
}

/// Gives the lane the next run, or makes it idle if there is none.
template <typename T, typename F>
void WidePaths<T, F>::start_run(std::size_t lane) {
  while (next_run_ < runs_.size()) {
    PixelRun& run = runs_[next_run_++];
    run_[lane] = &run;
    const auto x = static_cast<double>(run.pixel % view_.width);
    const auto y = static_cast<double>(run.pixel / view_.width + 1);  // the pixel's lower edge
    Vec3 corner = view_.corner + view_.right * x + view_.down * y;
    if constexpr (F::kPilot) corner = view_.plain->corners[run.pixel];
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
template <typename T, typename F>
bool WidePaths<T, F>::start_part(std::size_t lane, std::uint32_t replicate) {
  const PixelRun& run = *run_[lane];
  while (run.parts[replicate].count == 0) {
    if (++replicate == kReplicates) return false;
  }
  const PixelRun::Part& part = run.parts[replicate];
  replicate_[lane] = replicate;
  const std::uint64_t key = PathSampler::stream_key(view_.seed, run.pixel, replicate);
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

template <typename T, typename F>
void WidePaths<T, F>::finish_parts(Mask finished) {
  for (std::uint32_t lanes = bits_of(D(), finished); lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    const std::uint32_t replicate = replicate_[lane];
    run_[lane]->parts[replicate].sum = {sum_[0][lane], sum_[1][lane], sum_[2][lane]};
    if (replicate + 1 == kReplicates || !start_part(lane, replicate + 1)) start_run(lane);
  }
}

/// Adds `value` in double, in the lanes of `mask`.
template <typename T, typename F>
void WidePaths<T, F>::add_to_sums(Mask mask, Triple<V> value) {
  const Lanes<double> dd;
  const std::array<V, 3> channels{hn::IfThenElseZero(mask, value.x),
                                  hn::IfThenElseZero(mask, value.y),
                                  hn::IfThenElseZero(mask, value.z)};
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

/// The first hits of camera rays that leave several spheres. `nearest` is that of all other
/// spheres; these can only be hit from inside, where rays leave them again.
template <typename T, typename F>
void WidePaths<T, F>::meet_camera_spheres(Mask fresh, Triple<V> direction, Nearest& nearest,
                                          Bits& departed, Triple<V>& normal, V& inwards) const {
  const D d;
  const DU du;
  for (const auto& sphere : scene_.camera_spheres) {
    const Triple<V> outward = spread(d, sphere.normal);
    const V cosine = dot(direction, outward);
    const V rehit = rehit_distance(cosine, hn::Set(d, sphere.radius));
    const Mask is_nearer =
        hn::And(fresh, hn::And(hn::Ge(rehit, hn::Zero(d)), hn::Lt(rehit, nearest.t)));
    const auto is_nearer_bits = hn::RebindMask(du, is_nearer);
    nearest.t = hn::IfThenElse(is_nearer, rehit, nearest.t);
    nearest.index = hn::IfThenElse(is_nearer_bits, word(sphere.slot), nearest.index);
    departed = hn::IfThenElse(is_nearer_bits, word(sphere.slot), departed);
    normal = choose(is_nearer, outward, normal);
    inwards = hn::IfThenElse(is_nearer, cosine, inwards);
  }
}

/// Counts the spheres of `mask`, except those of instances.
template <typename T, typename F>
template <typename KindOf>
void WidePaths<T, F>::count_reached(Mask mask, Bits index, const KindOf& kind_of,
                                    EmitterTally& emitters) const {
  const D d;
  const DU du;
  alignas(64) std::array<Word, kLanes> indices;
  hn::Store(index, du, indices.data());
  for (std::uint32_t lanes = bits_of(d, mask); lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    const Word sphere = indices[lane];
    if constexpr (F::kInstances) {
      if (sphere >> 32 != 0) continue;
    }
    emitters.count(scene_.index_in_scene[sphere], kind_of(lane));
  }
}

template <typename T, typename F>
void WidePaths<T, F>::follow_paths(Mask ends, Bits index, Mask fresh, Bits surface,
                                   EmitterTally& emitters) {
  const DU du;
  const auto kind_of = [&](std::size_t lane) {
    return light_path({.has_scattered = (history_[lane] & kHasScattered) != 0,
                       .has_met_diffuse = (history_[lane] & kHasMetDiffuse) != 0,
                       .leaves_diffuse = (history_[lane] & kLeavesDiffuse) != 0});
  };
  count_reached(ends, index, kind_of, emitters);
  const Bits history = hn::Load(du, history_.data());
  const Bits from_diffuse = word(kHasScattered | kHasMetDiffuse | kLeavesDiffuse);
  const Bits from_other = hn::Or(hn::And(history, word(kHasMetDiffuse)), word(kHasScattered));
  const auto is_diffuse =
      hn::Eq(hn::And(surface, word(kEndsPath | kMirrors | kRefracts)), hn::Zero(du));
  const Bits next = hn::IfThenElse(is_diffuse, from_diffuse, from_other);
  hn::Store(hn::IfThenElse(hn::RebindMask(du, fresh), hn::Zero(du), next), du, history_.data());
}

template <typename T, typename F>
void WidePaths<T, F>::add_first_hits(Mask first, const Nearest& nearest, Triple<V> direction,
                                     Triple<V> outward, Triple<V> color) const {
  const D d;
  const V depth = hn::Mul(nearest.t, dot(direction, spread(d, view_.forward)));
  const V facing = hn::IfThenElse(hn::Gt(dot(direction, outward), hn::Zero(d)), set(-1), set(1));
  const std::array<V, 8> values{hn::Mul(outward.x, facing),
                                hn::Mul(outward.y, facing),
                                hn::Mul(outward.z, facing),
                                color.x,
                                color.y,
                                color.z,
                                depth,
                                nearest.t};
  alignas(64) std::array<std::array<T, kLanes>, 8> of_lanes;
  for (std::size_t i = 0; i < values.size(); ++i) hn::Store(values[i], d, of_lanes[i].data());
  alignas(64) std::array<Word, kLanes> indices;
  hn::Store(nearest.index, DU(), indices.data());
  for (std::uint32_t lanes = bits_of(d, first); lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    const auto value = [&](std::size_t i) { return static_cast<double>(of_lanes[i][lane]); };
    run_[lane]->first_hits->add({.normal = {value(0), value(1), value(2)},
                                 .depth = value(6) * view_.depth_units,
                                 .albedo = {value(3), value(4), value(5)}});
    if (view_.picked == nullptr) continue;
    const auto index = static_cast<std::uint64_t>(indices[lane]);
    *view_.picked = {.slot = static_cast<std::uint32_t>(index),
                     .row = static_cast<std::uint32_t>(index >> 32),
                     .distance = value(7)};
  }
}

template <typename T, typename F>
void WidePaths<T, F>::trace(TraceCounts& counts, const std::atomic<bool>& cancel) {
  const D d;
  const DU du;
  const V zero = hn::Zero(d), one = set(1);
  const V infinity = hn::Set(d, std::numeric_limits<T>::infinity());

  Triple<V> origin{zero, zero, zero}, direction{zero, zero, zero};
  Triple<V> next{zero, zero, one};     // direction of the next ray, of any length
  Triple<V> normal{zero, zero, zero};  // outward, at the last point of departure
  Triple<V> beta{zero, zero, zero};    // throughput of the path so far
  V time = zero, radius = zero;        // of the last sphere
  Bits departed = hn::Zero(du), depth_left = hn::Zero(du);
  Bits stream = hn::Zero(du), order = hn::Zero(du);  // sampler state of the path
  Mask alive = hn::RebindMask(d, hn::Gt(hn::Load(du, samples_left_.data()), hn::Zero(du)));
  Mask fresh = alive;
  std::uint32_t step = 0;
  const Search search(scene_);
  EmitterTally* const emitters =
      view_.emitters != nullptr && view_.emitters->is_counting() ? view_.emitters : nullptr;
  // kLights: radiance from connections so far, and whether the ray left a surface where a light was
  // sampled.
  [[maybe_unused]] Triple<V> gathered{zero, zero, zero};
  [[maybe_unused]] Mask left_diffuse = hn::MaskFromVec(zero);

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
          plus_scaled(plus_scaled(corner, spread(d, view_.spread_right), in_pixel.first),
                      spread(d, view_.spread_up), in_pixel.second);
      if constexpr (F::kMotion) time = hn::IfThenElse(fresh, sampler.first(kTime), time);
      stream = hn::IfThenElse(
          fresh_bits, add_low_32(start, word(PathSampler::kPairIncrement * kCameraPairs)), stream);
      next = choose(fresh, place, next);
      origin = choose(fresh, Triple<V>{zero, zero, zero}, origin);
      beta = choose(fresh, Triple<V>{one, one, one}, beta);
      depth_left = hn::IfThenElse(fresh_bits, word(view_.max_depth), depth_left);
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

    // Normalise camera rays and scattered rays here, in one place.
    V length_squared = dot(next, next);
    const Mask vanishes = hn::Lt(length_squared, set(1e-12));
    if (HWY_UNLIKELY(!hn::AllFalse(d, vanishes))) {
      // Near −n the sum of normal and unit vector has no digits left: use the normal.
      const V side = hn::IfThenElse(hn::Gt(dot(direction, normal), zero), hn::Neg(one), one);
      next = choose(vanishes, scaled(normal, side), next);
      length_squared = hn::IfThenElse(vanishes, one, length_squared);
    }
    direction = scaled(next, hn::Div(one, hn::Sqrt(length_squared)));

    V inwards = dot(direction, normal);
    Nearest nearest =
        search.find(origin, direction, time, departed, rehit_distance(inwards, radius), alive);
    if constexpr (kIsPortable) {
      if (HWY_UNLIKELY(scene_.camera_sphere == scene_.kSeveralCameraSpheres)) {
        meet_camera_spheres(fresh, direction, nearest, departed, normal, inwards);
      }
    }
    counts.rays += hn::CountTrue(d, alive);

    const Mask hit = hn::Lt(nearest.t, infinity);
    const TableReader<D> read(Search::slot_of(nearest.index), scene_.slots);
    const TableReader<D> read_material = material_reader(read);
    const TableReader<D> read_optics = optics_reader(read_material);
    const Bits surface = hn::IfThenElseZero(hn::RebindMask(du, hit), read_optics(scene_.surface));
    const Triple<V> color = read_material(scene_.color);
    const Triple<V> sky =
        plus_scaled(spread(d, scene_.sky_center), spread(d, scene_.sky_slope), direction.y);
    const Triple<V> factor = choose(hit, color, sky);
    beta = {hn::Mul(beta.x, factor.x), hn::Mul(beta.y, factor.y), hn::Mul(beta.z, factor.z)};
    [[maybe_unused]] V plain_squares = zero;
    if constexpr (F::kPilot) plain_squares = mean_square(beta);

    if constexpr (F::kLights) {
      const Bits leaf = read(scene_.lights.leaf_of_slot);
      const Mask is_light =
          hn::And(hn::And(hit, left_diffuse), hn::RebindMask(d, hn::Ne(leaf, word(kNoLight))));
      if (!hn::AllFalse(d, is_light)) {
        const V weight =
            LightConnections<T, F::kMotion>(scene_.lights)
                .weight_of_hit(is_light, leaf,
                               {origin, flipped(normal, hn::And(inwards, hn::SignBit(d))), time},
                               hn::Abs(inwards));
        beta = scaled(beta, hn::IfThenElse(is_light, weight, one));
        if constexpr (F::kPilot) {
          plain_squares = hn::Mul(plain_squares, hn::IfThenElse(is_light, weight, one));
        }
      }
    }

    // Relative to the centre, not in world coordinates: the distance to the origin cancels.
    Triple<V> center = read(scene_.center);
    if constexpr (F::kMotion) center = plus_scaled(center, read(scene_.shift), time);
    V scale = one;
    if constexpr (F::kInstances) scale = search.place_in_world(nearest.index, time, center);
    const Mask is_rehit = hn::RebindMask(d, hn::Eq(nearest.index, departed));
    const Triple<V> from_center = plus_scaled(minus(origin, center), direction, nearest.t);
    Triple<V> outward =
        choose(is_rehit, minus_scaled(normal, direction, hn::Add(inwards, inwards)), from_center);
    outward = scaled(outward, hn::Div(one, hn::Sqrt(dot(outward, outward))));
    const V cosine = dot(direction, outward);
    if (HWY_UNLIKELY(view_.keeps_first_hits)) {
      const Mask is_first = hn::RebindMask(d, hn::Eq(depth_left, word(view_.max_depth)));
      add_first_hits(hn::And(hn::And(alive, hit), is_first), nearest, direction, outward, color);
    }

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
      // For spheres in double use the point on the ray, whose distance is accurate: the sphere's
      // size cancels.
      const auto first_exact = word(static_cast<std::uint32_t>(scene_.first_exact));
      origin = choose(hn::RebindMask(d, hn::Lt(nearest.index, first_exact)), origin, on_ray);
    }
    normal = outward;
    departed = nearest.index;

    [[maybe_unused]] Mask is_first = hn::MaskFromVec(zero);  // the hit of a camera ray
    if constexpr (F::kPilot) {
      is_first = hn::RebindMask(d, hn::Eq(depth_left, word(view_.max_depth)));
    }
    depth_left = hn::Sub(depth_left, word(1));
    const Mask shines =
        hn::And(alive, hn::Or(hn::Not(hit), Scattering<T>::has(surface, kEndsPath)));
    const Mask exhausted = hn::And(alive, hn::RebindMask(d, hn::Eq(depth_left, hn::Zero(du))));
    const Mask ended = hn::Or(shines, hn::And(alive, absorbed));
    counts.truncated_paths += hn::CountTrue(d, hn::AndNot(ended, exhausted));
    fresh = hn::Or(ended, exhausted);
    if (HWY_UNLIKELY(emitters != nullptr)) {
      follow_paths(hn::And(shines, hit), nearest.index, fresh, surface, *emitters);
    }
    Mask brings = shines;  // lanes whose path ends with a contribution
    Triple<V> brought = beta;
    if constexpr (F::kLights) {
      const Bits not_diffuse = word(kEndsPath | kMirrors | kRefracts);
      const Mask is_diffuse =
          hn::And(hit, hn::RebindMask(d, hn::Eq(hn::And(surface, not_diffuse), hn::Zero(du))));
      left_diffuse = hn::And(hn::AndNot(fresh, alive), is_diffuse);
      if constexpr (F::kPilot) view_.plain->choices += hn::CountTrue(d, left_diffuse);
      if (!hn::AllFalse(d, left_diffuse)) {
        const auto connection =
            LightConnections<T, F::kMotion>(scene_.lights)
                .connect(left_diffuse,
                         {origin, flipped(outward, hn::AndNot(cosine, hn::SignBit(d))), time},
                         sampler);
        if (!hn::AllFalse(d, connection.exists)) {
          const V rehit = rehit_distance(dot(connection.direction, normal), radius);
          const Nearest met =
              search.find(origin, connection.direction, time, departed, rehit, connection.exists);
          counts.rays += hn::CountTrue(d, connection.exists);
          // If the ray hits or just misses the light's own surface, rounding decides; both count as
          // visible.
          const Mask is_hidden = hn::And(hn::Lt(met.t, connection.distance),
                                         hn::RebindMask(d, hn::Ne(met.index, connection.slot)));
          const Mask is_seen = hn::AndNot(is_hidden, connection.exists);
          if (HWY_UNLIKELY(emitters != nullptr)) {
            const auto direct = [](std::size_t) { return LightPath::Direct; };
            count_reached(is_seen, connection.slot, direct, *emitters);
          }
          const auto add = [&](V sum, V throughput, V radiance) HWY_ATTR {
            return hn::Add(sum, hn::IfThenElseZero(is_seen, hn::Mul(throughput, radiance)));
          };
          gathered = {add(gathered.x, beta.x, connection.radiance.x),
                      add(gathered.y, beta.y, connection.radiance.y),
                      add(gathered.z, beta.z, connection.radiance.z)};
          if constexpr (F::kPilot) {
            PlainPaths& plain = *view_.plain;
            plain.shadow_rays += hn::CountTrue(d, connection.exists);
            plain.connections += hn::CountTrue(d, is_seen);
            const Triple<V> radiance{hn::Mul(beta.x, connection.radiance.x),
                                     hn::Mul(beta.y, connection.radiance.y),
                                     hn::Mul(beta.z, connection.radiance.z)};
            const Mask weighs = hn::And(is_seen, hn::Gt(connection.weight, zero));
            plain.squares += sum_of(weighs, hn::Div(mean_square(radiance), connection.weight));
          }
        }
      }
      const auto whole = [&](V last, V before)
                             HWY_ATTR { return hn::Add(hn::IfThenElseZero(shines, last), before); };
      brought = {whole(beta.x, gathered.x), whole(beta.y, gathered.y), whole(beta.z, gathered.z)};
      brings = fresh;
      if constexpr (F::kPilot) {
        brings = hn::AndNot(is_first, brings);
        view_.plain->squares += sum_of(hn::AndNot(is_first, shines), plain_squares);
      }
      gathered = choose(fresh, Triple<V>{zero, zero, zero}, gathered);
    }
    Mask is_sound = brings;
    const V total = hn::Add(hn::Add(brought.x, brought.y), brought.z);
    const Mask is_finite = hn::Lt(hn::Abs(total), infinity);
    if (HWY_UNLIKELY(!hn::AllFalse(d, hn::AndNot(is_finite, brings)))) {
      counts.nonfinite_samples += hn::CountTrue(d, hn::AndNot(is_finite, brings));
      is_sound = hn::And(brings, is_finite);
    }
    add_to_sums(is_sound, brought);

    const Bits left = hn::Sub(hn::Load(du, samples_left_.data()),
                              hn::IfThenElseZero(hn::RebindMask(du, fresh), word(1)));
    hn::Store(left, du, samples_left_.data());
    const Mask finished = hn::And(fresh, hn::RebindMask(d, hn::Eq(left, hn::Zero(du))));
    if (HWY_UNLIKELY(!hn::AllFalse(d, finished))) {
      finish_parts(finished);
      alive = hn::RebindMask(d, hn::Ne(hn::Load(du, samples_left_.data()), hn::Zero(du)));
      fresh = hn::And(fresh, alive);
    }
  }
}

template <typename T, typename F>
void trace_runs(const WideScene<T>& scene, const WideView<T>& view, std::span<PixelRun> runs,
                TraceCounts& counts, const std::atomic<bool>& cancel) noexcept {
  WidePaths<T, F>(scene, view, runs).trace(counts, cancel);
}

template <typename T, bool kLights, bool kMotion, bool kExactSpheres>
TraceRuns<T>* choose_search(KernelFeatures features) noexcept {
  return features.bvh ? &trace_runs<T, Features<kMotion, kExactSpheres, true, false, kLights>>
                      : &trace_runs<T, Features<kMotion, kExactSpheres, false, false, kLights>>;
}

/// `kLights` as in `features`; it is a template parameter because each value has its own source
/// file.
template <typename T, bool kLights>
TraceRuns<T>* choose_kernel(KernelFeatures features) noexcept {
  if constexpr (sizeof(T) == 8) {
    if (features.instances) {
      return features.motion ? &trace_runs<T, Features<true, false, true, true, kLights>>
                             : &trace_runs<T, Features<false, false, true, true, kLights>>;
    }
  }
  if constexpr (sizeof(T) == 4) {
    if (features.exact_spheres) {
      return features.motion ? choose_search<T, kLights, true, true>(features)
                             : choose_search<T, kLights, false, true>(features);
    }
  }
  return features.motion ? choose_search<T, kLights, true, false>(features)
                         : choose_search<T, kLights, false, false>(features);
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
