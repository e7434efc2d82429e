#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <sys/types.h>

#include "cli/interrupt.hpp"
#include "cli/video_writer.hpp"
#include "render/image/atomic_file.hpp"

/// ffmpeg runs as a program of its own.
namespace sdlc::cli {

/// Whether it is in PATH.
bool has_ffmpeg();

/// The arguments of ffmpeg, without the program's name: it reads frames as VideoWriter::add() has
/// them from standard input. Colours are converted to BT.709 and tagged so, with the limited range
/// of video; GIF, WebP and APNG hold RGB. An odd side gets one more row or column, a copy of the
/// last, because H.264 and VP9 share colours among 2 × 2 pixels.
std::vector<std::string> ffmpeg_arguments(VideoFormat format, const VideoSettings& settings,
                                          const std::filesystem::path& file);

class FfmpegWriter final : public VideoWriter {
 public:
  /// Starts ffmpeg. Throws IoError.
  FfmpegWriter(const std::filesystem::path& path, VideoFormat format,
               const VideoSettings& settings);
  /// Ends ffmpeg and removes what it has written, unless it is finished.
  ~FfmpegWriter() override;

  /// Waits if ffmpeg is slower. Throws IoError if it has ended, or is given up.
  void add(std::span<const std::uint8_t> frame) override;
  void finish() override;
  double frames_per_second() const noexcept override { return frames_per_second_; }

 private:
  /// Throws IoError, for a full disk if it is full: the status of ffmpeg is the same.
  [[noreturn]] void fail_encoding(const char* cause) const;
  [[noreturn]] void give_up() const;
  /// Waits until ffmpeg has ended and returns whether it succeeded. Throws IoError if it is given
  /// up.
  bool wait();
  /// Whether ffmpeg succeeded; nullopt if it runs, with WNOHANG in `flags`.
  std::optional<bool> reap(int flags) noexcept;

  double frames_per_second_;
  std::filesystem::path shown_;
  render::AtomicFile file_;
  const std::atomic<bool>* interrupted_;
  int input_ = -1;
  pid_t process_ = -1;
  std::optional<KilledBySignals> killed_;
};

}  // namespace sdlc::cli
