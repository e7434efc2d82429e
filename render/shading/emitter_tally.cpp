#include "render/shading/emitter_tally.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/exactness/rebase.hpp"
#include "render/math/interval.hpp"
#include "render/math/vec3.hpp"
#include "render/shading/choose_lights.hpp"
#include "render/shading/optics.hpp"
#include "render/shading/pinhole.hpp"

namespace sdlc::render {
namespace {

/// The radiance that a surface emits; black if it scatters.
LinearRgb radiance_of(const Material& material) noexcept {
  if (material.type == MaterialType::Unlit) return material.color;
  if (material.type == MaterialType::Emissive) return material.color * material.parameter;
  return LinearRgb{};
}

double root_mean_square(LinearRgb c) noexcept {
  // The radiance may be so large that its square overflows.
  const double largest = std::fmin(std::fmax(c.r, std::fmax(c.g, c.b)), 1e150);
  if (!(largest > 0)) return 0;
  const LinearRgb unit{c.r / largest, c.g / largest, c.b / largest};
  return largest * std::sqrt((unit.r * unit.r + unit.g * unit.g + unit.b * unit.b) / 3);
}

/// Whether some surface scatters so that light continues.
struct Surfaces {
  bool wide = false;  // is_wide()
  bool wide_metal = false;
  std::size_t specular = 0;  // mirrors and glass

  Surfaces(const Scene& scene, bool has_wide_metal) {
    const auto add = [&](const Sphere& sphere) {
      const Material& material = scene.materials[sphere.material];
      if (sphere.radius <= 0 || is_black(material.color)) return;
      const bool is_metal = material.type == MaterialType::Specular;
      const bool scatters_widely = is_wide(material) && (has_wide_metal || !is_metal);
      wide |= scatters_widely;
      wide_metal |= scatters_widely && is_metal;
      const bool is_specular = is_metal || material.type == MaterialType::Transmissive;
      specular += is_specular && !scatters_widely ? 1 : 0;
    };
    std::ranges::for_each(scene.spheres, add);
    for (const Prototype& prototype : scene.prototypes) {
      std::ranges::for_each(prototype.spheres, add);
    }
  }
};

/// The pyramid of view directions from the camera, or from any point of its lens.
class ViewPyramid {
 public:
  ViewPyramid(const Camera& camera, const Rebase& rebase)
      : lens_radius_(rebase.length(camera.aperture) / 2), focus_(rebase.length(camera.focus)) {
    const Pinhole pinhole(camera);
    const Vec3 forward = pinhole.place(0.5, 0.5);
    const Vec3 right = pinhole.across() / 2, up = pinhole.upwards() / 2;
    // The outward normals of its sides, and of the plane through the camera.
    const auto side = [&](Vec3 edge) { return unit(edge - forward * length_squared(edge)); };
    normals_ = {side(right), side(-right), side(up), side(-up), -forward};
  }

  /// Whether a sphere of the rebased scene may be in the picture.
  bool may_show(Vec3 center, double radius) const noexcept {
    constexpr double kRounding = 1e-6;
    double reach = radius + kRounding * moderate_length(center);
    if (lens_radius_ > 0) {
      // A ray that starts at the edge of the lens is as far outside, and on the other side of the
      // plane in focus up to (depth / focus - 1) times as far.
      const double depth = moderate_length(center) + radius;
      reach += lens_radius_ * std::fmax(1, depth / focus_ - 1);
    }
    return std::ranges::all_of(normals_, [&](Vec3 n) { return dot(center, n) <= reach; });
  }

 private:
  std::array<Vec3, 5> normals_;
  double lens_radius_, focus_;
};

/// A sphere of a rebased scene, during its motion.
struct Moving {
  Sphere sphere;
  Vec3 shift;
};
Moving moving(const Scene& scene, const Rebase& rebase, std::uint32_t i) {
  return {.sphere = rebase.sphere(scene.spheres[i]),
          .shift = scene.shifts.empty() ? Vec3{} : rebase.shift(scene.shifts[i])};
}

/// The least and the greatest distance of the centres.
Interval distances(const Moving& a, const Moving& b) {
  const Vec3 apart = b.sphere.center - a.sphere.center, shift = b.shift - a.shift;
  const double way = length_squared(shift);
  const double when = way > 0 ? std::clamp(-dot(apart, shift) / way, 0.0, 1.0) : 0;
  return {moderate_length(apart + shift * when),
          std::fmax(moderate_length(apart), moderate_length(apart + shift))};
}

// Spheres that touch may be rounded so that they overlap.
constexpr double kTouching = 1 - 1e-6;

/// Whether each other sphere is always outside of this one, or around it.
bool is_clear(const Scene& scene, const Rebase& rebase, std::uint32_t sphere) {
  if (!scene.instances.empty()) return false;
  const Moving it = moving(scene, rebase, sphere);
  for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) {
    if (i == sphere || scene.spheres[i].radius <= 0) continue;
    const Moving other = moving(scene, rebase, i);
    const Interval apart = distances(it, other);
    const double radius = it.sphere.radius * kTouching;
    const bool is_outside = apart.from >= radius + other.sphere.radius * kTouching;
    if (!is_outside && apart.to + radius > other.sphere.radius) return false;
  }
  return true;
}

/// Whether Beams by way of a caster are always known: the light is its own diameter away, and large
/// enough for rounded directions.
bool has_beams(const Moving& caster, const Moving& light) {
  constexpr double kSmallest = 2e-5;
  const Interval apart = distances(caster, light);
  return apart.from > caster.sphere.radius + 2 * light.sphere.radius &&
         light.sphere.radius > kSmallest * apart.to;
}

/// The 95 % upper confidence limit for the mean of a Poisson distribution after n events, by the
/// Wilson-Hilferty approximation of the χ² distribution (1931).
double poisson_limit(double n) noexcept {
  constexpr double kNormalQuantile = 1.645;
  const double k = n + 1;
  const double root = 1 - 1 / (9 * k) + kNormalQuantile / (3 * std::sqrt(k));
  return k * root * root * root;
}

}  // namespace

