// Finds the first sphere on one ray. Compiled once per instruction set, so it has no include guard
// but Highway's.
// clang-format off
#if defined(SDLC_RENDER_KERNEL_BVH_SEARCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_KERNEL_BVH_SEARCH_INL_H
#undef SDLC_RENDER_KERNEL_BVH_SEARCH_INL_H
#else
#define SDLC_RENDER_KERNEL_BVH_SEARCH_INL_H
#endif
// clang-format on

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include <hwy/highway.h>

#include "render/kernel/wide_scene.hpp"
#include "render/lanes/vector_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A bit mask of the lanes; the first lane is the lowest bit.
template <typename D, typename M>
HWY_INLINE std::uint32_t bits_of(D d, M mask) {
#if HWY_TARGET == HWY_AVX3
  static_cast<void>(d);
  return mask.raw;
#else
  alignas(8) std::array<std::uint8_t, 8> bytes{};  // StoreMaskBits writes 8 bytes
  hn::StoreMaskBits(d, mask, bytes.data());
  return bytes[0];  // at most 8 lanes
#endif
}

/// Finds the nearest sphere of WideScene::bvh for one ray. Uses the same operations as the kernels
/// that test all lanes, so both searches give the same bits.
template <typename T, bool kMotion>
class BvhSearch {
 public:
  /// An upper bound on the error of distances to planes and spheres.
  static constexpr T kRelativeError = 4 * std::numeric_limits<T>::epsilon();

  /// Smaller components of a direction are replaced by this, so that the inverse is finite.
  static constexpr T kMinComponent = static_cast<T>(sizeof(T) == 4 ? 1e-18 : 1e-60);

  /// One number per ray.
  template <typename U>
  using Row = std::array<U, hn::MaxLanes(Lanes<T>())>;
  struct Rays {
    using DR = Lanes<T>;
    using VR = hn::Vec<DR>;

    HWY_INLINE Rays(Triple<VR> from, Triple<VR> along, VR at_time) {
      const DR d;
      store(from, origin);
      store(along, direction);
      hn::Store(at_time, d, time.data());
      const Triple<VR> inverses{inverse_of(along.x), inverse_of(along.y), inverse_of(along.z)};
      store(inverses, inverse);
      const Triple<VR> offset{hn::Mul(from.x, inverses.x), hn::Mul(from.y, inverses.y),
                              hn::Mul(from.z, inverses.z)};
      // Bounds that hold at any distance of the origin from the boxes.
      const VR more = hn::Set(d, 1 + kRelativeError), less = hn::Set(d, 1 - kRelativeError);
      const auto bounds = [&](VR v) HWY_ATTR {
        const VR a = hn::Mul(v, more), b = hn::Mul(v, less);
        return std::array<VR, 2>{hn::Max(a, b), hn::Min(a, b)};
      };
      const auto x = bounds(offset.x), y = bounds(offset.y), z = bounds(offset.z);
      store({x[0], y[0], z[0]}, max_offset);
      store({x[1], y[1], z[1]}, min_offset);
    }

    alignas(64) std::array<Row<T>, 3> origin, direction;
    /// The ray intersects the plane x = p at p · inverse − offset.
    alignas(64) std::array<Row<T>, 3> inverse, max_offset, min_offset;
    alignas(64) Row<T> time;

   private:
    /// Finite, so that no product is NaN. A ray within a side of a box counts as a hit.
    static HWY_INLINE VR inverse_of(VR along) {
      const DR d;
      const VR min_component = hn::Set(d, kMinComponent);
      return hn::Div(hn::Set(d, T{1}), hn::CopySign(hn::Max(hn::Abs(along), min_component), along));
    }
    static HWY_INLINE void store(Triple<VR> v, std::array<Row<T>, 3>& to) {
      const DR d;
      hn::Store(v.x, d, to[0].data());
      hn::Store(v.y, d, to[1].data());
      hn::Store(v.z, d, to[2].data());
    }
  };
  struct Hit {
    T t;
    std::uint32_t slot;
  };

