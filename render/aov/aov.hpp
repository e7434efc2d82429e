#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/image/layer.hpp"
#include "render/image/picture.hpp"
#include "render/scene/scene.hpp"

/// Auxiliary channels: what is known of a picture beside its colours. docs/aov.md says what each
/// means, and why it is so.
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

/// Depth where no ray of a pixel meets a surface, as Cycles has it.
inline constexpr double kNoDepth = 1e10;

/// The most spheres of a scene with instances that first_hit_layers() is to be called with: it
/// holds each by itself.
inline constexpr std::uint64_t kMostUninstanced = 10'000'000;

/// Of the normal, depth and albedo those that are asked for: means over the pixel, of 16 rays in
/// places where the picture's own first samples are; of a picture of one sample a pixel that very
/// ray. Traced in double on all threads of `settings`; the same bytes whatever their number. Empty
/// once `cancel` is set.
std::vector<Layer> first_hit_layers(Scene scene, const RenderSettings& settings, const Aovs& aovs,
                                    const std::atomic<bool>& cancel);

/// RenderResult::variance as channels.
std::vector<Layer> variance_layers(const Picture& variance);

/// RenderResult::samples_of_pixels as a channel, or `uniform` in all `pixels` of them if that is
/// empty.
Layer samples_layer(std::span<const std::uint32_t> samples_of_pixels, std::uint64_t uniform,
                    std::size_t pixels);

}  // namespace sdlc::render
