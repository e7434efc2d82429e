#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/kernel/path_kernel.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

struct Glints {
  std::vector<Glint> images;
  bool are_complete = false;  ///< they contain most images of a light by way of a single caster
};

/// The images of `lights`, from choose_lights(), by way of each of `casters`, from
/// choose_casters(), in the picture. None with a lens or motion, where images move; where the
/// camera is on a sphere; and for more than 64 pairs of caster and light.
Glints find_glints(const Scene& scene, std::span<const std::uint32_t> casters,
                   std::span<const std::uint32_t> lights);

}  // namespace sdlc::render
