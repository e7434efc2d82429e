#include "cli/video_writer.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "cli/ffmpeg_writer.hpp"
#include "cli/gif_writer.hpp"
#include "render/image/codec_loader.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

struct FormatRow {
  VideoFormat format;
  std::string_view extension;
  bool is_only_video;
  double min_rate, max_rate;  ///< in frames per second
};
// Delays are 1/100 s in GIF, at least 2 in browsers, and at most 65535; 1/1000 s in WebM, Matroska
// and WebP, there with 24 bits.
constexpr double kSlowest = 1e-6, kFastest = 1e6;
constexpr std::array kFormats{
    FormatRow{VideoFormat::Mp4, ".mp4", true, kSlowest, kFastest},
    FormatRow{VideoFormat::WebM, ".webm", true, kSlowest, 1000},
    FormatRow{VideoFormat::Matroska, ".mkv", true, kSlowest, 1000},
    FormatRow{VideoFormat::Gif, ".gif", false, 100.0 / 65535, 50},
    FormatRow{VideoFormat::WebP, ".webp", false, 1000.0 / ((1 << 24) - 1), 1000},
    FormatRow{VideoFormat::Apng, ".apng", true, kSlowest, kFastest}};

const FormatRow& row_of(VideoFormat format) { return kFormats[static_cast<std::size_t>(format)]; }

}  // namespace

std::optional<VideoFormat> video_format_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto* const found = std::ranges::find(kFormats, extension, &FormatRow::extension);
  return found != kFormats.end() ? std::optional(found->format) : std::nullopt;
}

bool is_only_video(VideoFormat format) noexcept { return row_of(format).is_only_video; }

void check_video_writer(VideoFormat format, const fs::path& shown) {
  if (has_ffmpeg()) return;
  constexpr const char* kCause =
      "this needs ffmpeg, which is not installed (Debian: apt install ffmpeg)";
  if (format != VideoFormat::Gif) {
    throw render::IoError("write", shown,
                          fmt::format("{}; -o NAME.gif needs only the Debian package "
                                      "sdlc-openimageio, frames, -o NAME.####.png, need nothing",
                                      kCause));
  }
  try {
    render::check_image_codec(render::ImageFormat::Gif);
  } catch (const render::IoError& missing) {
    throw render::IoError("write", shown,
                          fmt::format("{} or OpenImageIO: {}", kCause, missing.what()));
  }
}

std::unique_ptr<VideoWriter> open_video(const fs::path& path, VideoFormat format,
                                        const VideoSettings& given) {
  VideoSettings settings = given;
  const FormatRow& row = row_of(format);
  settings.frames_per_second = std::clamp(given.frames_per_second, row.min_rate, row.max_rate);
  if (format == VideoFormat::Gif && !has_ffmpeg()) {
    return std::make_unique<GifWriter>(path, settings);
  }
  return std::make_unique<FfmpegWriter>(path, format, settings);
}

}  // namespace sdlc::cli
