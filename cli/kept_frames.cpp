#include "cli/kept_frames.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "cli/frames.hpp"
#include "render/image/atomic_file.hpp"
#include "render/image/decoded_file.hpp"
#include "render/image/image.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOrigin = "sdlc:origin";
constexpr const char* kRecord = "sdlc:record";
constexpr const char* kZoom = "sdlc:zoom";

std::string entry(const render::DecodedImage& image, std::string_view key) {
  const auto found = std::ranges::find(image.metadata, key, [](const auto& e) { return e.first; });
  return found != image.metadata.end() ? found->second : std::string();
}

/// Why a kept frame is not that of the film, as a clause; empty if it is. Throws IoError if it does
/// not say.
std::string obstacle(const fs::path& path, const render::DecodedImage& image,
                     const render::StoredFilm& film, int zoom) {
  render::FilmOrigin origin;
  render::PictureRecord record;
  const std::string has = entry(image, kZoom);
  if (!read_text(entry(image, kOrigin), origin) || !read_text(entry(image, kRecord), record) ||
      has.empty()) {
    throw render::IoError("read", path, "it does not say of which picture it is");
  }
  if (std::string other = difference(record, film.record); !other.empty()) return other;
  if (std::string other = difference(origin, film.origin); !other.empty()) return other;
  const std::string wanted = fmt::to_string(zoom);
  if (has != wanted) return fmt::format("`zoom` is {}, not {}", has, wanted);
  const int width = origin.crop.width * zoom, height = origin.crop.height * zoom;
  if (image.width != width || image.height != height || image.channels.size() != 3 ||
      image.white != 255) {
    throw render::IoError(
        "read", path, fmt::format("it does not have {} x {} pixels of 3 x 8 bits", width, height));
  }
  return {};
}

}  // namespace

KeptFrames::KeptFrames(const fs::path& video, int zoom)
    : folder_(fs::path(video) += ".frames"), zoom_(zoom) {}

fs::path KeptFrames::film(int frame) const {
  return folder_ / name_of_frame("####.kept.film", frame);
}

fs::path KeptFrames::picture(int frame) const {
  return folder_ / name_of_frame("####.kept.png", frame);
}

std::optional<std::vector<std::uint8_t>> KeptFrames::find(int frame,
                                                          const render::StoredFilm& film) const {
  const fs::path path = picture(frame);
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return std::nullopt;
  const render::DecodedImage image = render::decode_file(path).image;
  if (const std::string other = obstacle(path, image, film, zoom_); !other.empty()) {
    throw render::FilmError(
        render::FilmError::Reason::Foreign, path,
        "the video cannot go on from this frame: " + other + "; remove the folder to begin again");
  }
  std::vector<std::uint8_t> codes;
  codes.reserve(image.values.size());
  for (const float code : image.values) codes.push_back(static_cast<std::uint8_t>(code));
  return codes;
}

void KeptFrames::keep(int frame, const render::StoredFilm& film, const render::Picture& picture,
                      const render::ToneMapping& mapping) const {
  const render::ParentFolders folders(this->picture(frame));
  render::write_picture(this->picture(frame), picture,
                        {.mapping = mapping,
                         .metadata = {.entries = {{kOrigin, text_of(film.origin)},
                                                  {kRecord, text_of(film.record)},
                                                  {kZoom, fmt::to_string(zoom_)}}}});
}

void KeptFrames::remove(const std::vector<int>& frames) const {
  std::error_code ignored;
  for (const int frame : frames) {
    fs::remove(picture(frame), ignored);
    fs::remove(film(frame), ignored);
  }
  fs::remove(folder_, ignored);
}

}  // namespace sdlc::cli
