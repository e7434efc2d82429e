#include "render/aov/aov.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "render/aov/first_hits.hpp"
#include "render/math/color.hpp"
#include "render/math/vec3.hpp"
#include "render/sampler/sampler.hpp"
#include "render/scene/instances.hpp"
#include "render/tiles/threads.hpp"

namespace sdlc::render {
namespace {

// The same streams as a picture of 8 or more samples per pixel, and the first samples of each.
constexpr std::uint32_t kStreams = 4;
constexpr std::uint32_t kSamplesPerStream = 4;

/// Means over one pixel.
struct PixelFeatures {
  Vec3 normal;
  double depth = 0;
  LinearRgb albedo;
};

PixelFeatures trace_pixel(const FirstHits& hits, const RenderSettings& settings,
                          std::uint64_t pixel) {
  const auto width = static_cast<std::uint64_t>(settings.width);
  const auto x = static_cast<double>(pixel % width);
  const auto row = static_cast<double>(settings.height) - 1 - static_cast<double>(pixel / width);
  const std::uint32_t streams = settings.is_centred() ? 1 : kStreams;
  const std::uint32_t samples = settings.is_centred() ? 1 : kSamplesPerStream;
  PixelFeatures sum;
  int met = 0;
  for (std::uint32_t stream = 0; stream < streams; ++stream) {
    const std::uint64_t key = PathSampler::stream_key(settings.seed, pixel, stream);
    for (std::uint32_t i = 0; i < samples; ++i) {
      const PathSampler sampler(SamplerKind::Sobol, key, i);
      const auto [dx, dy] = settings.is_centred() ? UniformPair{0.5, 0.5} : sampler.pair(kPixel);
      const FirstHit hit =
          hits.trace((x + dx) / settings.width, (row + dy) / settings.height, sampler);
      if (!hit.is_hit) continue;
      ++met;
      sum.normal += hit.normal;
      sum.depth += hit.depth;
      sum.albedo += hit.albedo;
    }
  }
  const double share = 1.0 / (streams * samples);
  sum.normal = sum.normal * share;
  sum.albedo = sum.albedo * share;
  // Only hits count: there is no depth of the sky to average with.
  sum.depth = met > 0 ? hits.depth_in_scene(sum.depth / met) : kNoDepth;
  return sum;
}

Layer empty_layer(std::string name, std::size_t pixels) {
  return {.name = std::move(name), .values = std::vector<float>(pixels)};
}

}  // namespace

std::vector<Layer> first_hit_layers(Scene scene, const RenderSettings& settings, const Aovs& aovs,
                                    const std::atomic<bool>& cancel) {
  const int threads = thread_count(settings.threads);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  std::vector<Layer> layers;
  arena.execute([&] {
    if (!scene.instances.empty()) scene = without_instances(std::move(scene));
    const FirstHits hits(std::move(scene));
    const auto width = static_cast<std::size_t>(settings.width);
    const std::size_t pixels = width * static_cast<std::size_t>(settings.height);
    if (aovs.normal) {
      for (const char* name : {"normal.X", "normal.Y", "normal.Z"}) {
        layers.push_back(empty_layer(name, pixels));
      }
    }
    if (aovs.depth) layers.push_back(empty_layer("Z", pixels));
    if (aovs.albedo) {
      for (const char* name : {"albedo.R", "albedo.G", "albedo.B"}) {
        layers.push_back(empty_layer(name, pixels));
      }
    }
    const auto trace_row = [&](int y) {
      const std::size_t begin = static_cast<std::size_t>(y) * width;
      for (std::size_t pixel = begin; pixel < begin + width; ++pixel) {
        const auto [normal, depth, albedo] = trace_pixel(hits, settings, pixel);
        auto layer = layers.begin();
        const auto put = [&](double value) { (layer++)->values[pixel] = to_float(value); };
        if (aovs.normal) {
          for (const double v : {normal.x, normal.y, normal.z}) put(v);
        }
        if (aovs.depth) put(depth);
        if (aovs.albedo) {
          for (const double v : {albedo.r, albedo.g, albedo.b}) put(v);
        }
      }
    };
    tbb::parallel_for(tbb::blocked_range<int>(0, settings.height),
                      [&](const tbb::blocked_range<int>& rows) {
                        for (int y = rows.begin(); y < rows.end(); ++y) {
                          if (cancel.load(std::memory_order_relaxed)) return;
                          trace_row(y);
                        }
                      });
  });
  if (cancel.load()) layers.clear();
  return layers;
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
