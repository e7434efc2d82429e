#pragma once

#include <cstdint>
#include <vector>

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

/// All that a material does but to colour light.
struct Optics {
  std::uint32_t surface = 0;  ///< SurfaceBits
  double parameter = 0;       ///< that of specular and transmissive materials
};

Optics optics_of(const Material& material) noexcept;

/// Different optics, each once: most materials of a large scene differ in their colour alone.
class OpticsTable {
 public:
  /// The row of these optics, which are added if they are new.
  std::uint32_t row_of(const Optics& optics);

  const std::vector<Optics>& rows() const noexcept { return rows_; }

 private:
  void grow();
  /// Where the row of these optics is, or is to be.
  std::uint32_t& place_of(const Optics& optics);

  std::vector<Optics> rows_;
  // Rows by hash. Open addressing with linear probing; a power of two, at most half full.
  std::vector<std::uint32_t> places_;
};

}  // namespace sdlc::render
