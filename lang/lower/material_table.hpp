#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// The materials of a scene, each once: spheres with equal materials share it.
class MaterialTable {
 public:
  /// The index of the material, which is added if it is new.
  std::uint32_t index_of(const render::Material& material);

  /// Hands the materials over, in the order in which they were first seen.
  std::vector<render::Material> take() { return std::move(materials_); }

 private:
  static constexpr std::uint32_t kEmpty = 0xFFFFFFFF;

  void grow();

  std::vector<render::Material> materials_;
  std::vector<std::uint32_t>
      slots_;  // open addressing with linear probing; a power of two, at most half full
};

}  // namespace sdlc::lang
