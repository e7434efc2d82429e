#include "render/session/picture_denoiser.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "render/denoise/denoise.hpp"
#include "render/math/clock.hpp"
#include "render/session/error_estimate.hpp"
#include "render/session/picture_tracer.hpp"
#include "render/shading/emitter_tally.hpp"

namespace sdlc::render {
namespace {

/// Settings for camera rays alone.
RenderSettings feature_settings(const RenderSettings& settings) {
  constexpr std::uint64_t kOtherSeed = 0x9e3779b97f4a7c15;
  RenderSettings features = settings;
  features.samples = kMinReplicatedSamples;
  features.depth = 1;
  features.seed = settings.seed ^ kOtherSeed;
  features.error.reset();
  features.seconds.reset();
  features.keeps_first_hits = true;
  return features;
}

}  // namespace

PictureDenoiser::PictureDenoiser(const PreparedScene& scene, const RenderSettings& settings,
                                 int threads, RenderMonitor& monitor)
    : filter_(scene.kernel().backend->filter),
      width_(settings.window().width),
      height_(settings.window().height) {
  const RenderSettings of_features = feature_settings(settings);
  EmitterTally emitters(scene.emitters(), of_features.depth);
  PictureTracer pictures(scene.tracer(), of_features, emitters, threads, monitor);
  const FilmExtent extent = extent_of(of_features);
  features_.resize(extent.pixels);
  pictures.trace_tiles(extent, split_in_replicates(kMinReplicatedSamples),
                       [&](const Film& tile, std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           features_[tile.extent().first_pixel + i] =
                               features_of(tile.first_hits(i), tile.samples(i),
                                           scene.tracer().depth_exponent());
                         }
                       });
  monitor.samples_done = 0;
  monitor.rays_done = 0;
}

void PictureDenoiser::denoise(const Film& film, std::span<const PixelSpread> spreads,
                              RenderResult& result) const {
  if (!(result.error->mean > 0)) return;
  const auto start = Clock::now();
  Denoised denoised = render::denoise(*filter_, film, features_, spreads, width_, height_);
  const std::optional<ErrorEstimate> error = estimate_error(*result.error, denoised.errors);
  result.denoise_seconds += seconds_since(start);
  if (!error || error->interval.to >= result.error->interval.to) return;
  result.picture = std::move(denoised.picture);
  result.plain_error = std::exchange(result.error, error);
}

}  // namespace sdlc::render
