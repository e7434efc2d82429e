#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "render/scene/precision.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// What happens at a surface, as bits: the kernel blends the outcomes instead of branching.
enum SurfaceBit : std::uint32_t {
  kEndsPath = 1,  ///< emissive and unlit
  kMirrors = 2,   ///< specular
  kIsFuzzy = 4,   ///< specular, and spread by a ball
  kRefracts = 8,  ///< transmissive
  kIsExact = 16,  ///< transmissive with Fresnel's equations instead of Schlick's approximation
};

/// The most spheres that a WideScene holds: its tables then fit a first-level cache.
inline constexpr std::size_t kMostWideSpheres = 256;

/// A scene as the wide kernel reads it, in numbers of type T: one table for each quantity, so that
/// one sphere's number can be spread over all lanes, and each lane can look up that of the sphere
/// it hit. Lengths are those of the rebased scene, with the camera at the origin.
template <typename T>
struct WideScene {
  using Index = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  using Table = std::array<T, kMostWideSpheres>;
  using Triple = std::array<T, 3>;
  using TableTriple = std::array<Table, 3>;

  /// `scene` is rebased and has at most kMostWideSpheres spheres, of which the camera stands on at
  /// most one. `exact_spheres`: those to be met in double, at most kMostExactSpheres, none unless T
  /// is float.
  WideScene(const Scene& scene, int depth, std::span<const std::uint32_t> exact_spheres = {});

  // Tables by sphere, those to be met in double last, else in the scene's order. What a quantity
  // means for another material is never used.
  alignas(64) TableTriple center{};  ///< at the opening of the shutter
  alignas(64) TableTriple shift{};   ///< up to its closing
  alignas(64) Table radius{};
  alignas(64) Table radius_squared{};
  /// Attenuation; the radiance where the path ends.
  alignas(64) TableTriple color{};
  /// kMirrors: the weights of the mirrored direction and of the ball around it, the larger one 1,
  /// so that neither overflows. kRefracts: the index of refraction and its inverse.
  alignas(64) Table first{};
  alignas(64) Table second{};
  alignas(64) Table straight{};  ///< kRefracts: share reflected at normal incidence
  alignas(64) std::array<Index, kMostWideSpheres> surface{};  ///< SurfaceBits

  std::size_t spheres = 0;
  /// The last ones: a rounding error of so large a sphere would be no small part of others.
  std::size_t exact_spheres = 0;
  struct Exact {
    std::array<double, 3> center{}, shift{};
    double radius_squared = 0;
  };
  std::array<Exact, kMostExactSpheres> exact{};

  std::uint32_t max_depth = 1;
  bool has_motion = false;
  bool has_exact_fresnel = false;
  Triple sky_middle{}, sky_slope{};  ///< radiance of the sky: middle + slope · y

  /// The sphere on whose surface the camera stands, or kNoCameraSphere, and its outward normal
  /// there.
  static constexpr std::uint32_t kNoCameraSphere = 0xFFFFFFFF;
  std::uint32_t camera_sphere = kNoCameraSphere;
  Triple camera_normal{};

 private:
  void add_material(std::size_t i, const Material& material);
};

extern template struct WideScene<float>;
extern template struct WideScene<double>;

}  // namespace sdlc::render
