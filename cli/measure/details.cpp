#include "cli/measure/details.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/figures.hpp"
#include "render/compare/color_map.hpp"
#include "render/image/image.hpp"
#include "render/measure/configuration.hpp"

namespace sdlc::cli {
namespace {

using render::LinearRgb;
using render::Picture;

constexpr int kCropWidth = 96, kCropHeight = 72;
constexpr int kMapWidth = 240, kThumbnailWidth = 400;

/// The root mean square of the difference over the channels, per pixel.
std::vector<float> errors_of(const Picture& picture, const Picture& reference) {
  std::vector<float> errors;
  errors.reserve(picture.pixels.size());
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const LinearRgb d = picture.pixels[i] - reference.pixels[i];
    errors.push_back(static_cast<float>(std::sqrt((d.r * d.r + d.g * d.g + d.b * d.b) / 3)));
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

/// The range of pixels out of `count` that are averaged into pixel `i` of `fewer`.
std::pair<int, int> pixels_of(int i, int fewer, int count) {
  const auto edge = [&](int at) {
    return static_cast<int>(static_cast<long long>(at) * count / fewer);
  };
  return {edge(i), std::max(edge(i + 1), edge(i) + 1)};
}

/// `value(x, y)` averaged over the source pixels of each pixel of a smaller picture.
template <typename T, typename Value>
std::vector<T> shrunk(int width, int height, int from_width, int from_height, Value value) {
  std::vector<T> values;
  for (int v = 0; v < height; ++v) {
    const auto [top, bottom] = pixels_of(v, height, from_height);
    for (int u = 0; u < width; ++u) {
      const auto [left, right] = pixels_of(u, width, from_width);
      auto sum = value(left, top) * 0.0;
      for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) sum = sum + value(x, y);
      }
      values.push_back(static_cast<T>(sum / static_cast<double>((bottom - top) * (right - left))));
    }
  }
  return values;
}

/// A size of at most `max_width` with the same shape.
std::pair<int, int> smaller_size(int width, int height, int max_width) {
  const int smaller = std::min(width, max_width);
  return {smaller, std::max(1, static_cast<int>(static_cast<long long>(height) * smaller / width))};
}

/// Reads a window within pictures of this size.
Window window_of(const Json& json, int width, int height) {
  Window window{.title = field<std::string>(json, "title"),
                .x = whole_field(json, "x", 0, width - 1),
                .y = whole_field(json, "y", 0, height - 1)};
  window.width = whole_field(json, "width", 1, width - window.x);
  window.height = whole_field(json, "height", 1, height - window.y);
  return window;
}

/// Reads a size that is at most that of the pictures.
std::pair<int, int> size_of(const Json& json, const std::string& name, int width, int height) {
  const Json& size = any_field(json, name);
  if (!size.is_array() || size.size() != 2) {
    throw std::invalid_argument(fmt::format("its `{}` is not a list of two", name));
  }
  return {static_cast<int>(whole_of(size[0], name, 1, width)),
          static_cast<int>(whole_of(size[1], name, 1, height))};
}

}  // namespace

std::string Details::key_of(const render::Configuration& configuration, int samples) {
  std::string key =
      fmt::format("{}-samples-{}", fmt::join(render::parts_of(configuration), "-"), samples);
  std::ranges::replace(key, ' ', '-');
  return key;
}

void Details::choose_windows(const Picture& picture, const render::ReferencePicture& reference) {
  const std::vector<float> errors = errors_of(picture, reference.picture);
  mean_ = render::mean_radiance(reference.picture);
  // Four times the overall error, so that the maps of better pictures are not black.
  constexpr double kBrightest = 4;
  top_ = kBrightest * render::error_against(picture, reference).value * mean_;
  if (!(top_ > 0)) top_ = 1;  // without noise everything is black
  std::tie(map_width_, map_height_) = smaller_size(picture.width, picture.height, kMapWidth);
  std::tie(thumbnail_width_, thumbnail_height_) =
      smaller_size(picture.width, picture.height, kThumbnailWidth);

  const int width = std::min(picture.width, kCropWidth);
  const int height = std::min(picture.height, kCropHeight);
  std::vector<std::pair<double, Window>> places;
  for (int y = 0; y + height <= picture.height; y += std::max(height / 2, 1)) {
    for (int x = 0; x + width <= picture.width; x += std::max(width / 2, 1)) {
      double sum = 0;
      for (int v = y; v < y + height; ++v) {
        const auto row = errors.begin() + static_cast<std::ptrdiff_t>(v) * picture.width + x;
        // Square roots, so that a few bright pixels do not dominate.
        for (int u = 0; u < width; ++u) sum += std::sqrt(static_cast<double>(row[u]));
      }
      places.push_back({sum, {.x = x, .y = y, .width = width, .height = height}});
    }
  }
  std::ranges::stable_sort(places, std::greater(), &std::pair<double, Window>::first);
  const auto add = [&](const char* title, std::size_t rank) {
    Window window = places[rank].second;
    window.title =
        fmt::format("{} ({} × {} pixels from {}, {})", title, width, height, window.x, window.y);
    windows_.push_back(window);
  };
  add("The noisiest area", 0);
  if (places.size() > 4) add("An area of medium noise", places.size() / 2);
}