  using D = Lanes<T>;
  using V = hn::Vec<D>;
  static constexpr std::size_t kLanes = hn::MaxLanes(D());
  static constexpr std::size_t kParts = kBvhWidth / kLanes;  // number of vectors that hold all
                                                             // children

  /// One ray, with each of its numbers in all lanes.
  struct Ray {
    Triple<V> origin, direction;
    V time;
    Triple<V> inverse, max_offset, min_offset;
    std::array<std::size_t, 3> near;  // per axis, the index of the bound that the ray crosses first

    HWY_INLINE Ray(const Rays& rays, std::size_t lane)
        : origin(spread_row(rays.origin, lane)),
          direction(spread_row(rays.direction, lane)),
          time(hn::Set(D(), rays.time[lane])),
          inverse(spread_row(rays.inverse, lane)),
          max_offset(spread_row(rays.max_offset, lane)),
          min_offset(spread_row(rays.min_offset, lane)) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        near[axis] = std::signbit(rays.inverse[axis][lane]) ? 1 : 0;
      }
    }

    /// `along` has unit length.
    HWY_INLINE Ray(Triple<T> from, Triple<T> along, T at_time)
        : origin(spread(from)), direction(spread(along)), time(hn::Set(D(), at_time)) {
      const Triple<T> inverses{inverse_of(along.x), inverse_of(along.y), inverse_of(along.z)};
      const Triple<T> offset{from.x * inverses.x, from.y * inverses.y, from.z * inverses.z};
      inverse = spread(inverses);
      max_offset = spread({upper_bound(offset.x), upper_bound(offset.y), upper_bound(offset.z)});
      min_offset =
          spread({-upper_bound(-offset.x), -upper_bound(-offset.y), -upper_bound(-offset.z)});
      near = {std::signbit(along.x) ? 1U : 0U, std::signbit(along.y) ? 1U : 0U,
              std::signbit(along.z) ? 1U : 0U};
    }

   private:
    static T inverse_of(T along) {
      return T{1} / std::copysign(std::max(std::fabs(along), kMinComponent), along);
    }
    static T upper_bound(T offset) {
      return std::max(offset * (1 + kRelativeError), offset * (1 - kRelativeError));
    }
    static HWY_INLINE Triple<V> spread(Triple<T> v) {
      const D d;
      return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
    }
    static HWY_INLINE Triple<V> spread_row(const std::array<Row<T>, 3>& rows, std::size_t lane) {
      const D d;
      return {hn::Set(d, rows[0][lane]), hn::Set(d, rows[1][lane]), hn::Set(d, rows[2][lane])};
    }
  };

  HWY_INLINE explicit BvhSearch(const WideScene<T>& scene) : scene_(scene) {}

  /// Updates `hit` with the nearest sphere below the node `root`; ties go to the first sphere in
  /// the scene. Ignores the sphere `departed`.
  HWY_INLINE void find(std::uint32_t root, const Ray& ray, std::uint32_t departed, Hit& hit) const {
    walk(root, ray, hit.t,
         [&](std::size_t first) HWY_ATTR { meet_leaf(first, ray, departed, hit); });
  }

  /// A sphere of an instance, or of the world.
  struct Placed {
    std::uint32_t slot, row;
  };
  struct PlacedHit {
    T t;
    Placed sphere;
  };

  /// The same over the world and all instances, for the ray of a lane.
  void find_placed(const Rays& rays, std::size_t lane, Placed departed, PlacedHit& hit) const {
    const InstanceTable& table = scene_.instances;
    const Ray ray(rays, lane);
    if (table.world_root != InstanceTable::kNone) {
      find_in(table.world_root, 0, ray, T{1}, T{1}, departed, hit);
    }
    walk(table.root, ray, hit.t, [&](std::size_t first) HWY_ATTR {
      alignas(64) std::array<T, kBvhWidth> entries;
      for (std::uint32_t met = hit_bounds(first, ray, max_entry(hit.t), entries); met != 0;) {
        auto nearest = static_cast<std::size_t>(std::countr_zero(met));
        for (std::uint32_t rest = met & (met - 1); rest != 0; rest &= rest - 1) {
          const auto child = static_cast<std::size_t>(std::countr_zero(rest));
          if (entries[child] < entries[nearest]) nearest = child;
        }
        if (entries[nearest] > max_entry(hit.t)) return;
        met &= ~(std::uint32_t{1} << nearest);
        const std::uint32_t row = table.row_of_bounds[first - table.first_bounds + nearest];
        find_in_instance(row, rays, lane, departed, hit);
      }
    });
  }

  /// The largest box distance at which a sphere hit at `t` is still possible: the error of a
  /// grazing hit on a sphere of radius r ≤ 2 is at most √(2u (t + r) r) along the ray, which is
  /// smaller.
  static HWY_INLINE T max_entry(T t) {
    constexpr T kGrazing = sizeof(T) == 4 ? 0x1p-10 : 0x1p-25;
    return t * (1 + kGrazing) + kGrazing;
  }

  /// The distances at which a ray enters boxes, and a mask of those it hits.
  struct Boxes {
    V entry;
    hn::Mask<D> met;
  };
  /// Tests as many children of a node as a vector has lanes; hits must be before `farthest`.
  static HWY_INLINE Boxes meet_part(const typename WideBvh<T>::Node& node, std::size_t part,
                                    const Ray& ray, V farthest) {
    const D d;
    const auto bound = [&](std::size_t axis, std::size_t side) HWY_ATTR {
      return hn::Load(d, node.bounds[axis][side].data() + part * kLanes);
    };
    const auto& near = ray.near;
    const V enter_x = hn::MulSub(bound(0, near[0]), ray.inverse.x, ray.max_offset.x);
    const V enter_y = hn::MulSub(bound(1, near[1]), ray.inverse.y, ray.max_offset.y);
    const V enter_z = hn::MulSub(bound(2, near[2]), ray.inverse.z, ray.max_offset.z);
    const V leave_x = hn::MulSub(bound(0, 1 - near[0]), ray.inverse.x, ray.min_offset.x);
    const V leave_y = hn::MulSub(bound(1, 1 - near[1]), ray.inverse.y, ray.min_offset.y);
    const V leave_z = hn::MulSub(bound(2, 1 - near[2]), ray.inverse.z, ray.min_offset.z);
    const V entry = hn::Max(hn::Max(enter_x, enter_y), hn::Max(enter_z, hn::Zero(d)));
    const V leave = hn::Min(hn::Min(leave_x, leave_y), hn::Min(leave_z, farthest));
    return {entry, hn::Le(entry, leave)};
  }

  /// The chords of spheres on a ray.
  struct Chords {
    V closest;
    V discriminant;  // negative if the ray misses

    /// NaN if the ray misses, negative if the sphere is behind it.
    HWY_INLINE V first_place() const {
      const V half_chord = hn::Sqrt(discriminant);
      const V enters = hn::Sub(closest, half_chord), leaves = hn::Add(closest, half_chord);
      return hn::IfThenElse(hn::Ge(enters, hn::Zero(D())), enters, leaves);
    }
  };
  /// The spheres of as many slots as a vector has lanes.
  HWY_INLINE Chords cut_spheres(std::size_t first, const Ray& ray) const {
    const D d;
    Triple<V> center = load(scene_.center, first);
    if constexpr (kMotion) center = plus_scaled(center, load(scene_.shift, first), ray.time);
    const Triple<V> to_center = minus(center, ray.origin);
    const V closest = dot(to_center, ray.direction);
    const V radius = hn::Load(d, scene_.radius.data() + first);
    return {closest,
            chord_discriminant(to_center, ray.direction, closest, hn::Mul(radius, radius))};
  }

  /// The order of spheres at equal distance. Spheres in double come after the others, as when all
  /// are tested in order.
  HWY_INLINE bool comes_first(std::uint32_t slot, std::uint32_t before) const {
    return before >= scene_.first_exact ||
           scene_.index_in_scene[slot] <= scene_.index_in_scene[before];
  }

 private:
  /// Calls `on_leaf` with the first slot of each leaf below `root` that the ray enters before
  /// `farthest`, which `on_leaf` may decrease. The order is approximately front to back.
  template <typename OnLeaf>
  HWY_INLINE void walk(std::uint32_t root, const Ray& ray, const T& farthest,
                       const OnLeaf& on_leaf) const {
    // Only the part of the stack that is used is touched.
    struct Waiting {
      T t;
      std::uint32_t child;
    };
    Waiting stack[WideBvh<T>::kMaxWaiting];  // NOLINT: not initialised
    std::size_t waiting = 0;
    std::uint32_t current = root;
    while (true) {
      if ((current & WideBvh<T>::kLeaf) != 0) {
        on_leaf(std::size_t{current & ~WideBvh<T>::kLeaf} * kBvhWidth);
      } else {
        const auto& node = scene_.bvh.nodes[current];
        alignas(64) std::array<T, kBvhWidth> entries;
        std::uint32_t met = meet_boxes(node, ray, max_entry(farthest), entries);
        if (std::has_single_bit(met)) {
          current = node.children[static_cast<std::size_t>(std::countr_zero(met))];
          continue;
        }
        const std::size_t before = waiting;
        for (; met != 0; met &= met - 1) {  // the nearest one ends up on top
          const auto child = static_cast<std::size_t>(std::countr_zero(met));
          const Waiting box{entries[child], node.children[child]};
          std::size_t place = waiting++;
          for (; place > before && stack[place - 1].t < box.t; --place) {
            stack[place] = stack[place - 1];
          }
          stack[place] = box;
        }
      }
      do {
        if (waiting == 0) return;
        --waiting;
      } while (stack[waiting].t > max_entry(farthest));
      current = stack[waiting].child;
    }
  }

  /// A mask of the children whose boxes the ray hits before `farthest`, and the entry distances.
  HWY_INLINE std::uint32_t meet_boxes(const typename WideBvh<T>::Node& node, const Ray& ray,
                                      T farthest, std::array<T, kBvhWidth>& entries) const {
    const D d;
    std::uint32_t met = 0;
    for (std::size_t part = 0; part < kParts; ++part) {
      const Boxes boxes = meet_part(node, part, ray, hn::Set(d, farthest));
      hn::Store(boxes.entry, d, entries.data() + part * kLanes);
      met |= bits_of(d, boxes.met) << (part * kLanes);
    }
    return met;
  }

  /// find() for the spheres of one instance (row), with the ray in its coordinates: world lengths
  /// are `scale` times the lengths there.
  HWY_INLINE void find_in(std::uint32_t root, std::uint32_t row, const Ray& ray, T scale,
                          T inverse_scale, Placed departed, PlacedHit& hit) const {
    constexpr std::uint32_t kNone = 0xFFFFFFFF;
    const bool is_within = hit.sphere.row == row;
    const std::uint32_t known = is_within ? hit.sphere.slot : kNone;
    // Ties between instances are decided in world coordinates below, so rounding must not decide
    // them here.
    constexpr T kSlack = 1 + 4 * std::numeric_limits<T>::epsilon();
    const T t_known = is_within ? hit.t * inverse_scale : hit.t * inverse_scale * kSlack;
    Hit here{t_known, known};
    find(root, ray, departed.row == row ? departed.slot : kNone, here);
    if (here.slot == known && here.t == t_known)
      return;  // before the first hit, slot 0 is the
               // known one
    const T t = here.t * scale;
    // Among instances at equal distance the first one wins.
    if (!is_within && (t > hit.t || (t == hit.t && row > hit.sphere.row))) return;
    hit = {t, {here.slot, row}};
  }

  HWY_NOINLINE void find_in_instance(std::uint32_t row, const Rays& rays, std::size_t lane,
                                     Placed departed, PlacedHit& hit) const {
    const InstanceTable& table = scene_.instances;
    const double* numbers = table.rows.data() + row * InstanceTable::kRowSize;
    Triple<T> from{rays.origin[0][lane] - numbers[InstanceTable::kTranslate],
                   rays.origin[1][lane] - numbers[InstanceTable::kTranslate + 1],
                   rays.origin[2][lane] - numbers[InstanceTable::kTranslate + 2]};
    if constexpr (kMotion) {
      if (!table.shift[0].empty()) {
        from = {from.x - table.shift[0][row] * rays.time[lane],
                from.y - table.shift[1][row] * rays.time[lane],
                from.z - table.shift[2][row] * rays.time[lane]};
      }
    }
    const Triple<T> along{rays.direction[0][lane], rays.direction[1][lane],
                          rays.direction[2][lane]};
    const auto on_axis = [&](std::size_t axis, Triple<T> v, T factor) {
      const double* along_axis = numbers + InstanceTable::kAxes + 3 * axis;
      return (along_axis[0] * v.x + along_axis[1] * v.y + along_axis[2] * v.z) * factor;
    };
    const T inverse_scale = numbers[InstanceTable::kInverseScale];
    const Triple<T> origin{on_axis(0, from, inverse_scale), on_axis(1, from, inverse_scale),
                           on_axis(2, from, inverse_scale)};
    const Triple<T> direction{on_axis(0, along, 1), on_axis(1, along, 1), on_axis(2, along, 1)};
    find_in(static_cast<std::uint32_t>(numbers[InstanceTable::kRoot]), row,
            Ray(origin, direction, rays.time[lane]), numbers[InstanceTable::kScale], inverse_scale,
            departed, hit);
  }

  /// A mask of the bounding spheres of a leaf that the ray hits before `farthest`, and the entry
  /// distances.
  HWY_INLINE std::uint32_t hit_bounds(std::size_t first, const Ray& ray, T farthest,
                                      std::array<T, kBvhWidth>& entries) const {
    const D d;
    std::uint32_t met = 0;
    for (std::size_t part = 0; part < kParts; ++part) {
      const Chords chords = cut_spheres(first + part * kLanes, ray);
      const V half_chord = hn::Sqrt(chords.discriminant);  // NaN if it misses
      const V enters = hn::Max(hn::Sub(chords.closest, half_chord), hn::Zero(d));
      const auto is_met = hn::And(hn::Ge(hn::Add(chords.closest, half_chord), hn::Zero(d)),
                                  hn::Le(enters, hn::Set(d, farthest)));
      hn::Store(enters, d, entries.data() + part * kLanes);
      met |= bits_of(d, is_met) << (part * kLanes);
    }
    return met;
  }

  HWY_INLINE void meet_leaf(std::size_t first, const Ray& ray, std::uint32_t departed,
                            Hit& hit) const {
    const D d;
    for (std::size_t slot = first; slot < first + kBvhWidth; slot += kLanes) {
      const Chords chords = cut_spheres(slot, ray);
      if (hn::AllFalse(d, hn::Ge(chords.discriminant, hn::Zero(d)))) continue;
      const V t = chords.first_place();
      const auto is_near = hn::And(hn::Ge(t, hn::Zero(d)), hn::Le(t, hn::Set(d, hit.t)));
      std::uint32_t near = bits_of(d, is_near);
      if (near == 0) continue;
      alignas(64) std::array<T, kLanes> distances;
      hn::Store(t, d, distances.data());
      for (; near != 0; near &= near - 1) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
        take_if_nearer(distances[lane], static_cast<std::uint32_t>(slot) + lane, departed, hit);
      }
    }
  }

  HWY_INLINE void take_if_nearer(T t, std::uint32_t slot, std::uint32_t departed, Hit& hit) const {
    if (t > hit.t || slot == departed) return;
    if constexpr (kIsPortable) {
      if (departed == scene_.kSeveralCameraSpheres && scene_.has_camera_on(slot)) return;
    }
    if (t == hit.t && !comes_first(slot, hit.slot)) return;
    hit = {t, slot};
  }

  static HWY_INLINE Triple<V> load(const typename WideScene<T>::TableTriple& tables,
                                   std::size_t slot) {
    const D d;
    return {hn::Load(d, tables[0].data() + slot), hn::Load(d, tables[1].data() + slot),
            hn::Load(d, tables[2].data() + slot)};
  }

  const WideScene<T>& scene_;
};

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
