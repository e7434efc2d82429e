#include "cli/video_writer.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include "cli/ffmpeg_writer.hpp"
#include "cli/gif_writer.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

struct FormatRow {
  VideoFormat format;
  std::string_view extension;
  bool is_only_video;
};
constexpr std::array kFormats{
    FormatRow{VideoFormat::Mp4, ".mp4", true},      FormatRow{VideoFormat::WebM, ".webm", true},
    FormatRow{VideoFormat::Matroska, ".mkv", true}, FormatRow{VideoFormat::Gif, ".gif", false},
    FormatRow{VideoFormat::WebP, ".webp", false},   FormatRow{VideoFormat::Apng, ".apng", true}};

}  // namespace

std::optional<VideoFormat> video_format_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto* const found = std::ranges::find(kFormats, extension, &FormatRow::extension);
  return found != kFormats.end() ? std::optional(found->format) : std::nullopt;
}

bool is_only_video(VideoFormat format) noexcept {
  return kFormats[static_cast<std::size_t>(format)].is_only_video;
}

void check_video_writer(VideoFormat format, const fs::path& shown) {
  if (format == VideoFormat::Gif || has_ffmpeg()) return;
  throw render::IoError("write", shown,
                        "this needs ffmpeg, which is not installed (Debian: apt install ffmpeg); "
                        "-o NAME.gif and frames, -o NAME.####.png, need nothing");
}

std::unique_ptr<VideoWriter> open_video(const fs::path& path, VideoFormat format,
                                        const VideoSettings& settings) {
  if (format == VideoFormat::Gif && !has_ffmpeg()) {
    return std::make_unique<GifWriter>(path, settings);
  }
  return std::make_unique<FfmpegWriter>(path, format, settings);
}

}  // namespace sdlc::cli
