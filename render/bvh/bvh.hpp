#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/math/ray.hpp"
#include "render/math/vec3.hpp"
#include "render/scene/scene.hpp"
#include "render/sphere/intersect.hpp"

namespace sdlc::render {

/// The nearest hit of a ray.
struct BvhHit {
  double t = kNoHit;                 ///< distance along the ray
  std::uint32_t sphere = kNoSphere;  ///< slot in the BVH's own order
};

/// A sphere as the kernel reads it: 32 bytes, two to a cache line.
struct BvhSphere {
  Vec3 center;  ///< at the opening of the shutter
  double radius = 0;
};

/// A bounding volume hierarchy (BVH) over the spheres of a rebased scene, whose extent is at most
/// 2. Built by the surface area heuristic over 16 bins (Wald, "On fast construction of SAH-based
/// bounding volume hierarchies", 2007). Each node has two children whose boxes are stored
/// interleaved, so that both are tested at once. Boxes cover the whole shutter interval.
///
/// The BVH stores the spheres in its own order; a "slot" is an index into it.
class Bvh {
 public:
  Bvh() = default;
  Bvh(std::span<const Sphere> spheres, std::span<const Vec3> shifts);

  /// Returns the nearest hit at t > 0; at equal distances, the sphere with the lowest index in the
  /// scene. The sphere of departure can be hit only from inside.
  template <bool kMoving>
  BvhHit intersect(const Ray& ray, const Departure& departure) const noexcept;

  std::size_t size() const noexcept { return spheres_.size(); }
  const BvhSphere& sphere(std::uint32_t slot) const noexcept { return spheres_[slot]; }
  std::uint32_t index_in_scene(std::uint32_t slot) const noexcept { return indices_[slot]; }
  template <bool kMoving>
  Vec3 center(std::uint32_t slot, double u) const noexcept {
    if constexpr (kMoving) return spheres_[slot].center + shifts_[slot] * u;
    return spheres_[slot].center;
  }
  std::size_t memory_bytes() const noexcept;
  /// Predicts memory_bytes() without building anything, within a factor of 2 for a thousand spheres
  /// or more.
  static std::size_t estimated_bytes(std::size_t spheres, bool is_moving) noexcept;

 private:
  friend class BvhBuilder;

  using Pair = double __attribute__((vector_size(16)));  // one value per child

  /// An inner node if `count` is 0, otherwise the spheres [first, first + count).
  struct Child {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  struct Node {
    std::array<std::array<Pair, 2>, 3> bounds;  // [axis][low, high][child]
    std::array<Child, 2> children;
  };
  static constexpr int kMaxDepth = 96;

  template <bool kMoving>
  void intersect_leaf(const Ray& ray, std::uint32_t departed, Child leaf,
                      BvhHit& hit) const noexcept;

  std::vector<Node> nodes_;
  std::vector<BvhSphere> spheres_;
  std::vector<Vec3> shifts_;  // empty if nothing moves
  std::vector<std::uint32_t> indices_;
  Child root_;
};

template <bool kMoving>
void Bvh::intersect_leaf(const Ray& ray, std::uint32_t departed, Child leaf,
                         BvhHit& hit) const noexcept {
  for (std::uint32_t slot = leaf.first; slot < leaf.first + leaf.count; ++slot) {
    if (slot == departed) continue;
    const Vec3 f = ray.origin - center<kMoving>(slot, ray.u);
    const double t = hit_distance(f, ray.direction, spheres_[slot].radius);
    if (t > hit.t || t == kNoHit) continue;
    if (t == hit.t && indices_[slot] > indices_[hit.sphere]) continue;
    hit = {t, slot};
  }
}

template <bool kMoving>
BvhHit Bvh::intersect(const Ray& ray, const Departure& departure) const noexcept {
  BvhHit hit;
  if (departure.sphere != kNoSphere) {
    const double t =
        rehit_distance(ray.direction, departure.normal, spheres_[departure.sphere].radius);
    if (t != kNoHit) hit = {t, departure.sphere};
  }

  const auto pair = [](double v) { return Pair{v, v}; };
  const Vec3 inverse{1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z};
  const std::array<Pair, 3> origin{pair(ray.origin.x), pair(ray.origin.y), pair(ray.origin.z)};
  const std::array<Pair, 3> scale{pair(inverse.x), pair(inverse.y), pair(inverse.z)};
  const std::array<int, 3> near{inverse.x < 0, inverse.y < 0, inverse.z < 0};

  struct Waiting {
    double t;
    Child child;
  };
  std::array<Waiting, kMaxDepth> stack;
  int waiting = 0;
  Child current = root_;
  while (true) {
    if (current.count > 0) {
      intersect_leaf<kMoving>(ray, departure.sphere, current, hit);
    } else if (!nodes_.empty()) {
      const Node& node = nodes_[current.first];
      Pair enter = pair(0), leave = pair(hit.t);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        // A ray within a side of the box gives 0 · ∞ = NaN. The comparison then keeps the other
        // operand, as if the side were not there.
        const Pair t0 = (node.bounds[axis][near[axis]] - origin[axis]) * scale[axis];
        const Pair t1 = (node.bounds[axis][1 - near[axis]] - origin[axis]) * scale[axis];
        enter = t0 > enter ? t0 : enter;
        leave = t1 < leave ? t1 : leave;
      }
      const bool first = enter[0] <= leave[0], second = enter[1] <= leave[1];
      if (first && second) {
        const int nearer = enter[1] < enter[0];
        stack[waiting++] = {enter[1 - nearer], node.children[1 - nearer]};
        current = node.children[nearer];
        continue;
      }
      if (first || second) {
        current = node.children[second];
        continue;
      }
    }
    do {
      if (waiting == 0) return hit;
      --waiting;
    } while (stack[waiting].t > hit.t);
    current = stack[waiting].child;
  }
}

}  // namespace sdlc::render
