#include "cli/serve_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/compare/color_map.hpp"
#include "render/image/image.hpp"
#include "render/math/color.hpp"

namespace sdlc::cli {
namespace {

using render::LinearRgb;
using render::PixelFeatures;

double mean_of(LinearRgb color) { return (color.r + color.g + color.b) / 3; }

/// The standard error of a pixel, relative to its radiance and at least a hundredth of that of the
/// whole picture; in decades from 0.1 % to 100 %.
double error_share(LinearRgb radiance, LinearRgb variance, double whole) {
  constexpr double kLeast = 1e-3, kDecades = 3;
  const double against = std::max(mean_of(radiance), whole / 100);
  if (against <= 0) return 0;
  const double error = std::sqrt(std::max(mean_of(variance), 0.0)) / against;
  return std::log10(std::max(error, kLeast) / kLeast) / kDecades;
}

/// 1 for the nearest surface, towards 0 for far ones and the sky: distances of any scale.
double nearness(double depth, double nearest) {
  return depth == render::kNoDepth || depth <= 0 ? 0 : nearest / depth;
}

}  // namespace

bool has_channel(const ServedPicture& picture, ServedChannel channel) noexcept {
  const render::RenderResult& result = picture.result;
  switch (channel) {
    case ServedChannel::Normal:
    case ServedChannel::Depth:
    case ServedChannel::Albedo: return !result.features.empty();
    case ServedChannel::Error: return !result.variance.pixels.empty();
    default: return true;
  }
}

std::vector<std::uint8_t> codes_of(const ServedPicture& picture, ServedChannel channel,
                                   double exposure) {
  const render::RenderResult& result = picture.result;
  render::ToneMapping mapping{.tone = render::Tone::Linear, .exposure = 0};
  if (!has_channel(picture, channel))
    return std::vector<std::uint8_t>(3 * result.picture.pixels.size());
  if (channel == ServedChannel::Color) {
    mapping = picture.mapping;
    mapping.exposure += exposure;
    return render::codes_of(result.picture, mapping);
  }
  render::Picture shown(result.picture.width, result.picture.height);
  const auto fill = [&](const auto& color) {
    for (std::size_t i = 0; i < shown.pixels.size(); ++i) shown.pixels[i] = color(i);
  };
  switch (channel) {
    case ServedChannel::Normal:
      fill([&](std::size_t i) {
        const render::Vec3 n = result.features[i].normal;
        return LinearRgb{(n.x + 1) / 2, (n.y + 1) / 2, (n.z + 1) / 2};
      });
      break;
    case ServedChannel::Depth: {
      double nearest = render::kNoDepth;
      for (const PixelFeatures& features : result.features) {
        if (features.depth > 0) nearest = std::min(nearest, features.depth);
      }
      fill([&](std::size_t i) { return LinearRgb{nearness(result.features[i].depth, nearest)}; });
      break;
    }
    case ServedChannel::Albedo:
      mapping.tone = render::Tone::Srgb;
      fill([&](std::size_t i) { return result.features[i].albedo; });
      break;
    case ServedChannel::Error: {
      mapping.tone = render::Tone::Srgb;
      double whole = 0;
      for (const LinearRgb& pixel : result.picture.pixels) whole += mean_of(pixel);
      whole /= static_cast<double>(shown.pixels.size());
      fill([&](std::size_t i) {
        return render::mapped_color(
            error_share(result.picture.pixels[i], result.variance.pixels[i], whole));
      });
      break;
    }
    default: {  // Samples
      const auto most = static_cast<double>(std::max<std::uint64_t>(result.max_samples, 1));
      fill([&](std::size_t i) {
        return LinearRgb{result.samples_of_pixels.empty() ? 1 : result.samples_of_pixels[i] / most};
      });
    }
  }
  return render::codes_of(shown, mapping);
}

}  // namespace sdlc::cli
