#include "render/scene/radiance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/scene/ranges.hpp"

namespace sdlc::render {
namespace {

double brightest(LinearRgb c) { return std::max({c.r, c.g, c.b}); }

/// Of numbers that are at least 0 the one that is most times more, or less, than 1; of equal ones
/// the first.
class Farthest {
 public:
  explicit Farthest(double most)
      : bound_{.value = 1, .share = 0, .limit = most, .sphere = {}, .other = {}}, most_(most) {}

  const PrecisionBound& bound() const { return bound_; }

  void add(double v) {
    if (v >= low_ && v <= high_) return;  // without a division for most
    const double factor = v >= 1 ? v : 1 / v;
    if (v == 0 || factor / most_ <= bound_.share) return;
    bound_.value = v;
    bound_.share = factor / most_;
    bound_.limit = v >= 1 ? most_ : 1 / most_;
    high_ = factor;
    low_ = 1 / factor * (1 + 0x1p-50);  // more than rounding
  }
  void add(LinearRgb c) {
    for (const double v : {c.r, c.g, c.b}) add(v);
  }
  void join(const Farthest& later) {
    if (later.bound_.share > bound_.share) *this = later;
  }

 private:
  PrecisionBound bound_;
  double most_;
  double low_ = 2, high_ = 1;  // none in between is farther: at first nothing is
};

/// Of the surfaces of a scene.
struct Surfaces {
  Farthest farthest;
  double light = 0;  // the brightest
  double gain = 1;   // the most that a ray brings back of what it finds

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

PrecisionBound judge_radiance(const Scene& scene, int depth, double most) {
  Surfaces all = reduce_indices(
      scene.materials.size(), Surfaces{.farthest = Farthest(most)},
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
