#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "cli/environment.hpp"
#include "cli/exit_code.hpp"
#include "cli/film_job.hpp"
#include "cli/outputs.hpp"
#include "cli/picture_outputs.hpp"
#include "cli/render_options.hpp"
#include "cli/statistics.hpp"
#include "render/scene/scene.hpp"
#include "render/session/render.hpp"

/// Writes the pictures of rendered frames.
namespace sdlc::cli {

struct RenderedFrame {
  std::size_t index = 0;
  std::vector<Output> outputs = {};
  PictureForm form = {};
  render::RenderSettings settings = {};
  render::RenderResult result = {};
  RenderStatistics statistics = {};
  bool is_written = false;  ///< complete, with all its files
};

/// Writes the pictures of the frame, then its films if `film` is not null; reports failures, and
/// prints the final line. Returns the status of the frame.
ExitCode write_frame(const RenderOptions& options, RenderedFrame& frame, FilmJob* film,
                     Environment& env);

/// Frames whose pictures are written while the next ones are rendered.
class PendingFrames {
 public:
  /// So many, because waiting for the disk takes longer than the rest of a small frame.
  static constexpr std::size_t kMax = 8;

  /// Keeps references to both.
  PendingFrames(const RenderOptions& options, Environment& env);
  /// Waits for all.
  ~PendingFrames();
  PendingFrames(const PendingFrames&) = delete;
  PendingFrames& operator=(const PendingFrames&) = delete;

  /// Whether kMax such frames fit into memory, and their files may be written in any order.
  static bool may_wait(const RenderedFrame& frame);
  void add(RenderedFrame frame);
  std::size_t size() const noexcept { return frames_.size(); }
  /// Waits for the first one, prints its messages, and returns it with its status. Precondition:
  /// there is one.
  std::pair<RenderedFrame, ExitCode> take();

 private:
  struct Pending;

  const RenderOptions& options_;
  Environment& env_;
  std::deque<std::unique_ptr<Pending>> frames_;
};

}  // namespace sdlc::cli
