#include "cli/measure/work_folder.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/measure/ledger_json.hpp"
#include "render/image/atomic_file.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStudyName = "study.json";
constexpr const char* kReferenceName = "reference.f32";
constexpr const char* kFormat = "sdlc-measure-work";

std::optional<std::string> read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::string bytes(std::istreambuf_iterator<char>(file), {});
  if (file.bad()) return std::nullopt;
  return bytes;
}

void write_file(const fs::path& path, std::string_view bytes) {
  render::write_file_atomically(path, std::as_bytes(std::span(bytes)));
}

/// Values that a reference has a pixel: red, green, blue, squared error, covariance.
constexpr std::size_t kValues = 5;

std::string reference_bytes(const render::ReferencePicture& reference) {
  std::vector<float> values;
  values.reserve(reference.picture.pixels.size() * kValues);
  for (std::size_t i = 0; i < reference.picture.pixels.size(); ++i) {
    const render::LinearRgb& pixel = reference.picture.pixels[i];
    for (const double v : {pixel.r, pixel.g, pixel.b}) values.push_back(static_cast<float>(v));
    values.push_back(reference.squared_error[i]);
    values.push_back(reference.covariance[i]);
  }
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

/// Nothing where the file is not of a picture of this size.
std::optional<render::ReferencePicture> reference_of(const std::string& bytes, int width,
                                                     int height) {
  render::ReferencePicture reference{.picture = render::Picture(width, height)};
  const std::size_t pixels = reference.picture.pixels.size();
  if (bytes.size() != pixels * kValues * sizeof(float)) return std::nullopt;
  std::vector<float> values(pixels * kValues);
  std::memcpy(values.data(), bytes.data(), bytes.size());
  for (std::size_t i = 0; i < pixels; ++i) {
    const float* const pixel = values.data() + i * kValues;
    reference.picture.pixels[i] = {pixel[0], pixel[1], pixel[2]};
    reference.squared_error.push_back(pixel[3]);
    reference.covariance.push_back(pixel[4]);
  }
  return reference;
}

fs::path picture_name(const std::string& key, const std::string& what) {
  return fmt::format("{}.{}.png", key, what);
}

}  // namespace

WorkFolder::WorkFolder(fs::path folder, Json identity)
    : folder_(std::move(folder)), identity_(std::move(identity)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw render::IoError("make", folder_, error.message());
  render::check_writable(folder_ / kStudyName);
}

void WorkFolder::check_identity(const Json& kept) const {
  for (const auto& [name, value] : identity_.items()) {
    const Json was = kept.contains(name) ? kept.at(name) : Json();
    if (was == value) continue;
    const auto text = [](const Json& json) {
      return json.is_string() ? json.get<std::string>() : json.dump();
    };
    throw render::IoError(
        "go on with", folder_,
        fmt::format("its measurement has another {} ({}, now {}); name another folder, or remove "
                    "this one to begin anew",
                    name, text(was), text(value)));
  }
}

bool WorkFolder::load(render::StudyLedger& ledger,
                      std::optional<render::ReferencePicture>& reference, Details& details) const {
  const std::optional<std::string> text = read_file(folder_ / kStudyName);
  if (!text) return false;
  const auto fail = [&](const std::string& reason) {
    throw render::IoError("go on with", folder_, reason + "; remove the folder to begin anew");
  };
  std::vector<std::string> keys;
  try {
    const Json json = Json::parse(*text);
    if (json.at("format") != kFormat) fail("its study.json is no measurement");
    check_identity(json.at("identity"));
    ledger = read_ledger(json.at("ledger").dump());
    details.read_frame(json.at("details"));
    keys = json.at("pictures").get<std::vector<std::string>>();
  } catch (const render::IoError&) {
    throw;
  } catch (const std::exception& error) {
    fail(fmt::format("its study.json cannot be read ({})", error.what()));
  }
  if (ledger.reference && ledger.plan) {
    const auto bytes = read_file(folder_ / kReferenceName);
    if (bytes) reference = reference_of(*bytes, ledger.plan->width, ledger.plan->height);
    if (!reference) fail("its reference.f32 is missing or cut short");
  }
  const std::size_t crops = details.windows().size();
  for (const std::string& key : keys) {
    PictureDetails pictures;
    const auto picture = [&](const std::string& what) {
      std::optional<std::string> bytes = read_file(folder_ / picture_name(key, what));
      if (!bytes) fail(fmt::format("its {} is missing", picture_name(key, what).string()));
      return *std::move(bytes);
    };
    for (std::size_t i = 0; i < crops; ++i) {
      pictures.crops.push_back(picture(fmt::format("crop-{}", i + 1)));
    }
    pictures.error_map = picture("map");
    details.restore(key, std::move(pictures));
  }
  return true;
}

void WorkFolder::save(const render::StudyLedger& ledger, const Details& details) const {
  const Json json{{"format", kFormat},
                  {"identity", identity_},
                  {"ledger", Json::parse(to_json(ledger))},
                  {"details", details.frame_json()},
                  {"pictures", details.keys()}};
  write_file(folder_ / kStudyName, json.dump(1) + "\n");
}

void WorkFolder::save(const render::ReferencePicture& reference) const {
  write_file(folder_ / kReferenceName, reference_bytes(reference));
}

void WorkFolder::save(const std::string& key, const PictureDetails& pictures) const {
  for (std::size_t i = 0; i < pictures.crops.size(); ++i) {
    write_file(folder_ / picture_name(key, fmt::format("crop-{}", i + 1)), pictures.crops[i]);
  }
  write_file(folder_ / picture_name(key, "map"), pictures.error_map);
}

}  // namespace sdlc::cli
