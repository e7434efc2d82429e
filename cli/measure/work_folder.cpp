#include "cli/measure/work_folder.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "cli/measure/ledger_json.hpp"
#include "render/image/atomic_file.hpp"
#include "render/image/io_error.hpp"
#include "render/math/fnv.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockName = "lock";
constexpr const char* kReferenceName = "reference.f32";
constexpr const char* kMapName = "map";
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

/// Values per pixel of a reference: red, green, blue, and two for its noise.
constexpr std::size_t kValues = 5;

std::string reference_bytes(const render::ReferencePicture& reference) {
  std::vector<float> values;
  values.reserve(reference.picture.pixels.size() * kValues);
  for (std::size_t i = 0; i < reference.picture.pixels.size(); ++i) {
    const render::LinearRgb& pixel = reference.picture.pixels[i];
    for (const double v : {pixel.r, pixel.g, pixel.b}) values.push_back(static_cast<float>(v));
    values.push_back(reference.noise[i]);
    values.push_back(reference.covariance[i]);
  }
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

/// nullopt if the file does not hold a picture of this size.
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
    reference.noise.push_back(pixel[3]);
    reference.covariance.push_back(pixel[4]);
  }
  return reference;
}

std::string picture_name(const std::string& key, const std::string& what) {
  return fmt::format("{}.{}.png", key, what);
}
std::string crop_name(std::size_t index) { return fmt::format("crop-{}", index + 1); }

std::string digest_of(std::string_view bytes) {
  render::Fnv1a hash;
  hash.add(bytes);
  return fmt::format("{:016x}", hash.value());
}

[[noreturn]] void refuse_to_go_on(const fs::path& folder, const std::string& reason) {
  throw render::IoError("resume", folder, reason + "; remove the folder to start again");
}

}  // namespace

FileLock::FileLock(const fs::path& file, const fs::path& folder)
    : descriptor_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  const auto fail = [](const fs::path& path, int error) {
    throw render::IoError("lock", path, std::generic_category().message(error));
  };
  if (descriptor_ < 0) fail(file, errno);
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const int error = errno;
  ::close(descriptor_);
  if (error != EWOULDBLOCK) fail(file, error);
  throw render::IoError("work in", folder, "another sdlc is using it");
}

FileLock::~FileLock() { ::close(descriptor_); }

WorkFolder::WorkFolder(fs::path folder, Json identity)
    : folder_(std::move(folder)), identity_(std::move(identity)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw render::IoError("make", folder_, error.message());
  render::check_writable(folder_ / kStudyName);
  // Write nothing into a folder of somebody else, not even a lock; a locked folder may be in any
  // state.
  if (!fs::exists(folder_ / kLockName, error)) check_only_ours();
  lock_.emplace(folder_ / kLockName, folder_);
  check_only_ours();
}

void WorkFolder::check_only_ours() const {
  std::error_code error;
  if (fs::exists(folder_ / kStudyName, error)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
    if (entry.path().filename() == kLockName) continue;
    throw render::IoError("work in", folder_,
                          "it holds other files; name a new or an empty folder");
  }
  if (error) throw render::IoError("read", folder_, error.message());
}

void WorkFolder::check_identity(const Json& kept) const {
  for (const auto& [name, value] : identity_.items()) {
    const Json was = kept.contains(name) ? kept.at(name) : Json();
    if (was == value) continue;
    const auto text = [](const Json& json) {
      return json.is_string() ? json.get<std::string>() : json.dump();
    };
    throw render::IoError("resume", folder_,
                          fmt::format("its measurement has another {} ({}, now {}); name another "
                                      "folder, or remove this one to start again",
                                      name, text(was), text(value)));
  }
}

void WorkFolder::read_study(const std::string& text, render::StudyLedger& ledger, Details& details,
                            std::vector<std::string>& keys) {
  const Json json = parse_json(text);
  if (field<std::string>(json, "format") != kFormat) {
    throw std::invalid_argument("it is not a measurement");
  }
  check_identity(any_field(json, "identity"));
  ledger = read_ledger(any_field(json, "ledger").dump());
  const Json& frame = any_field(json, "details");
  if (ledger.plan) details.read_frame(frame, ledger.plan->width, ledger.plan->height);
  keys = list_field(json, "pictures", [](const Json& key) { return string_of(key, "pictures"); });
  if (!keys.empty() && details.windows().empty()) {
    throw std::invalid_argument("it has `pictures` but no `windows`");
  }
  const Json& digests = any_field(json, "digests");
  if (!digests.is_object()) throw std::invalid_argument("its `digests` is not an object");
  for (const auto& [name, digest] : digests.items()) digests_[name] = string_of(digest, name);
}

bool WorkFolder::load(render::StudyLedger& ledger,
                      std::optional<render::ReferencePicture>& reference, Details& details) {
  const std::optional<std::string> text = read_file(folder_ / kStudyName);
  if (!text) return false;
  std::vector<std::string> keys;
  try {
    read_study(*text, ledger, details, keys);
  } catch (const std::invalid_argument& error) {
    refuse_to_go_on(folder_, fmt::format("its study.json cannot be read ({})", error.what()));
  }
  if (ledger.reference) {
    reference = reference_of(read_whole(kReferenceName), ledger.plan->width, ledger.plan->height);
    if (!reference) refuse_to_go_on(folder_, "its reference.f32 has a different size");
  }
  const std::size_t crops = details.windows().size();
  for (const std::string& key : keys) {
    PictureDetails pictures;
    for (std::size_t i = 0; i < crops; ++i) {
      pictures.crops.push_back(read_whole(picture_name(key, crop_name(i))));
    }
    pictures.error_map = read_whole(picture_name(key, kMapName));
    details.restore(key, std::move(pictures));
  }
  return true;
}

std::string WorkFolder::read_whole(const std::string& name) const {
  const auto digest = digests_.find(name);
  // A name that was not written by us could be any path.
  if (digest == digests_.end()) {
    refuse_to_go_on(folder_, fmt::format("its study.json has no digest of {}", name));
  }
  std::optional<std::string> bytes = read_file(folder_ / name);
  if (!bytes) refuse_to_go_on(folder_, fmt::format("its {} is missing", name));
  if (digest_of(*bytes) != digest->second) {
    refuse_to_go_on(folder_, fmt::format("its {} is damaged", name));
  }
  return *std::move(bytes);
}

void WorkFolder::write(const std::string& name, std::string_view bytes) {
  write_file(folder_ / name, bytes);
  digests_[name] = digest_of(bytes);
}

void WorkFolder::save(const render::StudyLedger& ledger, const Details& details) {
  const Json json{{"format", kFormat},
                  {"identity", identity_},
                  {"ledger", Json::parse(to_json(ledger))},
                  {"details", details.frame_json()},
                  {"pictures", details.keys()},
                  {"digests", digests_}};
  write_file(folder_ / kStudyName, json.dump(1) + "\n");
}

void WorkFolder::save(const render::ReferencePicture& reference) {
  write(kReferenceName, reference_bytes(reference));
}

void WorkFolder::save(const std::string& key, const PictureDetails& pictures) {
  for (std::size_t i = 0; i < pictures.crops.size(); ++i) {
    write(picture_name(key, crop_name(i)), pictures.crops[i]);
  }
  write(picture_name(key, kMapName), pictures.error_map);
}

}  // namespace sdlc::cli
