// Where rays hit, and what they find there. Compiled once per instruction set, so it has no include
// guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_KERNEL_INTERACTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_KERNEL_INTERACTION_INL_H
#undef SDLC_RENDER_KERNEL_INTERACTION_INL_H
#else
#define SDLC_RENDER_KERNEL_INTERACTION_INL_H
#endif
// clang-format on

#include <cstddef>
#include <cstdint>
#include <limits>

#include <hwy/highway.h>

#include "render/kernel/nearest-inl.h"
#include "render/kernel/paths-inl.h"
#include "render/kernel/wide_scene.hpp"
#include "render/lanes/table_reader-inl.h"
#include "render/lanes/vector_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The nearest sphere on each ray.
template <typename T>
struct Hit {
  using V = hn::Vec<Lanes<T>>;
  using Bits = hn::Vec<hn::RebindToUnsigned<Lanes<T>>>;

  V distance;  ///< infinite without a hit
  Bits index;  ///< of the sphere, as NearestSphere::Nearest::index
  V cosine;    ///< of the ray and Paths::normal, where it starts
};

/// The surface at a hit, or the sky.
template <typename T>
struct Interaction {
  using D = Lanes<T>;
  using V = hn::Vec<D>;
  using Bits = hn::Vec<hn::RebindToUnsigned<D>>;

  hn::Mask<D> is_hit;  ///< otherwise the sky
  TableReader<D> by_slot, by_optics;
  Bits surface;      ///< SurfaceBits, 0 for the sky
  Triple<V> color;   ///< attenuation; where the path ends, emitted radiance
  Triple<V> center;  ///< of the sphere, in the world
  V scale;           ///< of the sphere's instance
  Triple<V> normal;  ///< outward
  V cosine;          ///< of ray and normal
};

template <typename T, typename F>
class Interactions {
 public:
  using D = Lanes<T>;
  using DU = hn::RebindToUnsigned<D>;
  using V = hn::Vec<D>;
  using Bits = hn::Vec<DU>;
  using Mask = hn::Mask<D>;
  using Search = NearestSphere<T, F>;

  explicit HWY_INLINE Interactions(const WideScene<T>& scene) : scene_(scene) {}

  HWY_INLINE Interaction<T> at(const Paths<T>& paths, const Hit<T>& hit) const;
  HWY_INLINE void depart(Paths<T>& paths, const Hit<T>& hit, const Interaction<T>& at) const;
  /// Reads WideScene::bsdf for the spheres in these slots.
  HWY_INLINE TableReader<D> optics_of(Bits slot) const {
    return optics_reader(material_reader(TableReader<D>(slot, scene_.slots)));
  }

 private:
  HWY_INLINE TableReader<D> material_reader(const TableReader<D>& by_slot) const {
    if constexpr (F::kBvh) return {by_slot(scene_.material), scene_.materials};
    return by_slot;
  }
  HWY_INLINE TableReader<D> optics_reader(const TableReader<D>& by_material) const {
    if constexpr (F::kBvh) return {by_material(scene_.optics), scene_.optics_rows};
    return by_material;
  }

  const WideScene<T>& scene_;
};

template <typename T, typename F>
auto Interactions<T, F>::at(const Paths<T>& paths, const Hit<T>& hit) const -> Interaction<T> {
  const D d;
  const DU du;
  const V one = hn::Set(d, T{1});
  Mask is_hit = hn::Lt(hit.distance, hn::Set(d, std::numeric_limits<T>::infinity()));
  TableReader<D> by_slot(Search::slot_of(hit.index), scene_.slots);
  TableReader<D> by_material = material_reader(by_slot);
  TableReader<D> by_optics = optics_reader(by_material);
  Bits surface = hn::IfThenElseZero(hn::RebindMask(du, is_hit), by_optics(scene_.bsdf.surface));
  const Triple<V> color = by_material(scene_.color);
  const Triple<V> sky =
      plus_scaled(spread(d, scene_.sky_center), spread(d, scene_.sky_slope), paths.direction.y);

  // Relative to the centre, not in world coordinates: the distance to the origin cancels.
  Triple<V> center = by_slot(scene_.center);
  if constexpr (F::kMotion) center = plus_scaled(center, by_slot(scene_.shift), paths.time);
  V scale = one;
  if constexpr (F::kInstances) {
    scale = Search(scene_).place_in_world(hit.index, paths.time, center);
  }
  const Mask is_rehit = hn::RebindMask(d, hn::Eq(hit.index, paths.departed));
  const Triple<V> from_center =
      plus_scaled(minus(paths.origin, center), paths.direction, hit.distance);
  const Triple<V> reflected =
      minus_scaled(paths.normal, paths.direction, hn::Add(hit.cosine, hit.cosine));
  Triple<V> normal = choose(is_rehit, reflected, from_center);
  normal = scaled(normal, hn::Div(one, hn::Sqrt(dot(normal, normal))));
  return {.is_hit = is_hit,
          .by_slot = by_slot,
          .by_optics = by_optics,
          .surface = surface,
          .color = choose(is_hit, color, sky),
          .center = center,
          .scale = scale,
          .normal = normal,
          .cosine = dot(paths.direction, normal)};
}

/// Moves the paths to the surface.
template <typename T, typename F>
void Interactions<T, F>::depart(Paths<T>& paths, const Hit<T>& hit,
                                const Interaction<T>& at) const {
  const D d;
  paths.radius = at.by_slot(scene_.radius);
  if constexpr (F::kInstances) paths.radius = hn::Mul(paths.radius, at.scale);
  const Triple<V> on_ray = plus_scaled(paths.origin, paths.direction, hit.distance);
  paths.origin = plus_scaled(at.center, at.normal, paths.radius);
  if constexpr (F::kExactSpheres) {
    // For spheres in double use the point on the ray, whose distance is accurate: the sphere's size
    // cancels.
    const auto first_exact = hn::Set(DU(), static_cast<std::uint32_t>(scene_.first_exact));
    const Mask has_table = hn::RebindMask(d, hn::Lt(hit.index, first_exact));
    paths.origin = choose(has_table, paths.origin, on_ray);
  }
  paths.normal = at.normal;
  paths.departed = hit.index;
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
