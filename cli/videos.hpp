#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cli/environment.hpp"
#include "cli/exit_code.hpp"
#include "cli/outputs.hpp"
#include "cli/video_writer.hpp"

namespace sdlc::cli {

/// The frames of an animation, as its videos need them.
struct VideoFrames {
  std::size_t count = 1;
  double per_second = 24;
};

/// The videos of one scene, which are encoded while its frames are rendered.
class Videos {
 public:
  /// Takes the outputs that are videos of this many frames: those that only videos have the
  /// extension of, and GIF and WebP without a frame mark if there are several frames.
  static std::vector<std::string> take_from(std::vector<std::string>& outputs, std::size_t frames);

  Videos() = default;
  /// `names`: from take_from(), with the scene's name inserted.
  Videos(const std::vector<std::string>& names, VideoFrames frames, int crf);

  bool empty() const noexcept { return videos_.empty(); }
  /// Foreseeable failures, before the first frame. Throws UsageError and IoError.
  void check(const InputSet& inputs, OutputSet& outputs, bool keeps_existing) const;
  /// Adds a frame, as VideoWriter::add() takes it. Throws IoError.
  void add(std::span<const std::uint8_t> codes, int width, int height);
  /// Puts the videos in their places if they have all frames; `finished` were added. Reports
  /// failures, and the videos unless `is_quiet`.
  ExitCode finish(std::size_t finished, bool is_quiet, Environment& env);

 private:
  struct Video {
    std::string path;
    VideoFormat format;
    std::unique_ptr<VideoWriter> writer;  // from the first frame on
  };

  std::vector<Video> videos_;
  VideoFrames frames_;
  int crf_ = 0;
};

}  // namespace sdlc::cli
