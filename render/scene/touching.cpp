#include "render/scene/touching.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "render/scene/camera_surface.hpp"
#include "render/scene/movement.hpp"
#include "render/scene/near_pairs.hpp"

namespace sdlc::render {
namespace {

// Of a point's distance to another surface, in units of rounding times an extent, at most.
constexpr double kPointError = 4;
constexpr double kMostOfRadius = 1.0 / 64;

/// Of two spheres that touch.
struct Contact {
  std::uint32_t large, small;
  double apart;      // the centres, when the surfaces are nearest
  bool is_inside;    // the small one, in the large one
  double least_gap;  // that there is to be
};

class Parting {
 public:
  Parting(Scene& scene, double unit, std::span<const std::uint32_t> exact)
      : scene_(scene), unit_(unit), exact_(exact) {}

  void run() {
    find_contacts();
    // Each sphere after all that are larger: those have their own radius by then.
    std::sort(contacts_.begin(), contacts_.end(), [&](const Contact& a, const Contact& b) {
      return a.small != b.small ? is_larger(a.small, b.small) : is_larger(a.large, b.large);
    });
    for (std::size_t begin = 0, end; begin < contacts_.size(); begin = end) {
      const std::uint32_t small = contacts_[begin].small;
      end = begin;
      while (end < contacts_.size() && contacts_[end].small == small) ++end;
      shrink(small, std::span(contacts_).subspan(begin, end - begin));
    }
  }

 private:
  void find_contacts() {
    const Nearness nearness{.gap_of_extent = kPointError * unit_};
    for (const auto& [a, b] : find_near_pairs(scene_, {}, nearness, exact_)) add_contacts(a, b);
    for (std::uint32_t i = 0; i < scene_.spheres.size(); ++i) {
      for (const std::uint32_t exact : exact_) {
        if (!is_exact(i) || i < exact) add_contacts(i, exact);
      }
    }
  }

  void add_contacts(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t large = is_larger(a, b) ? a : b, small = is_larger(a, b) ? b : a;
    const double least_gap = kPointError * unit_ * extent(large, small);
    const Vec3 from = opening(large) - opening(small);
    const Vec3 way = closing(large) - closing(small) - from;
    const double nearest = length(from + way * nearest_moment(from, way));
    const double farthest = std::max(length(from), length(from + way));
    if (std::fabs(nearest - radius(large) - radius(small)) < least_gap) {
      contacts_.push_back({large, small, nearest, false, least_gap});
    }
    if (std::fabs(radius(large) - radius(small) - farthest) < least_gap) {
      contacts_.push_back({large, small, farthest, true, least_gap});
    }
  }

  void shrink(std::uint32_t small, std::span<const Contact> contacts) {
    Sphere& sphere = scene_.spheres[small];
    const Vec3 shift = scene_.shifts.empty() ? Vec3{} : scene_.shifts[small];
    if (!(sphere.radius > 0) || has_camera_on_it(sphere, shift)) return;
    double radius = sphere.radius;
    for (const Contact& contact : contacts) {
      const double of_large = scene_.spheres[contact.large].radius;
      const double up_to = contact.is_inside ? of_large - contact.apart : contact.apart - of_large;
      radius = std::min(radius, up_to - contact.least_gap);
    }
    if (radius >= (1 - kMostOfRadius) * sphere.radius) sphere.radius = radius;
  }

  bool is_exact(std::uint32_t i) const {
    return std::find(exact_.begin(), exact_.end(), i) != exact_.end();
  }
  bool is_larger(std::uint32_t a, std::uint32_t b) const {
    return radius(a) != radius(b) ? radius(a) > radius(b) : a < b;
  }
  double radius(std::uint32_t i) const { return scene_.spheres[i].radius; }
  Vec3 opening(std::uint32_t i) const { return scene_.spheres[i].center; }
  Vec3 closing(std::uint32_t i) const {
    return scene_.shifts.empty() ? opening(i) : opening(i) + scene_.shifts[i];
  }
  double extent(std::uint32_t i) const {
    return std::max(length(opening(i)), length(closing(i))) + radius(i);
  }
  /// Where the two are near each other, how far that is from the camera at most.
  double extent(std::uint32_t a, std::uint32_t b) const {
    if (is_exact(a) != is_exact(b)) return extent(is_exact(a) ? b : a);
    return std::max(extent(a), extent(b));
  }

  Scene& scene_;
  double unit_;
  std::span<const std::uint32_t> exact_;
  std::vector<Contact> contacts_;
};

}  // namespace

void part_touching(Scene& scene, Precision precision, std::span<const std::uint32_t> exact) {
  Parting(scene, unit_of_rounding(precision), exact).run();
}

}  // namespace sdlc::render
