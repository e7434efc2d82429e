#include "render/exactness/radiance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "render/parallel/ranges.hpp"

namespace sdlc::render {
namespace {

double brightest(LinearRgb c) { return std::max({c.r, c.g, c.b}); }

/// Finds the number with the largest factor to 1, up or down, among numbers of at least 0; the
/// first one if there are several.
class Farthest {
 public:
  explicit Farthest(double max)
      : bound_{.value = 1, .share = 0, .limit = max, .sphere = {}, .other = {}}, max_(max) {}

  const PrecisionBound& bound() const { return bound_; }
  std::optional<std::size_t> material() const { return material_; }

  /// `material` has the number; nullopt: the sky.
  void add(double v, std::optional<std::size_t> material) {
    if (v >= low_ && v <= high_) return;  // fast path without a division
    const double factor = v >= 1 ? v : 1 / v;
    if (v == 0 || factor / max_ <= bound_.share) return;
    bound_.value = v;
    bound_.share = factor / max_;
    bound_.limit = v >= 1 ? max_ : 1 / max_;
    material_ = material;
    high_ = factor;
    low_ = 1 / factor * (1 + 0x1p-50);  // covers rounding
  }
  void add(LinearRgb c, std::optional<std::size_t> material) {
    for (const double v : {c.r, c.g, c.b}) add(v, material);
  }
  void join(const Farthest& later) {
    if (later.bound_.share > bound_.share) *this = later;
  }

 private:
  PrecisionBound bound_;
  std::optional<std::size_t> material_;
  double max_;
  double low_ = 2, high_ = 1;  // no number in between can be farther; initially empty
};

/// The largest number, and its material; nullopt: the sky, or none.
struct Largest {
  double value;
  std::optional<std::size_t> material{};

  void add(double v, std::optional<std::size_t> of) {
    if (v > value) *this = {v, of};
  }
};

/// Collects limits of a scene's materials.
struct Surfaces {
  Farthest farthest;
  Largest light{0};  // the brightest
  Largest gain{1};   // max factor by which a reflection multiplies radiance

  void add(const Material& material, std::size_t i) {
    farthest.add(material.color, i);
    farthest.add(material.parameter, i);
    if (material.type == MaterialType::Emissive) {
      light.add(brightest(material.color * material.parameter), i);
    } else if (material.type == MaterialType::Unlit) {
      light.add(brightest(material.color), i);
    } else {
      gain.add(brightest(material.color), i);
    }
  }
  void join(const Surfaces& later) {
    farthest.join(later.farthest);
    light.add(later.light.value, later.light.material);
    gain.add(later.gain.value, later.gain.material);
  }
};

/// The first sphere with this material, except for spheres of instances.
std::optional<std::uint32_t> sphere_of(const Scene& scene, std::optional<std::size_t> material) {
  if (!material) return std::nullopt;
  const auto found = std::ranges::find(scene.spheres, *material, &Sphere::material);
  if (found == scene.spheres.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - scene.spheres.begin());
}

}  // namespace

PrecisionBound judge_radiance(const Scene& scene, int depth, double max) {
  Surfaces all = reduce_indices(
      scene.materials.size(), Surfaces{.farthest = Farthest(max)},
      [&](Surfaces& some, std::size_t i) { some.add(scene.materials[i], i); },
      [](Surfaces& some, const Surfaces& later) { some.join(later); });
  for (const LinearRgb& sky : {scene.background.bottom, scene.background.top}) {
    all.farthest.add(sky, std::nullopt);
    all.light.add(brightest(sky), std::nullopt);
  }
  const double share = all.farthest.bound().share;
  const double light = all.light.value;
  all.farthest.add(light > 0 ? light * std::pow(all.gain.value, depth - 1) : 0, all.light.material);
  PrecisionBound bound = all.farthest.bound();
  if (bound.share <= 1) return bound;  // nobody asks for the spheres
  bound.sphere = sphere_of(scene, all.farthest.material());
  if (bound.share > share) bound.other = sphere_of(scene, all.gain.material);
  return bound;
}

}  // namespace sdlc::render