std::string Details::png(const Picture& picture) const {
  const auto bytes = render::encode_picture(
      picture, {.format = render::ImageFormat::Png, .tone = tone_, .metadata = {.software = ""}});
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

PictureDetails Details::details_of(const Picture& picture,
                                   const render::ReferencePicture* reference) const {
  PictureDetails details;
  for (const Window& window : windows_) details.crops.push_back(png(cropped(picture, window)));
  if (reference == nullptr) return details;
  const std::vector<float> errors = errors_of(picture, reference->picture);
  const auto error_at = [&](int x, int y) {
    return static_cast<double>(
        errors[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
               static_cast<std::size_t>(x)]);
  };
  const auto values =
      shrunk<float>(map_width_, map_height_, picture.width, picture.height, error_at);
  const Picture map = render::color_mapped(values, map_width_, map_height_, top_);
  const auto bytes = render::encode_picture(
      map, {.format = render::ImageFormat::Png, .metadata = {.software = ""}});
  details.error_map.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return details;
}

std::string Details::add(const render::Configuration& configuration, int samples,
                         const Picture& picture, const render::ReferencePicture& reference) {
  if (windows_.empty()) choose_windows(picture, reference);
  if (!pictures_.contains(kReferenceKey)) {
    PictureDetails details = details_of(reference.picture, nullptr);
    // The whole reference takes the place of its error map.
    Picture small(thumbnail_width_, thumbnail_height_);
    small.pixels = shrunk<LinearRgb>(small.width, small.height, picture.width, picture.height,
                                     [&](int x, int y) { return reference.picture.at(x, y); });
    details.error_map = png(small);
    pictures_[kReferenceKey] = std::move(details);
  }
  std::string key = key_of(configuration, samples);
  pictures_[key] = details_of(picture, &reference);
  return key;
}

void Details::add_rows(Report& report, const std::string& title,
                       const std::vector<Shown>& shown) const {
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    ReportRow row{.title = fmt::format("{}. {}", title, windows_[i].title), .images = {}};
    for (const auto& [name, key] : shown) {
      row.images.push_back({.title = name,
                            .png = at(key).crops.at(i),
                            .width = windows_[i].width,
                            .height = windows_[i].height});
    }
    report.crops.push_back(std::move(row));
  }
  ReportRow maps{.title = title, .images = {}};
  for (const auto& [name, key] : shown) {
    if (key == kReferenceKey) continue;
    maps.images.push_back(
        {.title = name, .png = at(key).error_map, .width = map_width_, .height = map_height_});
  }
  report.error_maps.push_back(std::move(maps));
}

void Details::fill(Report& report) const {
  if (windows_.empty() || !pictures_.contains(kReferenceKey)) return;
  const render::Measurement& measurement = report.measurement;
  report.error_map_top = mean_ > 0 ? top_ / mean_ : 0;
  report.picture = {.title = "The reference",
                    .png = at(kReferenceKey).error_map,
                    .width = thumbnail_width_,
                    .height = thumbnail_height_};

  std::vector<Shown> own;
  for (const render::Point& point : measurement.points) {
    const std::string key = key_of(point.configuration, point.samples);
    if (point.configuration != measurement.own || !pictures_.contains(key)) continue;
    own.push_back(
        {fmt::format("{} samples, error {}", point.samples, percent(point.error.value)), key});
  }
  // At most four, from the first to the last.
  constexpr std::size_t kMaxCount = 4;
  std::vector<Shown> shown;
  for (std::size_t i = 0; i < std::min(own.size(), kMaxCount); ++i) {
    const std::size_t steps = std::min(own.size(), kMaxCount) - 1;
    shown.push_back(own[steps == 0 ? 0 : i * (own.size() - 1) / steps]);
  }
  if (shown.empty()) return;
  shown.push_back({"reference", kReferenceKey});
  add_rows(report, "Increasing samples", shown);

  // All configurations that have a point with this number of samples.
  constexpr int kSamples = 64;
  std::vector<Shown> configurations;
  for (const render::Point& point : measurement.points) {
    const std::string key = key_of(point.configuration, point.samples);
    if (point.samples != kSamples || !pictures_.contains(key)) continue;
    configurations.push_back(
        {fmt::format("{}, {}, error {}", describe_configuration(measurement, point.configuration),
                     duration(point.seconds.value), percent(point.error.value)),
         key});
  }
  if (configurations.size() < 2) return;
  configurations.push_back({"reference", kReferenceKey});
  add_rows(report, fmt::format("Every configuration with {} samples", kSamples), configurations);
}

std::vector<std::string> Details::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, pictures] : pictures_) keys.push_back(key);
  return keys;
}

Json Details::frame_json() const {
  if (windows_.empty()) return nullptr;
  Json windows = Json::array();
  for (const auto& [title, x, y, width, height] : windows_) {
    windows.push_back({{"title", title}, {"x", x}, {"y", y}, {"width", width}, {"height", height}});
  }
  return {{"windows", windows},
          {"top", top_},
          {"mean", mean_},
          {"map", {map_width_, map_height_}},
          {"thumbnail", {thumbnail_width_, thumbnail_height_}}};
}

void Details::read_frame(const Json& json, int width, int height) {
  if (json.is_null()) return;
  windows_ = list_field(json, "windows",
                        [&](const Json& window) { return window_of(window, width, height); });
  if (windows_.empty()) throw std::invalid_argument("its `windows` are empty");
  top_ = positive_field(json, "top");
  mean_ = field<double>(json, "mean");
  std::tie(map_width_, map_height_) = size_of(json, "map", width, height);
  std::tie(thumbnail_width_, thumbnail_height_) = size_of(json, "thumbnail", width, height);
}

}  // namespace sdlc::cli
