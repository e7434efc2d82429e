#pragma once

#include <cstdint>
#include <vector>

#include "render/math/vector_allocator.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// Properties of a surface, as bits: the kernel blends results instead of branching.
enum SurfaceBit : std::uint32_t {
  kEndsPath = 1,  ///< emissive and unlit
  kMirrors = 2,   ///< specular
  kIsFuzzy = 4,   ///< specular, perturbed within a ball
  kRefracts = 8,  ///< transmissive
  kIsExact = 16,  ///< transmissive with Fresnel's equations instead of Schlick's approximation
  kIsRough = 32,  ///< specular, is_rough()
  kIsWide = 64,   ///< specular, is_wide()
};

/// Whether a surface is metal that is fuzzy enough for connections to lights.
constexpr bool is_rough(const Material& material) noexcept {
  constexpr double kRoughFuzz = 0.01;
  return material.type == MaterialType::Specular && material.parameter >= kRoughFuzz;
}

/// Whether a surface scatters from one direction into many, so that a path through it is like one
/// through a diffuse surface: into a cone of half angle asin(1/4) or more.
constexpr bool is_wide(const Material& material) noexcept {
  constexpr double kWideFuzz = 0.25;
  return material.type == MaterialType::Diffuse ||
         (material.type == MaterialType::Specular && material.parameter >= kWideFuzz);
}

/// The properties of a material except its colour.
struct Optics {
  std::uint32_t surface = 0;  ///< SurfaceBits
  double parameter = 0;       ///< of specular and transmissive materials
};

Optics optics_of(const Material& material) noexcept;

/// Optics in numbers of type T, as columns. Values are undefined for surfaces that do not use them.
template <typename T>
struct OpticsColumns {
  using Table = std::vector<T, VectorAllocator<T>>;
  using IndexTable = std::vector<std::uint32_t, VectorAllocator<std::uint32_t>>;

  /// kMirrors: the weights of the mirrored direction and of the perturbing ball; the larger one is
  /// 1, so that neither overflows. kRefracts: the refractive index and its inverse.
  Table first;
  Table second;
  Table straight;      ///< kRefracts: reflectance at normal incidence
  IndexTable surface;  ///< SurfaceBits
  bool has_exact_fresnel = false;
};

/// The distinct optics: most materials of a large scene differ only in colour.
class OpticsTable {
 public:
  /// The row of these optics; adds them if they are new.
  std::uint32_t row_of(const Optics& optics);

  const std::vector<Optics>& rows() const noexcept { return rows_; }

 private:
  void grow();
  /// The hash slot of these optics, or the slot where they belong.
  std::uint32_t& place_of(const Optics& optics);

  std::vector<Optics> rows_;
  // Rows by hash. Open addressing with linear probing; a power of two, at most half full.
  std::vector<std::uint32_t> places_;
};

}  // namespace sdlc::render
