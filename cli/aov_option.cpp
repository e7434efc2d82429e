#include "cli/aov_option.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/usage_error.hpp"
#include "render/film/film.hpp"

namespace sdlc::cli {
namespace {

using render::Aovs;

constexpr std::array<std::string_view, 5> kWords{"normal", "depth", "albedo", "variance",
                                                 "samples"};
constexpr std::array kMembers{&Aovs::normal, &Aovs::depth, &Aovs::albedo, &Aovs::variance,
                              &Aovs::samples};

}  // namespace

void add_aov_option(Command& command, Aovs& aovs) {
  command
      .add_repeated(
          "--aov",
          [&aovs](const std::vector<std::string>& words) {
            for (const std::string& word : words) {
              const auto found = std::ranges::find(kWords, word);
              aovs.*kMembers[static_cast<std::size_t>(found - kWords.begin())] = true;
            }
          },
          "Additional channels in .exr outputs, comma-separated (may be repeated)")
      .one_of(kWords)
      .comma_separated();
}

void check_aovs(const Aovs& aovs, const std::vector<Output>& outputs,
                const render::RenderSettings& settings) {
  if (!aovs.any()) return;
  const auto is_exr = [](const Output& output) {
    return output.is_film || (!output.is_stdout && output.format == render::ImageFormat::Exr);
  };
  if (std::ranges::none_of(outputs, is_exr)) {
    throw UsageError(
        "--aov: only .exr files can store additional channels, and there is no .exr output; add "
        "one, such as -o picture.exr");
  }
  if (aovs.variance && settings.is_denoised) {
    throw UsageError(
        "--aov: `variance` is that of the picture that is not denoised; omit it or --denoise");
  }
  const auto min_samples = static_cast<int>(render::kMinReplicatedSamples);
  if (aovs.variance && settings.samples < min_samples) {
    throw UsageError(
        fmt::format("--aov: `variance` takes at least {0} samples per pixel, and this render has "
                    "{1}; use more, such as --samples {0}, or omit `variance`",
                    min_samples, settings.samples));
  }
}

std::size_t aov_bytes(const Aovs& aovs, std::size_t pixels) noexcept {
  // Each channel, plus its part of the encoded file.
  const std::size_t channels = aovs.channels() * 2 * sizeof(float);
  return pixels * (channels + (aovs.variance ? sizeof(render::LinearRgb) : 0) +
                   (aovs.has_features() ? sizeof(render::PixelFeatures) : 0));
}

std::vector<render::Layer> picture_layers(const Aovs& aovs, const render::RenderSettings& settings,
                                          const render::RenderResult& result, std::ostream& err) {
  std::vector<render::Layer> layers = feature_layers(result.features, aovs);
  // Only a render with a goal counts the samples per pixel.
  const bool is_counted = result.is_complete || settings.has_goal();
  const auto warn = [&err](std::string_view channels, std::string_view reason) {
    err << fmt::format("warning: --aov: without {}, as {}\n", channels, reason);
  };
  std::vector<std::string_view> missing;
  if (aovs.variance) {
    if (!is_counted || result.variance.pixels.empty()) {
      missing.push_back("variance");
    } else if (!render::fits_float(result.variance, result.picture)) {
      // Clamped or 0, it would declare noise a difference.
      warn("variance", "its values are beyond the range of 32-bit floats");
    } else {
      std::ranges::move(render::variance_layers(result.variance), std::back_inserter(layers));
    }
  }
  if (aovs.samples) {
    if (is_counted) {
      layers.push_back(render::samples_layer(result.samples_of_pixels, result.min_samples,
                                             result.picture.pixels.size()));
    } else {
      missing.push_back("samples");
    }
  }
  if (missing.empty()) return layers;
  const std::string reason =
      result.is_complete
          ? fmt::format("it takes at least {} samples per pixel, and there was time for {}",
                        render::kMinReplicatedSamples, result.min_samples)
          : "the render was interrupted";
  warn(fmt::to_string(fmt::join(missing, ", ")), reason);
  return layers;
}

}  // namespace sdlc::cli
