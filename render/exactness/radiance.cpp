#include "render/exactness/radiance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

  void add(double v) {
    if (v >= low_ && v <= high_) return;  // fast path without a division
    const double factor = v >= 1 ? v : 1 / v;
    if (v == 0 || factor / max_ <= bound_.share) return;
    bound_.value = v;
    bound_.share = factor / max_;
    bound_.limit = v >= 1 ? max_ : 1 / max_;
    high_ = factor;
    low_ = 1 / factor * (1 + 0x1p-50);  // covers rounding
  }
  void add(LinearRgb c) {
    for (const double v : {c.r, c.g, c.b}) add(v);
  }
  void join(const Farthest& later) {
    if (later.bound_.share > bound_.share) *this = later;
  }

 private:
  PrecisionBound bound_;
  double max_;
  double low_ = 2, high_ = 1;  // no number in between can be farther; initially empty
};

/// Collects limits of a scene's materials.
struct Surfaces {
  Farthest farthest;
  double light = 0;  // the brightest
  double gain = 1;   // max factor by which a reflection multiplies radiance

  void add(const Material& material) {
    farthest.add(material.color);
    farthest.add(material.parameter);
    if (material.type == MaterialType::Emissive) {
      light = std::max(light, brightest(material.color * material.parameter));
    } else if (material.type == MaterialType::Unlit) {
      light = std::max(light, brightest(material.color));
    } else {
      gain = std::max(gain, brightest(material.color));
    }
  }
  void join(const Surfaces& later) {
    farthest.join(later.farthest);
    light = std::max(light, later.light);
    gain = std::max(gain, later.gain);
  }
};

}  // namespace

PrecisionBound judge_radiance(const Scene& scene, int depth, double max) {
  Surfaces all = reduce_indices(
      scene.materials.size(), Surfaces{.farthest = Farthest(max)},
      [&](Surfaces& some, std::size_t i) { some.add(scene.materials[i]); },
      [](Surfaces& some, const Surfaces& later) { some.join(later); });
  const Background& sky = scene.background;
  all.farthest.add(sky.bottom);
  all.farthest.add(sky.top);
  const double light = std::max({all.light, brightest(sky.bottom), brightest(sky.top)});
  all.farthest.add(light > 0 ? light * std::pow(all.gain, depth - 1) : 0);
  return all.farthest.bound();
}

}  // namespace sdlc::render
