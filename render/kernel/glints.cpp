#define HWY_COMPILE_ONLY_SCALAR
#include "render/kernel/glints.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/exactness/camera_surface.hpp"
#include "render/exactness/rebase.hpp"
#include "render/math/vec3.hpp"
#include "render/scene/instances.hpp"
#include "render/shading/beams-inl.h"
#include "render/shading/pinhole.hpp"

namespace sdlc::render {
namespace {

using namespace HWY_NAMESPACE;
using D = Lanes<double>;
using V = hn::Vec<D>;

V lanes(double v) { return hn::Set(D(), v); }
Triple<V> lanes(Vec3 v) { return {lanes(v.x), lanes(v.y), lanes(v.z)}; }
Beams<double>::Ball lanes(const Sphere& sphere) {
  return {lanes(sphere.center), lanes(sphere.radius)};
}

/// The place of a direction in the picture; nullopt behind the camera.
std::optional<Glint::Place> place_of(const Pinhole& camera, const Triple<V>& at) {
  const Vec3 direction{hn::GetLane(at.x), hn::GetLane(at.y), hn::GetLane(at.z)};
  const double depth = dot(direction, camera.place(0.5, 0.5));
  if (!(depth > 0)) return std::nullopt;
  const Vec3 on_plane = direction / depth;
  return Glint::Place{
      .x = dot(on_plane, camera.across()) / length_squared(camera.across()) + 0.5,
      .y = dot(on_plane, camera.upwards()) / length_squared(camera.upwards()) + 0.5};
}

struct Extent {
  Glint::Place low, high;  // the corners of the bounding rectangle
  double area = 0;

  explicit Extent(std::span<const Glint::Place> outline) : low(outline[0]), high(outline[0]) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Glint::Place a = outline[i], b = outline[(i + 1) % outline.size()];
      area += (a.x * b.y - a.y * b.x) / 2;
      low = {std::min(low.x, a.x), std::min(low.y, a.y)};
      high = {std::max(high.x, a.x), std::max(high.y, a.y)};
    }
    area = std::fabs(area);
  }

  bool is_in_picture() const noexcept { return high.x > 0 && low.x < 1 && high.y > 0 && low.y < 1; }
  /// Whether its samples are spread evenly: it is neither a thin arc nor smaller than the digits of
  /// places in float.
  bool is_sampled_well() const noexcept {
    constexpr double kMinShare = 1.0 / 16, kMinSize = 1e-7;
    const double width = high.x - low.x, height = high.y - low.y;
    return std::min(width, height) > kMinSize && area > kMinShare * width * height;
  }
};

/// Adds the images of a light by way of a caster, with this number of chords. Returns whether it
/// knows all of them, and they are sampled well.
bool add_images(const Pinhole& camera, const Beams<double>& beams, const Glint& chain,
                std::vector<Glint>& images) {
  if (hn::AllFalse(D(), beams.is_known())) return false;
  bool are_complete = true;
  for (double rank = 0; rank < hn::GetLane(beams.count()); ++rank) {
    const auto beam = beams.beam(lanes(rank));
    Glint image = chain;
    const std::size_t side = image.outline.size() / 4;
    std::size_t behind = 0;
    for (std::size_t i = 0; i < image.outline.size(); ++i) {
      // Around the unit square.
      const double along = static_cast<double>(i % side) / static_cast<double>(side);
      const double across[]{along, 1, 1 - along, 0}, up[]{0, along, 1, 1 - along};
      const auto at =
          place_of(camera, beams.direction(beam, lanes(across[i / side]), lanes(up[i / side])));
      if (at) {
        image.outline[i] = *at;
      } else {
        ++behind;
      }
    }
    if (behind == image.outline.size()) continue;
    are_complete &= behind == 0 && hn::GetLane(beam.solid_angle) > 0;
    if (behind > 0) continue;
    const Extent extent(image.outline);
    if (!extent.is_in_picture()) continue;
    are_complete &= extent.is_sampled_well();
    images.push_back(image);
  }
  return are_complete;
}

}  // namespace

Glints find_glints(const Scene& scene, std::span<const std::uint32_t> casters,
                   std::span<const std::uint32_t> lights) {
  constexpr std::size_t kMaxPairs = 64;
  Glints glints;
  if (casters.empty() || casters.size() * lights.size() > kMaxPairs) return glints;
  if (scene.camera.has_lens() || has_motion(scene) || count_under_camera(scene) > 0) return glints;
  const Pinhole camera(scene.camera);
  const Rebase rebase(scene);
  glints.are_complete = true;
  for (const std::uint32_t by : casters) {
    const Sphere caster = rebase.sphere(scene.spheres[by]);
    const Material& material = scene.materials[caster.material];
    const bool refracts = material.type == MaterialType::Transmissive;
    const V index = lanes(refracts ? material.parameter : 1);
    for (const std::uint32_t of : lights) {
      const Sphere light = rebase.sphere(scene.spheres[of]);
      for (std::uint32_t chords = 0; chords <= (refracts ? kMaxChords : 0); ++chords) {
        const Beams<double> beams(lanes(Vec3{}), lanes(caster), lanes(light), index,
                                  lanes(static_cast<double>(chords)));
        const Glint chain{.caster = by, .light = of, .chords = chords};
        glints.are_complete &= add_images(camera, beams, chain, glints.images);
      }
    }
  }
  return glints;
}

}  // namespace sdlc::render
