#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
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

/// Frames that other threads render and write, while the next ones are compiled.
class PendingFrames {
 public:
  /// Renders a frame into RenderedFrame::result.
  using Render = std::function<void(RenderedFrame&, render::RenderMonitor&)>;

  /// Keeps references to both.
  PendingFrames(const RenderOptions& options, Environment& env);
  /// Waits for all.
  ~PendingFrames();
  PendingFrames(const PendingFrames&) = delete;
  PendingFrames& operator=(const PendingFrames&) = delete;

  /// As many as keep `threads` busy: waiting for the disk takes longer than the rest of a small
  /// frame.
  static std::size_t max(int threads) noexcept { return 6 + static_cast<std::size_t>(threads); }
  /// Whether a rendered frame is complete, small, and not for standard output: then it may be
  /// written later.
  static bool may_wait(const RenderedFrame& frame);
  /// Whether such frames are small: they are rendered faster in parallel, one thread each, than one
  /// after the other.
  static bool may_render(const render::RenderSettings& settings, const render::Scene& scene,
                         const std::vector<Output>& outputs, int zoom);
  void add(RenderedFrame frame);
  /// At most `threads` frames are rendered at a time.
  void add(RenderedFrame frame, Render render, int threads);
  std::size_t size() const noexcept { return frames_.size(); }
  /// RenderedFrame::index of the first one. Precondition: there is one.
  std::size_t first() const;
  /// Whether the first one is done; waits for it at most this long.
  bool wait(std::chrono::milliseconds time) const;
  /// Ends the rendering. Frames that are not complete then have the status Interrupted.
  void cancel();
  /// Waits for the first one, prints its messages, and returns it with its status. Precondition:
  /// there is one.
  std::pair<RenderedFrame, ExitCode> take();

 private:
  struct Pending;

  void render(Pending& pending, int threads);

  const RenderOptions& options_;
  Environment& env_;
  std::mutex mutex_;
  std::condition_variable wake_;
  int rendering_ = 0;
  std::atomic<bool> is_canceled_ = false;
  std::deque<std::unique_ptr<Pending>> frames_;  // last: their threads use the others
};

}  // namespace sdlc::cli
