#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/environment.hpp"
#include "cli/exit_code.hpp"
#include "cli/kept_frames.hpp"
#include "cli/outputs.hpp"
#include "cli/render_options.hpp"
#include "cli/video_writer.hpp"
#include "render/film/film_file.hpp"
#include "render/image/picture.hpp"
#include "render/image/tone.hpp"

namespace sdlc::cli {

/// The frames of an animation, as its videos need them.
struct VideoFrames {
  std::vector<int> numbers = {};
  double per_second = 24;
};

/// The videos of one scene, which are encoded while its frames are rendered. With --checkpoint or
/// --resume, finished frames are kept until the videos are whole.
class Videos {
 public:
  /// Takes the outputs that are videos of this many frames: those that only videos have the
  /// extension of, and GIF and WebP without a frame mark if there are several frames.
  static std::vector<std::string> take_from(std::vector<std::string>& outputs, std::size_t frames);

  Videos() = default;
  /// `names`: from take_from(), with the scene's name inserted; with --skip-existing those that are
  /// there are left out. `interrupted`: VideoSettings::interrupted. Throws UsageError if there are
  /// kept frames, and no --resume.
  Videos(const std::vector<std::string>& names, VideoFrames frames, const RenderOptions& options,
         const std::atomic<bool>& interrupted, Environment& env);

  bool empty() const noexcept { return videos_.empty(); }
  /// Foreseeable failures, before the first frame. Throws UsageError and IoError.
  void check(const InputSet& inputs, OutputSet& outputs, bool keeps_existing) const;

  /// The film of a frame that is being rendered; empty if frames are not kept.
  std::filesystem::path checkpoint(int frame) const;
  /// Adds a frame that an earlier render has kept. Returns false if the frame has to be rendered,
  /// because it was not kept or is damaged. Throws FilmError if it is of another picture than
  /// `film`, and IoError if a video cannot be written.
  bool add_kept(int frame, const render::StoredFilm& film, Environment& env);
  /// Adds a rendered frame; keeps it if frames are kept, unless `film` is null. Throws IoError if a
  /// video cannot be written.
  void add(int frame, const render::Picture& picture, const render::ToneMapping& mapping,
           const render::StoredFilm* film, Environment& env);
  /// Kept frames are of another picture: they are left as they are.
  void leave_kept_frames() noexcept { kept_.reset(); }
  /// Puts the videos in their places if they have all frames. Reports failures, and the videos
  /// unless `is_quiet`. `are_frames_finished`: with their pictures; then they need not be kept.
  ExitCode finish(bool are_frames_finished, bool is_quiet, Environment& env);

 private:
  struct Video {
    std::string path;
    VideoFormat format;
    std::unique_ptr<VideoWriter> writer;  // from the first frame on
  };

  void encode(std::span<const std::uint8_t> codes, int width, int height);

  std::vector<Video> videos_;
  VideoFrames frames_;
  std::size_t encoded_ = 0;  // frames
  int crf_ = 0, zoom_ = 1;
  const std::atomic<bool>* interrupted_ = nullptr;
  std::optional<KeptFrames> kept_;
  bool resumes_ = false;
};

}  // namespace sdlc::cli