EmitterClasses::EmitterClasses(const Scene& scene, std::span<const std::uint32_t> lights,
                               std::span<const std::uint32_t> casters, bool has_all_glints,
                               bool samples_at_metal)
    : emitters(choose_lights(scene, LightSampling::On)), of_spheres(scene.spheres.size(), kNone) {
  const Surfaces surfaces(scene, samples_at_metal);
  // Without scattering surfaces every path is a camera ray, and unlit spheres are plain pixels.
  if (!surfaces.wide && surfaces.specular == 0 && emitters.empty()) return;

  has_casters = !casters.empty();
  for (const Material& material : scene.materials) {
    brightest = std::fmax(brightest, root_mean_square(radiance_of(material)));
  }
  if (!(brightest > 0)) return;

  constexpr int kOctaves = 64;  // below the brightest; the last class includes everything darker
  std::array<std::uint8_t, 2 * kOctaves> class_of_octave;
  class_of_octave.fill(kNone);
  const Rebase rebase(scene);
  const ViewPyramid view(scene.camera, rebase);
  // No connections by way of the caster start at metal.
  const bool has_lone_caster = casters.size() == 1 && surfaces.specular == 1 &&
                               !surfaces.wide_metal && is_clear(scene, rebase, casters[0]);
  for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) {
    const double radiance =
        root_mean_square(radiance_of(scene.materials[scene.spheres[i].material]));
    if (!(radiance > 0) || scene.spheres[i].radius <= 0) continue;
    const bool is_sampled = std::ranges::binary_search(lights, i);
    const double below = std::fmin(std::log2(brightest / radiance), kOctaves - 1);
    std::uint8_t& id = class_of_octave[2 * static_cast<std::size_t>(below) + (is_sampled ? 1 : 0)];
    if (id == kNone) {
      id = static_cast<std::uint8_t>(classes.size());
      classes.push_back({.sphere = i});
    }
    of_spheres[i] = id;
    Class& c = classes[id];
    c.radiance = std::fmax(c.radiance, radiance);
    const Sphere sphere = rebase.sphere(scene.spheres[i]);
    const Vec3 shift = scene.shifts.empty() ? Vec3{} : rebase.shift(scene.shifts[i]);
    // A bounding sphere of the sphere's whole motion.
    if (view.may_show(sphere.center + shift / 2, sphere.radius + moderate_length(shift) / 2)) {
      c.add(LightPath::Visible, Chance::Possible);
    }
    // Each connection contributes little, and its noise shows up in the replicates.
    if (surfaces.wide && !is_sampled) c.add(LightPath::Direct, Chance::Possible);
    if (surfaces.specular == 0) continue;
    const bool is_connected =
        is_sampled && has_lone_caster &&
        has_beams(moving(scene, rebase, casters[0]), moving(scene, rebase, i));
    c.add(LightPath::Reflected,
          is_connected && has_all_glints ? Chance::Unexpected : Chance::Possible);
    if (!surfaces.wide) continue;
    c.add(LightPath::Caustic, is_connected ? Chance::Unexpected : Chance::Possible);
  }
}

EmitterTally::EmitterTally(const EmitterClasses& classes, int max_depth)
    : classes_(classes), found_(classes.classes.size()) {
  is_deep_enough_[index_of(LightPath::Visible)] = true;
  is_deep_enough_[index_of(LightPath::Reflected)] = max_depth >= 2;
  is_deep_enough_[index_of(LightPath::Direct)] = max_depth >= 2;
  is_deep_enough_[index_of(LightPath::Caustic)] = max_depth >= 3;
  for (std::size_t i = 0; i < found_.size(); ++i) {
    for (std::size_t kind = 0; kind < kLightPaths; ++kind) open_ += counts(i, kind) ? 1 : 0;
  }
  if (classes.has_casters) {
    octaves_ = std::vector<Count>(kOctaves);
    open_ += kOctaves;
  }
  if (classes.emitters.empty()) return;
  paths_ = std::vector<Count>(classes.of_spheres.size());
  for (Count& paths : paths_) paths.store(kEnough, std::memory_order_relaxed);
  for (const std::uint32_t i : classes.emitters) paths_[i].store(0, std::memory_order_relaxed);
  scarce_ = classes.emitters.size();
}

