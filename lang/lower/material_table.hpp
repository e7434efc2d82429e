#pragma once

#include <cstdint>
#include <vector>

#include "lang/object/object.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// The renderer's material for a checked value.
render::Material lower_material(const MaterialValue& value) noexcept;

/// Whether the radiance that it emits is finite.
bool has_finite_light(const render::Material& material) noexcept;

/// The distinct materials of a scene.
class MaterialTable {
 public:
  /// The index of the material, which is added if it is new.
  std::uint32_t index_of(const render::Material& material);

  std::size_t bytes() const noexcept {
    return materials_.size() * sizeof(render::Material) + slots_.size() * sizeof(Slot);
  }

  /// Moves the materials out, in the order in which they were added.
  std::vector<render::Material> take() { return std::move(materials_); }

 private:
  /// The hash is stored to avoid cache misses in large scenes: a material is only read if it is
  /// most likely equal, and never when the table grows.
  struct Slot {
    std::uint32_t hash = 0;
    std::uint32_t index = kEmpty;
  };
  static constexpr std::uint32_t kEmpty = 0xFFFFFFFF;

  void grow();

  std::vector<render::Material> materials_;
  // Open addressing with linear probing; a power of two, at most half full.
  std::vector<Slot> slots_;
};

}  // namespace sdlc::lang
