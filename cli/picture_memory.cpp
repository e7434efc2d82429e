#include "cli/picture_memory.hpp"

#include <cstddef>
#include <cstdint>
#include <new>

#include "cli/aov_option.hpp"
#include "cli/environment.hpp"
#include "render/film/film.hpp"
#include "render/session/picture_denoiser.hpp"
#include "render/session/render.hpp"

namespace sdlc::cli {

void check_picture_memory(const render::RenderSettings& settings, const render::Aovs& aovs,
                          bool has_film, int zoom) {
  const std::size_t pixels = settings.window().pixels();
  // The picture, its 32-bit copy, the encoded file, and the error estimates.
  std::size_t pixel_bytes =
      sizeof(render::LinearRgb) + 2 * 3 * sizeof(float) + sizeof(render::PixelSpread);
  if (settings.has_goal() || settings.is_denoised || has_film) {
    // A goal may need few samples.
    const auto samples = settings.has_goal() ? render::kMinReplicatedSamples
                                             : static_cast<std::uint64_t>(settings.samples);
    pixel_bytes += render::Film::bytes_per_pixel(samples, channels_of(settings));
  }
  if (settings.is_denoised) pixel_bytes += render::PictureDenoiser::kBytesPerPixel;
  std::size_t bytes = pixels * pixel_bytes + aov_bytes(aovs, pixels);
  if (zoom > 1) {  // copies
    const std::size_t large =
        pixels * static_cast<std::size_t>(zoom) * static_cast<std::size_t>(zoom);
    bytes += large * (sizeof(render::LinearRgb) + 2 * 3 * sizeof(float)) + aov_bytes(aovs, large);
  }
  if (bytes > physical_memory_bytes()) throw std::bad_alloc();
}

}  // namespace sdlc::cli
