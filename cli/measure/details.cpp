#include "cli/measure/details.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/figures.hpp"
#include "render/compare/color_map.hpp"
#include "render/image/image.hpp"

namespace sdlc::cli {
namespace {

using render::LinearRgb;
using render::Picture;

constexpr int kCropWidth = 96, kCropHeight = 72;
constexpr const char* kReferenceKey = "reference";
constexpr int kMapWidth = 240, kThumbnailWidth = 400;

/// A file name for the details of a picture.
std::string key_of(const render::Configuration& configuration, int samples) {
  std::string key =
      fmt::format("{}-samples-{}", fmt::join(render::parts_of(configuration), "-"), samples);
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

Picture cropped(const Picture& picture, const Window& window) {
  Picture crop(window.width, window.height);
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) crop.at(x, y) = picture.at(window.x + x, window.y + y);
  }
  return crop;
}

/// Averages over the pixels that each pixel of the smaller picture covers (a box filter).
Picture shrunk(const Picture& picture, int width, int height) {
  const auto covered = [](int i, int fewer, int count) {
    const auto edge = [&](std::int64_t at) { return static_cast<int>(at * count / fewer); };
    return std::pair(edge(i), std::max(edge(i + 1), edge(i) + 1));
  };
  Picture smaller(width, height);
  for (int v = 0; v < height; ++v) {
    const auto [top, bottom] = covered(v, height, picture.height);
    for (int u = 0; u < width; ++u) {
      const auto [left, right] = covered(u, width, picture.width);
      LinearRgb sum;
      for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) sum = sum + picture.at(x, y);
      }
      smaller.at(u, v) = sum / static_cast<double>((bottom - top) * (right - left));
    }
  }
  return smaller;
}

/// A size of at most `max_width` with the shape of the picture.
std::pair<int, int> smaller_size(const Picture& picture, int max_width) {
  const int width = std::min(picture.width, max_width);
  const std::int64_t height = std::int64_t{picture.height} * width / picture.width;
  return {width, std::max(1, static_cast<int>(height))};
}

/// Overlapping windows over the whole picture, from the noisiest to the cleanest.
std::vector<Window> windows_by_noise(const Picture& errors) {
  const int width = std::min(errors.width, kCropWidth);
  const int height = std::min(errors.height, kCropHeight);
  std::vector<std::pair<double, Window>> rated;
  for (int y = 0; y + height <= errors.height; y += std::max(height / 2, 1)) {
    for (int x = 0; x + width <= errors.width; x += std::max(width / 2, 1)) {
      double sum = 0;
      for (int v = y; v < y + height; ++v) {
        // Square roots, so that a few bright pixels do not dominate.
        for (int u = x; u < x + width; ++u) sum += std::sqrt(errors.at(u, v).r);
      }
      rated.push_back({sum, {.x = x, .y = y, .width = width, .height = height}});
    }
  }
  std::ranges::stable_sort(rated, std::greater(), &std::pair<double, Window>::first);
  std::vector<Window> windows;
  for (auto& [sum, window] : rated) windows.push_back(std::move(window));
  return windows;
}

std::string as_string(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

void Details::choose_layout(const Picture& picture, const render::ReferencePicture& reference) {
  layout_.mean = render::mean_radiance(reference.picture);
  // Four times the overall error, so that the maps of better pictures are not black.
  constexpr double kBrightest = 4;
  layout_.top = kBrightest * render::error_against(picture, reference).value * layout_.mean;
  if (!(layout_.top > 0)) layout_.top = 1;  // without noise everything is black
  std::tie(layout_.map_width, layout_.map_height) = smaller_size(picture, kMapWidth);
  std::tie(layout_.thumbnail_width, layout_.thumbnail_height) =
      smaller_size(picture, kThumbnailWidth);
  const std::vector<Window> windows = windows_by_noise(errors_of(picture, reference.picture));
  const auto add = [&](const char* title, Window window) {
    window.title = fmt::format("{} ({} × {} pixels from {}, {})", title, window.width,
                               window.height, window.x, window.y);
    layout_.windows.push_back(std::move(window));
  };
  add("The noisiest area", windows.front());
  if (windows.size() > 4) add("An area of medium noise", windows[windows.size() / 2]);
}

std::string Details::png(const Picture& picture) const {
  return as_string(render::encode_picture(
      picture, {.format = render::ImageFormat::Png, .tone = tone_, .metadata = {.software = ""}}));
}

std::vector<std::string> Details::crops_of(const Picture& picture) const {
  std::vector<std::string> crops;
  for (const Window& window : layout_.windows) crops.push_back(png(cropped(picture, window)));
  return crops;
}

std::string Details::error_map(const Picture& picture, const Picture& reference) const {
  std::vector<float> values;
  for (const LinearRgb& error :
       shrunk(errors_of(picture, reference), layout_.map_width, layout_.map_height).pixels) {
    values.push_back(static_cast<float>(error.r));
  }
  return as_string(render::encode_picture(
      render::color_mapped(values, layout_.map_width, layout_.map_height, layout_.top),
      {.format = render::ImageFormat::Png, .metadata = {.software = ""}}));
}

void Details::add(const render::Configuration& configuration, int samples, const Picture& picture,
                  const render::ReferencePicture& reference) {
  if (layout_.windows.empty()) choose_layout(picture, reference);
  if (!pictures_.contains(kReferenceKey)) {
    // The whole reference takes the place of its error map.
    pictures_[kReferenceKey] = {.crops = crops_of(reference.picture),
                                .error_map = png(shrunk(reference.picture, layout_.thumbnail_width,
                                                        layout_.thumbnail_height))};
  }
  pictures_[key_of(configuration, samples)] = {.crops = crops_of(picture),
                                               .error_map = error_map(picture, reference.picture)};
}

void Details::add_rows(Report& report, const std::string& title, std::vector<Shown> shown) const {
  ReportRow maps{.title = title, .images = {}};
  for (const auto& [name, key] : shown) {
    maps.images.push_back({.title = name,
                           .png = pictures_.at(key).error_map,
                           .width = layout_.map_width,
                           .height = layout_.map_height});
  }
  report.error_maps.push_back(std::move(maps));
  shown.push_back({"reference", kReferenceKey});
  for (std::size_t i = 0; i < layout_.windows.size(); ++i) {
    const Window& window = layout_.windows[i];
    ReportRow row{.title = fmt::format("{}. {}", title, window.title), .images = {}};
    for (const auto& [name, key] : shown) {
      row.images.push_back({.title = name,
                            .png = pictures_.at(key).crops.at(i),
                            .width = window.width,
                            .height = window.height});
    }
    report.crops.push_back(std::move(row));
  }
}

void Details::fill(Report& report) const {
  if (!pictures_.contains(kReferenceKey)) return;
  const render::Measurement& measurement = report.measurement;
  report.error_map_top = layout_.mean > 0 ? layout_.top / layout_.mean : 0;
  report.picture = {.title = "The reference",
                    .png = pictures_.at(kReferenceKey).error_map,
                    .width = layout_.thumbnail_width,
                    .height = layout_.thumbnail_height};

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
  std::vector<Shown> spread = own;
  if (own.size() > kMaxShown) {
    spread.clear();
    for (std::size_t i = 0; i < kMaxShown; ++i) {
      spread.push_back(own[i * (own.size() - 1) / (kMaxShown - 1)]);
    }
  }
  if (spread.empty()) return;
  add_rows(report, "Increasing samples", std::move(spread));
  if (configurations.size() < 2) return;
  add_rows(report, fmt::format("Every configuration with {} samples", kSamples),
           std::move(configurations));
}

}  // namespace sdlc::cli
