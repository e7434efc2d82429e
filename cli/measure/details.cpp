#include "cli/measure/details.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

#include "cli/report/figures.hpp"
#include "render/compare/color_map.hpp"
#include "render/image/image.hpp"
#include "render/image/resize.hpp"

namespace sdlc::cli {
namespace {

using render::LinearRgb;
using render::Picture;

constexpr int kCropWidth = 96, kCropHeight = 72, kMapWidth = 272;
constexpr const char* kReferenceKey = "reference";

/// A file name for the details of a picture.
std::string key_of(const render::Configuration& configuration, int samples) {
  std::string key = fmt::format("{}-samples-{}",
                                render::join_parts(render::parts_of(configuration), "-"), samples);
  std::ranges::replace(key, ' ', '-');
  return key;
}

/// The root mean square of the difference over the channels, per pixel, as grey.
Picture errors_of(const Picture& picture, const Picture& reference) {
  Picture errors(picture.width, picture.height);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const LinearRgb d = picture.pixels[i] - reference.pixels[i];
    errors.pixels[i] = LinearRgb{std::sqrt((d.r * d.r + d.g * d.g + d.b * d.b) / 3)};
  }
  return errors;
}

/// Chooses the noisiest of overlapping windows over the whole picture as the crop.
void choose_crop(const Picture& errors, DetailLayout& layout) {
  layout.width = std::min(errors.width, kCropWidth);
  layout.height = std::min(errors.height, kCropHeight);
  double largest = -1;
  for (int y = 0; y + layout.height <= errors.height; y += std::max(layout.height / 2, 1)) {
    for (int x = 0; x + layout.width <= errors.width; x += std::max(layout.width / 2, 1)) {
      double sum = 0;
      for (int v = y; v < y + layout.height; ++v) {
        // Square roots, so that a few bright pixels do not dominate.
        for (int u = x; u < x + layout.width; ++u) sum += std::sqrt(errors.at(u, v).r);
      }
      if (sum <= largest) continue;
      largest = sum;
      layout.x = x;
      layout.y = y;
    }
  }
}

std::string png_of(const Picture& picture, const render::ToneMapping& mapping) {
  const std::vector<std::byte> bytes = render::encode_picture(
      picture,
      {.format = render::ImageFormat::Png, .mapping = mapping, .metadata = {.software = ""}});
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

void Details::choose_layout(const Picture& picture, const render::ReferencePicture& reference) {
  // Four times the overall error, so that the maps of better pictures are not black.
  constexpr double kBrightest = 4;
  layout_.top = kBrightest * render::error_against(picture, reference).value *
                render::mean_radiance(reference.picture);
  if (!(layout_.top > 0)) layout_.top = 1;  // without noise everything is black
  layout_.map_width = std::min(picture.width, kMapWidth);
  layout_.map_height = static_cast<int>(
      std::max<std::int64_t>(std::int64_t{picture.height} * layout_.map_width / picture.width, 1));
  choose_crop(errors_of(picture, reference.picture), layout_);
}

std::string Details::crop_of(const Picture& picture) const {
  Picture crop(layout_.width, layout_.height);
  for (int y = 0; y < crop.height; ++y) {
    for (int x = 0; x < crop.width; ++x) crop.at(x, y) = picture.at(layout_.x + x, layout_.y + y);
  }
  return png_of(crop, mapping_);
}

std::string Details::error_map(const Picture& errors) const {
  std::vector<float> values;
  for (const LinearRgb& error : render::shrunk(errors, layout_.map_width, layout_.map_height).pixels) {
    values.push_back(static_cast<float>(error.r));
  }
  return png_of(render::color_mapped(values, layout_.map_width, layout_.map_height, layout_.top),
                {});
}

void Details::add(const render::Configuration& configuration, int samples, const Picture& picture,
                  const render::ReferencePicture& reference) {
  if (pictures_.empty()) {
    choose_layout(picture, reference);
    const Picture whole = render::shrunk(reference.picture, layout_.map_width, layout_.map_height);
    pictures_[kReferenceKey] = {.crop = crop_of(reference.picture), .map = png_of(whole, mapping_)};
  }
  pictures_[key_of(configuration, samples)] = {
      .crop = crop_of(picture), .map = error_map(errors_of(picture, reference.picture))};
}

void Details::add_rows(Report& report, const std::string& title, std::vector<Shown> shown) const {
  ReportRow& maps = report.error_maps.emplace_back(ReportRow{.title = title});
  for (const auto& [name, key] : shown) {
    maps.images.push_back({name, pictures_.at(key).map, layout_.map_width, layout_.map_height});
  }
  shown.push_back({"reference", kReferenceKey});
  ReportRow& crops = report.crops.emplace_back(
      ReportRow{.title = fmt::format("{}. The noisiest area ({} × {} pixels from {}, {})", title,
                                     layout_.width, layout_.height, layout_.x, layout_.y)});
  for (const auto& [name, key] : shown) {
    crops.images.push_back({name, pictures_.at(key).crop, layout_.width, layout_.height});
  }
}

void Details::fill(Report& report) const {
  const render::Measurement& measurement = report.measurement;
  if (pictures_.empty() || !measurement.reference) return;
  const double mean = measurement.reference->mean_radiance;
  report.error_map_top = mean > 0 ? layout_.top / mean : 0;
  report.picture = {"The reference", pictures_.at(kReferenceKey).map, layout_.map_width,
                    layout_.map_height};

  constexpr int kSamples = 64;
  std::vector<Shown> own, configurations;
  for (const render::Point& point : measurement.points) {
    const std::string key = key_of(point.configuration, point.samples);
    if (!pictures_.contains(key)) continue;
    const std::string error = percent(point.error.value);
    if (point.configuration == measurement.own) {
      own.push_back({fmt::format("{} samples, error {}", point.samples, error), key});
    }
    if (point.samples == kSamples) {
      configurations.push_back(
          {fmt::format("{}, {}, error {}", describe_configuration(measurement, point.configuration),
                       duration(point.seconds.value), error),
           key});
    }
  }
  // At most four, from the first to the last.
  constexpr std::size_t kMaxShown = 4;
  const std::size_t count = std::min(own.size(), kMaxShown);
  std::vector<Shown> spread;
  for (std::size_t i = 0; i < count; ++i) {
    spread.push_back(own[i * (own.size() - 1) / std::max<std::size_t>(count - 1, 1)]);
  }
  if (!spread.empty()) add_rows(report, "Increasing samples", std::move(spread));
  if (configurations.size() < 2) return;
  add_rows(report, fmt::format("Every configuration with {} samples", kSamples),
           std::move(configurations));
}

}  // namespace sdlc::cli
