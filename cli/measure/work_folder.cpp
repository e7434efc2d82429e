#include "cli/measure/work_folder.hpp"

#include <array>
#include <cerrno>
#include <cstddef>
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

SDLC_MEMBERS(DetailLayout, top, map_width, map_height, x, y, width, height)

namespace {

namespace fs = std::filesystem;

constexpr const char* kLockName = "lock";
constexpr const char* kReferenceName = "reference.f32";
constexpr const char* kFolderFormat = "sdlc-measure-work";

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

/// A pixel of a reference: red, green, blue, and two values for its noise.
using ReferencePixel = std::array<float, 5>;

std::string reference_bytes(const render::ReferencePicture& reference) {
  std::string bytes;
  for (std::size_t i = 0; i < reference.picture.pixels.size(); ++i) {
    const auto [r, g, b] = reference.picture.pixels[i];
    const ReferencePixel pixel{static_cast<float>(r), static_cast<float>(g), static_cast<float>(b),
                               reference.noise[i], reference.covariance[i]};
    bytes.append(reinterpret_cast<const char*>(pixel.data()), sizeof pixel);
  }
  return bytes;
}

render::ReferencePicture reference_of(std::string_view bytes, int width, int height) {
  render::ReferencePicture reference{.picture = render::Picture(width, height)};
  for (render::LinearRgb& color : reference.picture.pixels) {
    ReferencePixel pixel;
    std::memcpy(pixel.data(), bytes.data(), sizeof pixel);
    bytes.remove_prefix(sizeof pixel);
    color = {pixel[0], pixel[1], pixel[2]};
    reference.noise.push_back(pixel[3]);
    reference.covariance.push_back(pixel[4]);
  }
  return reference;
}

std::string crop_name(const std::string& key) { return key + ".crop.png"; }
std::string map_name(const std::string& key) { return key + ".map.png"; }

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

WorkFolder::State WorkFolder::read_study(const std::string& text) {
  const Json file = parse_json(text);
  std::string format, digest;
  read_value(field(file, "format"), "format", {}, format);
  if (format != kFolderFormat) throw std::invalid_argument("it is not a measurement");
  read_value(field(file, "digest"), "digest", {}, digest);
  const Json& study = field(file, "study");
  if (digest != digest_of(study.dump())) throw std::invalid_argument("it was changed");
  check_identity(field(study, "identity"));
  digests_ = field(study, "digests");
  State state;
  read_value(field(study, "ledger"), "ledger", {}, state.ledger);
  read_value(field(study, "layout"), "layout", {}, state.layout);
  read_value(field(study, "pictures"), "pictures", {}, state.keys);
  return state;
}

void WorkFolder::load(render::StudyLedger& ledger,
                      std::optional<render::ReferencePicture>& reference, Details& details) {
  const std::optional<std::string> text = read_file(folder_ / kStudyName);
  if (!text) return;
  State state;
  try {
    state = read_study(*text);
  } catch (const std::invalid_argument& error) {
    refuse_to_go_on(folder_, fmt::format("its study.json cannot be read ({})", error.what()));
  }
  ledger = std::move(state.ledger);
  details.restore(state.layout);
  if (ledger.reference) {
    const auto [width, height] = std::pair(ledger.plan->width, ledger.plan->height);
    const std::string bytes = read_whole(kReferenceName);
    if (bytes.size() / sizeof(ReferencePixel) != std::size_t(width) * std::size_t(height)) {
      refuse_to_go_on(folder_, "its reference.f32 has a different size");
    }
    reference = reference_of(bytes, width, height);
  }
  for (const std::string& key : state.keys) {
    details.restore(key, {.crop = read_whole(crop_name(key)), .map = read_whole(map_name(key))});
  }
}

std::string WorkFolder::read_whole(const std::string& name) {
  std::optional<std::string> bytes = read_file(folder_ / name);
  if (!bytes) refuse_to_go_on(folder_, fmt::format("its {} is missing", name));
  if (digest_of(*bytes) != digests_[name]) {
    refuse_to_go_on(folder_, fmt::format("its {} is damaged", name));
  }
  return *std::move(bytes);
}

void WorkFolder::write(const std::string& name, std::string_view bytes) {
  const std::string digest = digest_of(bytes);
  if (digests_[name] == digest) return;
  write_file(folder_ / name, bytes);
  digests_[name] = digest;
}

void WorkFolder::save(const render::StudyLedger& ledger, const Details& details) {
  Json keys = Json::array();
  for (const auto& [key, pictures] : details.pictures()) {
    keys.push_back(key);
    write(crop_name(key), pictures.crop);
    write(map_name(key), pictures.map);
  }
  const Json study{{"identity", identity_},
                   {"ledger", value_json(ledger)},
                   {"layout", value_json(details.layout())},
                   {"pictures", keys},
                   {"digests", digests_}};
  const Json file{{"format", kFolderFormat}, {"digest", digest_of(study.dump())}, {"study", study}};
  write_file(folder_ / kStudyName, file.dump(1) + "\n");
}

void WorkFolder::save(const render::ReferencePicture& reference) {
  write(kReferenceName, reference_bytes(reference));
}

}  // namespace sdlc::cli
