#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/math/color.hpp"
#include "render/math/interval.hpp"
#include "render/math/pixel_window.hpp"
#include "render/math/placement.hpp"
#include "render/math/vec3.hpp"

/// The scene that the renderer draws: plain data, already checked.
namespace sdlc::render {

enum class MaterialType : std::uint8_t { Diffuse, Specular, Transmissive, Emissive, Unlit };
enum class Fresnel : std::uint8_t { Schlick, Exact };

/// The optical properties of a surface.
struct Material {
  LinearRgb color;  ///< attenuation, or the radiance of Unlit; components at least 0
  double parameter =
      0;  ///< Specular: fuzz ≥ 0; Transmissive: index of refraction > 0; Emissive: intensity ≥ 0
  MaterialType type = MaterialType::Diffuse;
  Fresnel fresnel = Fresnel::Schlick;

  friend bool operator==(const Material&, const Material&) = default;
};

/// A sphere with its centre at shutter opening. Radius 0 is never hit.
struct Sphere {
  Vec3 center;
  double radius = 0;
  std::uint32_t material = 0;  ///< index into Scene::materials

  friend bool operator==(const Sphere&, const Sphere&) = default;
};

/// A camera with a pinhole or a thin lens. `at` differs from `from`, and `up` is neither zero nor
/// parallel to the view direction.
struct Camera {
  Vec3 from;
  Vec3 at;
  Vec3 up{0, 1, 0};
  double plane_height = 2;  ///< height of the image plane at distance 1; greater than 0
  double aspect = 16.0 / 9.0;
  /// Diameter of the lens, a disc around `from` perpendicular to the view axis; 0: a pinhole.
  double aperture = 0;
  /// With a lens: the distance along the view axis of the plane in focus, which is parallel to the
  /// lens; greater than 0.
  double focus = 1;

  bool has_lens() const noexcept { return aperture > 0; }
};

/// The radiance of rays that hit no sphere: `bottom` straight down, `top` straight up, linear in
/// the y of the unit direction between. Both are equal for a constant background.
struct Background {
  LinearRgb bottom{1, 1, 1};
  LinearRgb top{0.5, 0.7, 1};

  bool is_constant() const noexcept { return bottom == top; }
};

/// Spheres that are stored once and instanced several times.
struct Prototype {
  std::vector<Sphere> spheres;  ///< in the coordinates of the prototype; at least one
  std::vector<Vec3> shifts;     ///< as in Scene
};

/// A placed copy of a prototype.
struct Instance {
  std::uint32_t prototype = 0;  ///< index into Scene::prototypes
  Placement placement;          ///< at shutter opening; its scale is above 0
  Vec3 shift;                   ///< displacement of the whole instance until the shutter closes

  friend bool operator==(const Instance&, const Instance&) = default;
};

struct Scene {
  Camera camera;
  Background background;
  std::vector<Material> materials;
  std::vector<Sphere> spheres;
  /// The displacement of each centre from shutter opening to closing; empty if nothing moves.
  std::vector<Vec3> shifts;
  std::vector<Prototype> prototypes;
  std::vector<Instance> instances;  ///< in sphere numbering, their spheres follow `spheres`,
                                    ///< instance by instance
};

/// The source of the random numbers of paths.
enum class SamplerKind : std::uint8_t {
  Sobol,        ///< Owen-scrambled Sobol' points, per pair of dimensions
  Independent,  ///< independent numbers: the baseline for comparisons
};

/// Whether diffuse surfaces and rough metal sample emitters directly (next event estimation).
/// Expectations do not change.
enum class LightSampling : std::uint8_t {
  Auto,  ///< for emitters where it is expected to pay off
  On,    ///< for all emitters
  Off,
  Caustics,  ///< for all emitters, also by way of mirrors and glass
};

/// The max camera paths per pixel if there is a goal and no explicit limit.
inline constexpr int kMaxSamples = 1 << 24;

/// The floating-point precision of paths. Mixed: float, except that intersections with the largest
/// spheres use double.
enum class Precision : std::uint8_t { Float, Mixed, Double };

/// How the picture is rendered.
struct RenderSettings {
  int width = 960;
  int height = 540;
  int samples = 64;  ///< camera paths per pixel; with a goal, the maximum
  int depth = 16;    ///< rays per path, including the camera ray
  std::uint64_t seed = 0;
  int threads = 0;  ///< 0: all hardware threads
  SamplerKind sampler = SamplerKind::Sobol;
  LightSampling light_sampling = LightSampling::Auto;
  /// Stop when the relative error of the picture (see ErrorEstimate) is at most this; above 0.
  std::optional<double> error{};
  /// Stop this many seconds after render() was called; above 0.
  std::optional<double> seconds{};
  bool is_adaptive = false;     ///< with `error`: more samples for noisier pixels
  bool is_denoised = false;     ///< filter the picture where that lowers its error
  bool keeps_variance = false;  ///< keep it per pixel, in RenderResult::variance and spreads
  bool keeps_first_hits =
      false;  ///< average the first hits of each pixel, in RenderResult::features
  /// A part of the picture: only it is rendered, with the pixels that it has in the whole.
  std::optional<PixelWindow> crop{};

  /// The pixels that are rendered.
  PixelWindow window() const noexcept {
    return crop.value_or(PixelWindow{.x = 0, .y = 0, .width = width, .height = height});
  }
  bool has_goal() const noexcept { return error || seconds; }
  /// With one sample per pixel, it goes through the pixel's centre.
  bool is_centred() const noexcept { return samples == 1 && !has_goal(); }

  friend bool operator==(const RenderSettings&, const RenderSettings&) = default;
};

}  // namespace sdlc::render
