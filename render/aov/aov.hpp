#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/image/layer.hpp"
#include "render/image/picture.hpp"
#include "render/scene/scene.hpp"

/// Auxiliary channels (arbitrary output variables) of a picture. docs/aov.md explains each.
namespace sdlc::render {

struct Aovs {
  bool normal = false, depth = false, albedo = false;  ///< of the first surface on camera rays
  bool variance = false, samples = false;              ///< of the picture itself

  bool any() const noexcept { return has_first_hits() || variance || samples; }
  bool has_first_hits() const noexcept { return normal || depth || albedo; }
  std::size_t channels() const noexcept {
    return (normal ? 3u : 0u) + (depth ? 1u : 0u) + (albedo ? 3u : 0u) + (variance ? 3u : 0u) +
           (samples ? 1u : 0u);
  }
};

/// Depth where no ray of a pixel hits a surface; the same value as in Cycles.
inline constexpr double kNoDepth = 1e10;

/// The max number of spheres of an instanced scene for first_hit_layers(), which expands the
/// instances.
inline constexpr std::uint64_t kMaxExpandedSpheres = 10'000'000;

/// Returns the layers among normal, depth and albedo that `aovs` asks for. Each value is the mean
/// over 16 rays of the pixel, at the positions of the picture's own first samples; with one sample
/// per pixel, of exactly that ray. Traced in double precision on all threads of `settings`; the
/// result does not depend on the number of threads. Empty once `cancel` is set.
std::vector<Layer> first_hit_layers(Scene scene, const RenderSettings& settings, const Aovs& aovs,
                                    const std::atomic<bool>& cancel);

/// RenderResult::variance as channels.
std::vector<Layer> variance_layers(const Picture& variance);

/// RenderResult::samples_of_pixels as a channel; `uniform` in each of `pixels` pixels if it is
/// empty.
Layer samples_layer(std::span<const std::uint32_t> samples_of_pixels, std::uint64_t uniform,
                    std::size_t pixels);

}  // namespace sdlc::render
