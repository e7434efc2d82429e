#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lang/lint/context.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::lang {

/// Some of a scene's spheres as points of four dimensions, centre and radius, so that what lies in
/// what, and what crosses what, is found without trying all pairs. Built by medians in O(n log n).
///
/// A question that looks at more than its share of nodes gets the answer "none": kMostVisits
/// bounds what all questions to one tree may cost, as spheres can be arranged so that no box tells
/// them apart. Which questions those are does not depend on the machine.
class SphereTree {
 public:
  static constexpr std::uint64_t kMostVisits = 12'000'000;

  SphereTree(const LintContext& context, std::span<const std::uint32_t> members);

  /// The members, near ones near each other: in this order questions about them are answered three
  /// times as fast.
  std::vector<std::uint32_t> members() const;

  /// A member, other than `sphere` itself, that `sphere` is wholly inside of, from the opening of
  /// the shutter to its closing.
  std::optional<std::uint32_t> find_around(std::uint32_t sphere);

  struct Crossing {
    std::uint32_t sphere;
    bool is_touch;  ///< one touches the other from inside
  };
  /// An earlier member of another material parameter, such as the index of refraction, whose
  /// surface crosses that of `sphere`, at the opening of the shutter.
  std::optional<Crossing> find_crossing(std::uint32_t sphere);

  /// How many members have the point inside, at the opening of the shutter.
  std::size_t count_around(render::Vec3 point);

 private:
  struct Item {
    render::Vec3 center;
    double radius;
    std::uint32_t sphere;
  };
  struct Node {
    render::Vec3 low, high;  ///< of the centres
    double least, largest;   ///< of the radii
    std::uint32_t first, count;
    std::uint32_t second = 0;  ///< child; the other one follows the node; 0: a leaf
  };

  std::uint32_t build(std::uint32_t first, std::uint32_t count);
  double least_distance(const Node& node, render::Vec3 point) const;
  double largest_distance(const Node& node, render::Vec3 point) const;
  template <typename Enter, typename Look>
  void walk(Enter enter, Look look);

  const LintContext& context_;
  std::vector<Item> items_;
  std::vector<Node> nodes_;
  std::uint64_t visits_ = 0;
};

/// How much the distance of two centres, their radii and places taken together, can be off by
/// rounding, here and in the renderer, generously: what is closer to a limit is not claimed.
double rounding_margin(render::Vec3 a, double radius_a, render::Vec3 b, double radius_b);

/// Whether sphere `a` is wholly inside sphere `b` while the shutter is open. The distance of
/// centres that move straight is a convex function of the time: it is largest at one of the ends.
bool is_inside(const LintContext& context, std::uint32_t a, std::uint32_t b);

/// Whether the point, such as a camera, is inside the sphere from the opening of the shutter to its
/// closing.
bool is_inside(const LintContext& context, render::Vec3 point, std::uint32_t sphere);

/// Whether it may be inside at some moment, or nearly so. What is neither one nor the other is not
/// claimed to be anything.
bool may_be_inside(const LintContext& context, render::Vec3 point, std::uint32_t sphere);

}  // namespace sdlc::lang
