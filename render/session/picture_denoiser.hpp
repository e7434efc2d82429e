#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/denoise/cross_filter.hpp"
#include "render/denoise/denoise.hpp"
#include "render/film/film.hpp"
#include "render/film/first_hits.hpp"
#include "render/session/prepared_scene.hpp"
#include "render/session/render.hpp"

namespace sdlc::render {

/// Denoises the pictures of one render.
class PictureDenoiser {
 public:
  /// The features and, while it denoises, planes, errors and the picture.
  static constexpr std::size_t kBytesPerPixel =
      sizeof(PixelFeatures) + 18 * sizeof(float) + sizeof(DenoisedError) + sizeof(LinearRgb);

  /// Traces camera rays for the features of the first surfaces. They are not those of the picture's
  /// paths, as features must be independent of the samples. On the threads of the caller,
  /// and for `threads` of them.
  PictureDenoiser(const PreparedScene& scene, const RenderSettings& settings, int threads,
                  RenderMonitor& monitor);

  /// Denoises the picture of a result with an error, from `film` and its spreads, if the interval
  /// of the error then ends lower.
  void denoise(const Film& film, std::span<const PixelSpread> spreads, RenderResult& result) const;

 private:
  CrossFilter* filter_;
  int width_, height_;
  std::vector<PixelFeatures> features_;
};

}  // namespace sdlc::render
