#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/film/first_hits.hpp"
#include "render/image/layer.hpp"
#include "render/image/picture.hpp"

/// Auxiliary channels (arbitrary output variables) of a picture. docs/aov.md explains each.
namespace sdlc::render {

struct Aovs {
  bool normal = false, depth = false, albedo = false;  ///< of the first surface on camera rays
  bool variance = false, samples = false;              ///< of the picture itself

  bool any() const noexcept { return has_features() || variance || samples; }
  bool has_features() const noexcept { return normal || depth || albedo; }
  std::size_t channels() const noexcept {
    return (normal ? 3u : 0u) + (depth ? 1u : 0u) + (albedo ? 3u : 0u) + (variance ? 3u : 0u) +
           (samples ? 1u : 0u);
  }
};

/// RenderResult::features as the channels among normal, depth and albedo that `aovs` asks for.
std::vector<Layer> feature_layers(std::span<const PixelFeatures> features, const Aovs& aovs);

/// Whether 32-bit floats can hold the variance of `mean`: no value overflows, and no channel
/// underflows that differs by more than the rounding of its means.
bool fits_float(const Picture& variance, const Picture& mean) noexcept;

/// RenderResult::variance as channels.
std::vector<Layer> variance_layers(const Picture& variance);

/// RenderResult::samples_of_pixels as a channel; `uniform` in each of `pixels` pixels if it is
/// empty.
Layer samples_layer(std::span<const std::uint32_t> samples_of_pixels, std::uint64_t uniform,
                    std::size_t pixels);

}  // namespace sdlc::render
