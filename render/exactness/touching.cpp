#include "render/exactness/touching.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "render/exactness/camera_surface.hpp"
#include "render/exactness/camera_view.hpp"
#include "render/exactness/movement.hpp"
#include "render/exactness/near_pairs.hpp"

namespace sdlc::render {
namespace {

constexpr double kMaxShrinkage = 1.0 / 64;

/// Two separate spheres at their closest approach.
struct Contact {
  std::uint32_t large, small;
  double apart;    // distance of the centres
  bool is_inside;  // the small sphere is inside the large one
  double min_gap;  // the required gap
};

class Parting {
 public:
  Parting(Scene& scene, double unit, std::span<const std::uint32_t> exact)
      : scene_(scene), unit_(unit), exact_(exact) {}

  void run(std::optional<std::span<const SpherePair>> known) {
    if (known) {
      find_contacts(*known);
    } else {
      const Nearness nearness{.gap_of_extent = kContactReach * kMinGap * unit_};
      const auto pairs = find_near_pairs(CameraView(scene_, scene_.camera), nearness, exact_);
      if (!pairs) return;
      find_contacts(*pairs);
    }
    // Process each sphere after all larger ones, whose radii are final by then.
    std::sort(contacts_.begin(), contacts_.end(), [&](const Contact& a, const Contact& b) {
      return a.small != b.small ? is_larger(scene_, a.small, b.small)
                                : is_larger(scene_, a.large, b.large);
    });
    for (std::size_t begin = 0, end; begin < contacts_.size(); begin = end) {
      const std::uint32_t small = contacts_[begin].small;
      end = begin;
      while (end < contacts_.size() && contacts_[end].small == small) ++end;
      shrink(small, std::span(contacts_).subspan(begin, end - begin));
    }
  }

 private:
  void find_contacts(std::span<const SpherePair> pairs) {
    for_each_pair(scene_, pairs, exact_,
                  [&](std::uint32_t large, std::uint32_t small) { add_contacts(large, small); });
  }

  void add_contacts(std::uint32_t large, std::uint32_t small) {
    const Vec3 from = opening(large) - opening(small);
    const Vec3 displacement = closing(large) - closing(small) - from;
    const double nearest = length(from + displacement * nearest_moment(from, displacement));
    const double farthest = std::max(length(from), length(from + displacement));
    const auto add = [&](double apart, bool is_inside) {
      const double required = min_gap(large, small, is_inside);
      const double gap =
          is_inside ? radius(large) - radius(small) - apart : apart - radius(large) - radius(small);
      if (gap <= -required || gap >= kContactReach * required ||
          kBriefly * length(displacement) > required)
        return;
      contacts_.push_back({large, small, apart, is_inside, required});
    };
    add(nearest, false);
    add(farthest, true);
  }

  void shrink(std::uint32_t small, std::span<const Contact> contacts) {
    Sphere& sphere = scene_.spheres[small];
    const Vec3 shift = scene_.shifts.empty() ? Vec3{} : scene_.shifts[small];
    if (!(sphere.radius > 0) || has_camera_on_it(sphere, shift)) return;
    double radius = sphere.radius;
    for (const Contact& contact : contacts) {
      const double of_large = scene_.spheres[contact.large].radius;
      const double up_to = contact.is_inside ? of_large - contact.apart : contact.apart - of_large;
      radius = std::min(radius, up_to - contact.min_gap);
    }
    if (radius >= (1 - kMaxShrinkage) * sphere.radius) sphere.radius = radius;
  }

  bool is_exact(std::uint32_t i) const { return contains(exact_, i); }
  double radius(std::uint32_t i) const { return scene_.spheres[i].radius; }
  Vec3 opening(std::uint32_t i) const { return scene_.spheres[i].center; }
  Vec3 closing(std::uint32_t i) const {
    return scene_.shifts.empty() ? opening(i) : opening(i) + scene_.shifts[i];
  }
  double extent(std::uint32_t i) const {
    return std::max(length(opening(i)), length(closing(i))) + radius(i) +
           scene_.camera.aperture / 2;
  }

  /// Twice the error of points on the two spheres near their contact.
  double min_gap(std::uint32_t large, std::uint32_t small, bool is_inside) const {
    const double unit = kMinGap * unit_;
    if (!is_exact(large) && !is_exact(small)) {
      return unit * std::max(extent(large), extent(small));
    }
    if (!is_exact(large)) return unit * extent(large);
    if (!is_exact(small)) return unit * extent(small);
    // Both are computed in double. A point at a distance s from the contact at c has an error of
    // unit · (|c| + s), and the surfaces are s² / 2R apart there, where 1/R is the sum or
    // difference of the curvatures. Beyond the distance where the gap is larger, points are
    // accurate enough.
    const Vec3 to_small = opening(small) - opening(large);
    const Vec3 contact = opening(large) + to_small * (radius(large) / length(to_small));
    const double curvature = 1 / radius(small) + (is_inside ? -1 : 1) / radius(large);
    const double c = length(contact), ur = unit * (curvature > 0 ? 1 / curvature : 1 / unit);
    return unit *
           std::min(c + ur + std::sqrt(ur * (ur + 2 * c)), std::max(extent(large), extent(small)));
  }

  Scene& scene_;
  double unit_;
  std::span<const std::uint32_t> exact_;
  std::vector<Contact> contacts_;
};

}  // namespace

void part_touching(Scene& scene, Precision precision, std::span<const std::uint32_t> exact,
                   std::optional<std::span<const SpherePair>> known) {
  Parting(scene, unit_of_rounding(precision), exact).run(known);
}

}  // namespace sdlc::render
