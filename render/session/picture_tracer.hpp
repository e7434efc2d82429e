#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "render/film/film.hpp"
#include "render/image/picture.hpp"
#include "render/kernel/tracer.hpp"
#include "render/math/clock.hpp"
#include "render/session/render.hpp"
#include "render/shading/emitter_tally.hpp"

namespace sdlc::render {

/// Traces the pixels of a picture tile by tile, on all threads of its Workers. A tile is a
/// run of pixels, long enough to keep all lanes busy, and short enough to keep all threads busy.
class PictureTracer {
 public:
  /// Keeps references to all arguments.
  PictureTracer(const Tracer& tracer, const RenderSettings& settings, EmitterTally& emitters,
                int threads, RenderMonitor& monitor);

  /// From now on tiles are finished, and cancellation drops no samples.
  void finish_tiles() noexcept { finishes_tiles_ = true; }
  /// From now on passes pause every `seconds`, and call `on_pause` while nothing is traced.
  void pause_every(double seconds, std::function<void()> on_pause);

  /// The number of samples that a pixel shall have in each replicate.
  using Target = std::function<ReplicateCounts(std::size_t pixel)>;
  using IsLate = std::function<bool()>;
  /// Called when the pixels [begin, end) of a film have reached their targets, on the thread that
  /// traced them.
  using OnTile = std::function<void(const Film& film, std::size_t begin, std::size_t end)>;

  /// Brings the pixels of a film, which has room for them, to their targets. Starts no new work
  /// after `is_late` returns true. Returns false if any work is left.
  bool trace_pass(Film& film, const Target& target, const IsLate& is_late,
                  const OnTile& on_tile = {});

  /// Brings all pixels of the extent to the same target in films of one tile each, which are
  /// dropped after `on_tile`: a whole film takes more memory than the picture.
  void trace_tiles(const FilmExtent& extent, const ReplicateCounts& target, const OnTile& on_tile);

  /// Samples in films.
  std::uint64_t samples() const noexcept { return samples_; }
  /// Of these samples.
  TraceCounts counts() const noexcept {
    return {.rays = rays_, .truncated_paths = truncated_, .nonfinite_samples = nonfinite_};
  }
  /// Whether emitters were counted for samples that are in no film.
  bool has_dropped() const noexcept { return has_dropped_; }

 private:
  bool trace(std::vector<PixelRun>& runs, TraceCounts& counts, const std::atomic<bool>& cancel);
  bool trace_tile(Film& film, std::size_t begin, std::size_t end, const Target& target,
                  const IsLate& is_late);
  void for_each_tile(std::size_t pixels, std::size_t pixels_per_tile,
                     const std::function<void(std::size_t begin, std::size_t end)>& body) const;
  std::size_t pixels_per_tile(std::size_t pixels, std::uint64_t samples) const noexcept;

  const Tracer& tracer_;
  const RenderSettings& settings_;
  EmitterTally& emitters_;
  int threads_;
  RenderMonitor& monitor_;
  bool finishes_tiles_ = false;
  std::function<void()> on_pause_;
  Clock::duration pause_interval_{};
  Clock::time_point next_pause_ = Clock::time_point::max();
  std::atomic<std::uint64_t> samples_{0};
  std::atomic<std::uint64_t> rays_{0};
  std::atomic<std::uint64_t> truncated_{0};
  std::atomic<std::uint64_t> nonfinite_{0};
  std::atomic<bool> has_dropped_{false};
};

}  // namespace sdlc::render