template <typename Tally, typename Visit>
void EmitterTally::for_each_count(Tally& tally, Visit visit) {
  for (auto& paths : tally.paths_) visit(paths, kEnough, tally.scarce_);
  for (auto& paths : tally.octaves_) visit(paths, kEnough, tally.open_);
  for (std::size_t i = 0; i < tally.found_.size(); ++i) {
    for (std::size_t kind = 0; kind < kLightPaths; ++kind) {
      if (!tally.counts(i, kind)) continue;
      visit(tally.found_[i][kind], witnesses(static_cast<LightPath>(kind)), tally.open_);
    }
  }
}

void EmitterTally::count_contribution(double radiance) noexcept {
  if (octaves_.empty() || !(radiance > 0)) return;
  const double below = std::log2(classes_.brightest / radiance);
  add(octaves_[static_cast<std::size_t>(std::clamp(below, 0.0, kOctaves - 1.0))], kEnough, open_);
}

std::vector<EmitterCount> EmitterTally::counts() const {
  std::vector<EmitterCount> counts;
  for_each_count(*this, [&](const Count& count, std::uint8_t enough, const auto&) {
    counts.push_back({.paths = count.load(std::memory_order_relaxed), .enough = enough});
  });
  return counts;
}

void EmitterTally::restore(std::span<const EmitterCount> counts) noexcept {
  std::size_t i = 0;
  for_each_count(*this, [&](Count& count, std::uint8_t enough, std::atomic<std::size_t>& left) {
    const std::uint8_t paths = counts[i++].paths;
    const bool was_open = count.exchange(paths, std::memory_order_relaxed) < enough;
    if (was_open && paths >= enough) left.fetch_sub(1, std::memory_order_relaxed);
  });
}

std::vector<ReachedEmitter> EmitterTally::scarce() const {
  std::vector<ReachedEmitter> emitters;
  for (std::uint32_t i = 0; i < paths_.size(); ++i) {
    const std::uint8_t paths = paths_[i].load(std::memory_order_relaxed);
    if (paths < kEnough) emitters.push_back({.sphere = i, .paths = paths});
  }
  return emitters;
}

std::vector<RarePath> EmitterTally::rare() const {
  std::vector<RarePath> rare;
  for (std::size_t i = 0; i < found_.size(); ++i) {
    for (std::size_t kind = 0; kind < kLightPaths; ++kind) {
      const std::uint8_t paths = found_[i][kind].load(std::memory_order_relaxed);
      const auto path = static_cast<LightPath>(kind);
      if (!counts(i, kind) || paths >= witnesses(path)) continue;
      const bool is_unexpected =
          classes_.classes[i].kinds[kind] == EmitterClasses::Chance::Unexpected;
      if (is_unexpected && paths == 0) continue;
      rare.push_back({.kind = path,
                      .paths = paths,
                      .sphere = classes_.classes[i].sphere,
                      .radiance = classes_.classes[i].radiance});
    }
  }
  constexpr double kMeanSquare = 7.0 / 12;  // in an octave up to 1
  std::uint32_t contributions = 0;
  double squares = 0;
  for (std::size_t octave = 0; octave < octaves_.size(); ++octave) {
    const std::uint8_t paths = octaves_[octave].load(std::memory_order_relaxed);
    if (paths == 0 || paths >= kEnough) continue;
    contributions += paths;
    const double radiance = std::ldexp(classes_.brightest, -static_cast<int>(octave));
    squares += kMeanSquare * poisson_limit(paths) * radiance * radiance;
  }
  if (contributions > 0) {
    // One error of the size of all octaves with few paths: their standard deviation.
    rare.push_back({.kind = LightPath::Caustic,
                    .paths = std::max<std::uint32_t>(contributions, kWitnesses),
                    .sphere = classes_.classes.front().sphere,
                    .radiance = std::sqrt(squares)});
  }
  return rare;
}

double unseen_error(std::span<const RarePath> rare, double mean_radiance, std::size_t pixels,
                    std::uint64_t samples) noexcept {
  double squares = 0;
  for (const RarePath& path : rare) {
    const double paths = path.paths < EmitterTally::kWitnesses ? poisson_limit(path.paths) : 1;
    const double lacking = path.radiance / mean_radiance * paths / static_cast<double>(samples);
    squares += lacking * lacking / static_cast<double>(pixels);
  }
  return std::sqrt(squares);
}

}  // namespace sdlc::render
