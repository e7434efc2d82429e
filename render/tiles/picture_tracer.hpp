#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "render/film/film.hpp"
#include "render/image/picture.hpp"
#include "render/tiles/render.hpp"
#include "render/tiles/tracer.hpp"

namespace sdlc::render {

/// Traces the pixels of a picture tile by tile, on all threads of the current arena. A tile is a
/// run of pixels, long enough to keep all lanes busy, and short enough to keep all threads busy.
class PictureTracer {
 public:
  /// Keeps references to all arguments.
  PictureTracer(const Tracer& tracer, const RenderSettings& settings, int threads,
                RenderMonitor& monitor);

  /// Traces all samples of each pixel before the next one. Fills the picture, `spreads`, and the
  /// variances of the result.
  void trace_at_once(RenderResult& result, std::vector<PixelSpread>& spreads);

  /// Brings the pixels of a film of the whole picture to `target(pixel)` samples each;
  /// `max_samples` is the largest target. Starts no new work after `is_late` returns true. Returns
  /// false if any work is left.
  bool trace_pass(Film& film, std::uint64_t max_samples,
                  const std::function<std::uint64_t(std::size_t pixel)>& target,
                  const std::function<bool()>& is_late);

  std::uint64_t truncated_paths() const noexcept { return truncated_; }
  std::uint64_t nonfinite_samples() const noexcept { return nonfinite_; }

 private:
  /// Traces the pixels [begin, end) of a film. False if cancelled or late.
  template <typename TargetOf, typename IsLate>
  bool trace_pixels(Film& film, std::size_t begin, std::size_t end, const TargetOf& target,
                    const IsLate& is_late);
  void for_each_tile(std::size_t pixels_per_tile,
                     const std::function<void(std::size_t begin, std::size_t end)>& body) const;
  std::size_t pixels_per_tile(std::uint64_t samples) const noexcept;

  const Tracer& tracer_;
  const RenderSettings& settings_;
  std::size_t pixels_;
  int threads_;
  RenderMonitor& monitor_;
  std::atomic<std::uint64_t> truncated_{0};
  std::atomic<std::uint64_t> nonfinite_{0};
};

}  // namespace sdlc::render
