#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "render/accuracy/error_estimate.hpp"
#include "render/film/film.hpp"
#include "render/image/picture.hpp"
#include "render/light/emitter_tally.hpp"
#include "render/scene/scene.hpp"
#include "render/tiles/kernel.hpp"

namespace sdlc::render {

/// What another thread sees of a render, and how it ends it early.
struct RenderMonitor {
  std::atomic<bool> cancel{false};  ///< set it: the render returns within milliseconds
  std::atomic<std::uint64_t> samples_done{0};
  std::atomic<std::uint64_t> rays_done{0};
  /// Of a render with a goal, how near that is, from 0 to 1, by the last pass.
  std::atomic<double> goal_share{0};
  /// Called once, when everything is built and the first path is about to be traced.
  std::function<void()> on_tracing;
};

/// A picture and how it came about.
struct RenderResult {
  Picture picture;           ///< mean radiance; pixels that were not reached are black
  bool is_complete = false;  ///< false after a cancelled render
  Kernel kernel;             ///< without its near pairs
  int threads = 0;           ///< that were asked for, after 0 became all of the machine
  std::uint64_t camera_samples = 0;
  std::uint64_t rays = 0;
  std::uint64_t truncated_paths = 0;
  std::uint64_t nonfinite_samples = 0;  ///< left out of their pixel's sum; a defect if not 0
  std::uint64_t least_samples = 0;      ///< of any pixel
  std::uint64_t most_samples = 0;
  bool has_reached_error = false;  ///< RenderSettings::error
  /// From 8 samples per pixel on, of a whole picture; nothing where kinds of path that were found
  /// too rarely may add more than half of the interval's upper end (unseen_error()).
  std::optional<ErrorEstimate> error{};
  Picture variance;                  ///< of each pixel's mean, if it was asked for and is known
  std::vector<PixelSpread> spreads;  ///< the same, channels together, of each pixel
  std::vector<std::uint32_t> samples_of_pixels;  ///< empty: all have as many
  std::uint32_t sampled_lights = 0;  ///< emitters that diffuse surfaces look for by themselves
  /// Those that fewer than EmitterTally::kEnough paths reached: what they light may be missing.
  std::vector<ReachedEmitter> scarce_emitters;
  /// Kinds of path that were found too rarely for the error to be known; empty where it is.
  std::vector<RarePath> rare_paths;
  std::size_t bvh_bytes = 0;  ///< 0 without a hierarchy
  double build_seconds = 0;   ///< rebasing and hierarchy, and choosing the kernel
  double render_seconds = 0;  ///< tracing alone
};

/// Renders the scene, tile by tile on all threads, with the kernel of choose_kernel(). With a goal
/// it does so in passes, each over the whole picture, until one of the goals, or the most samples,
/// is reached; a pass that time ends may leave some pixels with fewer samples than others. Without
/// a goal for time the same scene, settings and seed give the same bytes, whatever the number of
/// threads and the order of the tiles, and a goal for the error that was reached with N samples a
/// pixel those of N samples; with the wide kernel also for any instruction set that fuses
/// multiplications with additions, which is all but SSE4.
RenderResult render(Scene scene, const RenderSettings& settings, RenderMonitor& monitor,
                    const KernelRequest& request = {});

/// The same with a kernel that choose_kernel() chose for it, which is not refused; the time that
/// took is not among the seconds.
RenderResult render(Kernel kernel, Scene scene, const RenderSettings& settings,
                    RenderMonitor& monitor);

}  // namespace sdlc::render
