#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "render/film/film.hpp"
#include "render/film/film_file.hpp"
#include "render/film/trace_counts.hpp"
#include "render/image/picture.hpp"
#include "render/kernel/kernel.hpp"
#include "render/math/clock.hpp"
#include "render/scene/scene.hpp"
#include "render/session/error_estimate.hpp"
#include "render/session/prepared_scene.hpp"
#include "render/shading/emitter_tally.hpp"

namespace sdlc::render {

/// What is known of the error of a picture between two passes.
struct ErrorSoFar {
  // As in RenderResult
  std::optional<ErrorEstimate> error = {};
  std::vector<RarePath> rare_paths = {};
  std::vector<ReachedEmitter> scarce_emitters = {};
};

/// Progress of a render for other threads, and a means to cancel it.
struct RenderMonitor {
  /// Set to end the render within milliseconds, or after the present tiles if it has a film.
  std::atomic<bool> cancel{false};
  std::atomic<std::uint64_t> samples_done{0};
  std::atomic<std::uint64_t> rays_done{0};
  /// For a render with a goal: the progress towards it after the last pass, from 0 to 1.
  std::atomic<double> goal_share{0};
  /// Called once, after everything is built and before the first path is traced.
  std::function<void()> on_tracing;
  /// Called by each thread before each tile, unless it is cancelled; it may wait.
  std::function<void()> before_tile;
  /// Called after each pass with the samples so far, and with a function that estimates the error
  /// of the picture so far, which is not denoised.
  std::function<void(const Film& film, const std::function<ErrorSoFar()>& error)> on_pass;
  /// Whether passes begin with few samples, to be shown. They do not change the picture. A picture
  /// of fewer than kMinReplicatedSamples samples has one pass.
  bool shows_passes = false;
  /// Whether a cancelled render has the picture of its samples so far, which takes some time.
  bool keeps_cancelled = true;
  /// The render is cancelled, and its picture is not wanted.
  bool is_dropped() const noexcept { return !keeps_cancelled && cancel.load(); }
  /// With a time limit, called once, after an early pass, with the picture so far: the seconds that
  /// the caller needs after the render. The limit includes them.
  std::function<double(const Picture& picture)> seconds_to_finish;
  /// With a film: called every `checkpoint_seconds` of a render, between tiles. A render that goes
  /// on from the film gives the same bytes as this one.
  double checkpoint_seconds = 60;
  std::function<void(const StoredFilm& film)> on_checkpoint;
};

/// A picture with statistics about its render.
struct RenderResult {
  Picture picture;           ///< mean radiance; pixels without samples are black
  bool is_complete = false;  ///< false after a cancelled render
  Kernel kernel;             ///< without its near pairs
  int threads = 0;           ///< the requested number, with 0 replaced by all hardware threads
  std::uint64_t camera_samples = 0;  ///< of the picture
  std::uint64_t new_samples = 0;     ///< those of them that this render has traced
  std::uint64_t rays = 0;
  std::uint64_t truncated_paths = 0;
  std::uint64_t nonfinite_samples = 0;  ///< excluded from their pixel's sum; not 0 indicates a
                                        ///< defect
  std::uint64_t min_samples = 0;        ///< of any pixel
  std::uint64_t max_samples = 0;
  bool has_reached_error = false;  ///< RenderSettings::error
  /// For a complete picture with at least 8 samples per pixel; nullopt if rare kinds of path may
  /// add more than half of the interval's upper end (unseen_error()), and for a black picture of
  /// which paths were cut off.
  std::optional<ErrorEstimate> error{};
  /// The error of the picture before it was denoised; nullopt if it was not.
  std::optional<ErrorEstimate> plain_error{};
  Picture variance;                  ///< variance of each pixel's mean, if requested and known
  std::vector<PixelSpread> spreads;  ///< the same per pixel, channels combined
  /// By pixel, if requested; that of a pixel without samples is PixelFeatures{}.
  std::vector<PixelFeatures> features;
  std::vector<std::uint32_t> samples_of_pixels;  ///< empty if all pixels have the same number
  std::uint32_t sampled_lights = 0;              ///< emitters that surfaces sample directly
  /// Emitters that fewer than EmitterTally::kEnough paths reached: their light may be missing.
  std::vector<ReachedEmitter> scarce_emitters;
  /// Kinds of path that were found too rarely for the error to be known; empty if it is known.
  std::vector<RarePath> rare_paths;
  std::size_t bvh_bytes = 0;   ///< 0 without a BVH
  double build_seconds = 0;    ///< PreparedScene::build_seconds()
  double render_seconds = 0;   ///< tracing and denoising
  double denoise_seconds = 0;  ///< the part of them for denoising
};

void put_counts(const TraceCounts& counts, RenderResult& result) noexcept;

/// Drops the error of a complete picture if rare kinds of path, or paths that were cut off, may
/// hide more. Sets what is known of emitters.
void check_error(const EmitterTally& emitters, RenderResult& result);

/// Renders the scene tile by tile on all threads. With a goal it runs passes over the whole picture
/// until a goal or the max number of samples is reached; the time limit may leave some pixels with
/// fewer samples than others.
///
/// Without a time limit, the same scene, settings and seed give the same bytes for any number of
/// threads and any order of tiles. An error goal that was reached with N samples per pixel gives
/// the same bytes as N samples. With a wide kernel this also holds across all instruction sets with
/// fused multiply-add (Backend::is_fused).
///
/// The samples are added to `film`, from new_film() or read_film_file(), unless it is null. If it
/// has samples of the whole picture, the render goes on from there. Precondition: it is of the same
/// scene and program, see difference(). Throws std::invalid_argument if it is of other settings or
/// of another kernel. RenderSettings::seconds counts from `start`.
RenderResult render(const PreparedScene& scene, const RenderSettings& settings,
                    RenderMonitor& monitor, StoredFilm* film = nullptr,
                    Clock::time_point start = Clock::now());

/// Prepares the scene for `kernel`, which is from choose_kernel() and not refused, and renders it.
/// The time limit includes building.
RenderResult render(Kernel kernel, Scene scene, const RenderSettings& settings,
                    RenderMonitor& monitor);
/// The same with the kernel that is chosen now.
RenderResult render(Scene scene, const RenderSettings& settings, RenderMonitor& monitor,
                    const KernelRequest& request = {});

/// The extent of a film of the whole picture.
FilmExtent extent_of(const RenderSettings& settings) noexcept;
/// The channels of a film with these settings.
Channels channels_of(const RenderSettings& settings) noexcept;

}  // namespace sdlc::render
