#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lang/lint/context.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::lang {

/// A k-d tree over spheres as points in four dimensions, centre and radius, which finds containing
/// and crossing spheres without testing all pairs. Built by median splits in O(n log n).
///
/// kMaxVisits bounds the nodes that all queries to a tree visit together, because spheres can be
/// arranged so that no bounds separate them. Once it is exceeded, queries find nothing. This does
/// not depend on the machine.
class SphereTree {
 public:
  static constexpr std::uint64_t kMaxVisits = 12'000'000;

  SphereTree(const LintContext& context, std::span<const std::uint32_t> spheres);

  /// The spheres of the tree in an order that keeps near ones together: queries in this order are
  /// three times as fast.
  std::vector<std::uint32_t> spheres() const;

  /// Another sphere of the tree that completely contains `sphere` while the shutter is open.
  std::optional<std::uint32_t> find_container(std::uint32_t sphere);

  struct Crossing {
    std::uint32_t sphere;
    bool is_touch;  ///< one touches the other from inside
  };
  /// A sphere of the tree with a smaller index and a different material parameter, such as the
  /// index of refraction, whose surface crosses that of `sphere` at the opening of the shutter.
  std::optional<Crossing> find_crossing(std::uint32_t sphere);

  /// The number of spheres of the tree that contain the point at the opening of the shutter.
  std::size_t count_containing(render::Vec3 point);

 private:
  struct Item {
    render::Vec3 center;
    double radius;
    std::uint32_t sphere;
  };
  struct Node {
    render::Vec3 low, high;  ///< bounds of the centres
    double min_radius, max_radius;
    std::uint32_t first, count;      ///< items
    std::uint32_t second_child = 0;  ///< the first child follows the node; 0 for a leaf
  };

  std::uint32_t build(std::uint32_t first, std::uint32_t count);
  double min_distance(const Node& node, render::Vec3 point) const;
  double max_distance(const Node& node, render::Vec3 point) const;
  template <typename Enter, typename Visit>
  void walk(Enter enter, Visit visit);

  const LintContext& context_;
  std::vector<Item> items_;
  std::vector<Node> nodes_;
  std::uint64_t visits_ = 0;
};

/// A generous bound on the rounding error of the distance of two centres, here and in the renderer.
/// Nothing is reported for spheres that are closer to a limit than this.
double rounding_margin(render::Vec3 a, double radius_a, render::Vec3 b, double radius_b);

/// Whether sphere `a` is completely inside sphere `b` while the shutter is open. The distance of
/// centres that move straight is a convex function of time, so its maximum is at one of the ends.
bool is_inside(const LintContext& context, std::uint32_t a, std::uint32_t b);

/// Whether the point, such as a camera, is inside the sphere while the shutter is open.
bool is_inside(const LintContext& context, render::Vec3 point, std::uint32_t sphere);

/// Whether the point may be inside the sphere at some moment, or nearly. False only if it is
/// certainly outside.
bool may_be_inside(const LintContext& context, render::Vec3 point, std::uint32_t sphere);

}  // namespace sdlc::lang
