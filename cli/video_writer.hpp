#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "render/image/atomic_file.hpp"

/// Video files, which ffmpeg encodes: it runs as a program of its own.
namespace sdlc::cli {

enum class VideoFormat : std::uint8_t { Mp4, WebM, Matroska, Gif, WebP, Apng };

/// The format that the extension of a name has, if it is one of video files. GIF and WebP files may
/// also be single pictures.
std::optional<VideoFormat> video_format_of(const std::filesystem::path& path);
bool is_only_video(VideoFormat format) noexcept;

struct VideoSettings {
  int width = 0, height = 0;
  double frames_per_second = 24;
  /// Constant rate factor of H.264 and VP9, from 0, the best, to 51.
  int crf = 18;
};

/// The arguments of ffmpeg, without the program's name: it reads frames as VideoWriter::add() has
/// them from standard input. Colours are converted to BT.709 and tagged so, with the limited range
/// of video; GIF, WebP and APNG hold RGB. An odd side gets one more row or column, a copy of the
/// last, because H.264 and VP9 share colours among 2 × 2 pixels.
std::vector<std::string> ffmpeg_arguments(VideoFormat format, const VideoSettings& settings,
                                          const std::filesystem::path& file);

/// Throws IoError, with what to install, if there is no ffmpeg in PATH.
void check_ffmpeg(const std::filesystem::path& shown);

/// Encodes frames while they are rendered. The file appears as a whole, in finish(), or not at all.
class VideoWriter {
 public:
  /// Starts ffmpeg. Throws IoError.
  VideoWriter(const std::filesystem::path& path, VideoFormat format, const VideoSettings& settings);
  /// Ends ffmpeg and removes what it has written, unless it is finished.
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// `frame`: the codes of red, green and blue of each pixel, row by row from the top. Waits if
  /// ffmpeg is slower. Throws IoError if it has ended.
  void add(std::span<const std::uint8_t> frame);
  /// Throws IoError if ffmpeg fails or the file cannot be put in its place.
  void finish();

 private:
  /// Waits for ffmpeg and returns whether it succeeded.
  bool wait() noexcept;

  std::filesystem::path shown_, target_, unfinished_;
  std::optional<render::RemovedBySignals> removed_by_signals_;
  int input_ = -1;
  pid_t process_ = -1;
};

}  // namespace sdlc::cli
