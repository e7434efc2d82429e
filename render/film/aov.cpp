#include "render/film/aov.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "render/math/color.hpp"

namespace sdlc::render {
namespace {

Layer empty_layer(std::string name, std::size_t pixels) {
  return {.name = std::move(name), .values = std::vector<float>(pixels)};
}

}  // namespace

std::vector<Layer> feature_layers(std::span<const PixelFeatures> features, const Aovs& aovs) {
  std::vector<Layer> layers;
  const auto add = [&](const char* name, const auto& value_of) {
    Layer& layer = layers.emplace_back(empty_layer(name, features.size()));
    std::ranges::transform(features, layer.values.begin(),
                           [&](const PixelFeatures& pixel) { return to_float(value_of(pixel)); });
  };
  if (aovs.normal) {
    add("normal.X", [](const PixelFeatures& pixel) { return pixel.normal.x; });
    add("normal.Y", [](const PixelFeatures& pixel) { return pixel.normal.y; });
    add("normal.Z", [](const PixelFeatures& pixel) { return pixel.normal.z; });
  }
  if (aovs.depth) add("Z", [](const PixelFeatures& pixel) { return pixel.depth; });
  if (aovs.albedo) {
    add("albedo.R", [](const PixelFeatures& pixel) { return pixel.albedo.r; });
    add("albedo.G", [](const PixelFeatures& pixel) { return pixel.albedo.g; });
    add("albedo.B", [](const PixelFeatures& pixel) { return pixel.albedo.b; });
  }
  return layers;
}

bool fits_float(const Picture& variance, const Picture& mean) noexcept {
  using Float = std::numeric_limits<float>;
  for (const auto channel : {&LinearRgb::r, &LinearRgb::g, &LinearRgb::b}) {
    double largest = 0, brightest = 0;
    for (std::size_t i = 0; i < variance.pixels.size(); ++i) {
      const double value = variance.pixels[i].*channel;
      if (!(value <= Float::max())) return false;
      largest = std::max(largest, value);
      brightest = std::max(brightest, mean.pixels[i].*channel);
    }
    const double rounding = brightest * Float::epsilon() / 2;
    if (largest < Float::min() && largest > rounding * rounding) return false;
  }
  return true;
}

std::vector<Layer> variance_layers(const Picture& variance) {
  const std::size_t pixels = variance.pixels.size();
  std::vector<Layer> layers;
  for (const char* name : {"variance.R", "variance.G", "variance.B"}) {
    layers.push_back(empty_layer(name, pixels));
  }
  for (std::size_t i = 0; i < pixels; ++i) {
    layers[0].values[i] = to_float(variance.pixels[i].r);
    layers[1].values[i] = to_float(variance.pixels[i].g);
    layers[2].values[i] = to_float(variance.pixels[i].b);
  }
  return layers;
}

Layer samples_layer(std::span<const std::uint32_t> samples_of_pixels, std::uint64_t uniform,
                    std::size_t pixels) {
  Layer layer = empty_layer("samples.V", pixels);
  if (samples_of_pixels.empty()) {
    std::ranges::fill(layer.values, static_cast<float>(uniform));
  } else {
    std::ranges::transform(samples_of_pixels, layer.values.begin(),
                           [](std::uint32_t samples) { return static_cast<float>(samples); });
  }
  return layer;
}

}  // namespace sdlc::render
