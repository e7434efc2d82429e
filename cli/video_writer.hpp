#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

/// Video files.
namespace sdlc::cli {

enum class VideoFormat : std::uint8_t { Mp4, WebM, Matroska, Gif, WebP, Apng };

/// The format that the extension of a name has, if it is one of video files. GIF and WebP files may
/// also be single pictures.
std::optional<VideoFormat> video_format_of(const std::filesystem::path& path);
bool is_only_video(VideoFormat format) noexcept;

struct VideoSettings {
  int width = 0, height = 0;
  std::size_t frames = 1;
  double frames_per_second = 24;
  /// Constant rate factor of H.264 and VP9, from 0, the best, to 51.
  int crf = 18;
  /// Set by Ctrl-C: from then on, an encoder that does nothing is given up.
  const std::atomic<bool>* interrupted = nullptr;
};

/// Encodes frames while they are rendered. The file appears as a whole, in finish(), or not at all.
class VideoWriter {
 public:
  VideoWriter() = default;
  virtual ~VideoWriter() = default;
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// `frame`: the codes of red, green and blue of each pixel, row by row from the top. Throws
  /// IoError.
  virtual void add(std::span<const std::uint8_t> frame) = 0;
  /// Throws IoError if the file cannot be put in its place.
  virtual void finish() = 0;
  /// The rate that the file has.
  virtual double frames_per_second() const noexcept = 0;
};

/// Throws IoError, with what to install, if a file of this format cannot be written: all but GIF
/// need ffmpeg.
void check_video_writer(VideoFormat format, const std::filesystem::path& shown);

/// Writes with ffmpeg if it is in PATH. Formats whose delays are whole units of time limit the
/// rate. Throws IoError.
std::unique_ptr<VideoWriter> open_video(const std::filesystem::path& path, VideoFormat format,
                                        const VideoSettings& settings);

}  // namespace sdlc::cli
