#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/math/color.hpp"
#include "render/math/interval.hpp"
#include "render/math/placement.hpp"
#include "render/math/vec3.hpp"

/// What the renderer draws: plain data that has already been checked.
namespace sdlc::render {

enum class MaterialType : std::uint8_t { Diffuse, Specular, Transmissive, Emissive, Unlit };
enum class Fresnel : std::uint8_t { Schlick, Exact };

/// What light does at a surface.
struct Material {
  LinearRgb color;  ///< attenuation, or the radiance of Unlit; components at least 0
  double parameter =
      0;  ///< Specular: fuzz ≥ 0; Transmissive: index of refraction > 0; Emissive: intensity ≥ 0
  MaterialType type = MaterialType::Diffuse;
  Fresnel fresnel = Fresnel::Schlick;

  friend bool operator==(const Material&, const Material&) = default;
};

/// A sphere with its centre at the opening of the shutter. Radius 0 is never hit.
struct Sphere {
  Vec3 center;
  double radius = 0;
  std::uint32_t material = 0;  ///< index into Scene::materials

  friend bool operator==(const Sphere&, const Sphere&) = default;
};

/// A pinhole camera. `at` differs from `from`, and `up` is neither zero nor along the view.
struct Camera {
  Vec3 from;
  Vec3 at;
  Vec3 up{0, 1, 0};
  double plane_height = 2;  ///< of the view plane at distance 1, greater than 0
  double aspect = 16.0 / 9.0;
};

/// Radiance where a ray meets no sphere: `bottom` straight down, `top` straight up, linear in the y
/// of the unit direction between. A constant background has both equal.
struct Background {
  LinearRgb bottom{1, 1, 1};
  LinearRgb top{0.5, 0.7, 1};

  bool is_constant() const noexcept { return bottom == top; }
};

/// Spheres that stand in several places at once and are held once.
struct Prototype {
  std::vector<Sphere> spheres;  ///< as they stand in no group; at least one
  std::vector<Vec3> shifts;     ///< as in Scene
};

/// A prototype in one of its places.
struct Instance {
  std::uint32_t prototype = 0;  ///< index into Scene::prototypes
  Placement placement;          ///< at the opening of the shutter; its scale is above 0
  Vec3 shift;                   ///< of all of it, up to the closing of the shutter

  friend bool operator==(const Instance&, const Instance&) = default;
};

struct Scene {
  Camera camera;
  Background background;
  std::vector<Material> materials;
  std::vector<Sphere> spheres;
  /// How far each centre moves from the opening to the closing of the shutter; empty when nothing
  /// moves.
  std::vector<Vec3> shifts;
  std::vector<Prototype> prototypes;
  std::vector<Instance> instances;  ///< their spheres come behind `spheres`, one after the other
};

/// Where the random numbers of paths come from.
enum class SamplerKind : std::uint8_t {
  Sobol,        ///< Owen-scrambled Sobol' points, pair by pair of dimensions
  Independent,  ///< each number by itself: the yardstick
};

/// Whether diffuse surfaces look for emitters by themselves; either way expectations are the same.
enum class LightSampling : std::uint8_t {
  Auto,  ///< for those of which geometry says that it pays
  On,    ///< for all
  Off,
};

/// Camera paths per pixel at most where there is a goal and nothing says how many.
inline constexpr int kMostSamples = 1 << 24;

/// How the picture is made.
struct RenderSettings {
  int width = 960;
  int height = 540;
  int samples = 64;  ///< camera paths per pixel; with a goal below, the most of them
  int depth = 16;    ///< rays per path, the camera's included
  std::uint64_t seed = 0;
  int threads = 0;  ///< 0: all of the machine
  SamplerKind sampler = SamplerKind::Sobol;
  LightSampling light_sampling = LightSampling::Auto;
  /// Trace until the relative error of the picture (see ErrorEstimate) is at most this, above 0.
  std::optional<double> error{};
  /// Trace until this many seconds have passed since render() was called, above 0.
  std::optional<double> seconds{};
  bool is_adaptive = false;  ///< with `error`: more samples where there is more noise
  bool keeps_variance = false;  ///< of each pixel, in RenderResult::variance and spreads

  bool has_goal() const noexcept { return error || seconds; }
  /// A picture of one sample a pixel looks through the middle of each.
  bool is_centred() const noexcept { return samples == 1 && !has_goal(); }
};

}  // namespace sdlc::render
