#include "render/tiles/picture_tracer.hpp"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

namespace sdlc::render {
namespace {

// Some thousands of runs at a time keep all lanes busy, and their sums in the cache.
constexpr std::size_t kRunsPerBatch = 4096;

Film::Target target_in_replicates(std::uint64_t samples) {
  Film::Target target;
  for (std::uint32_t i = 0; i < kReplicates; ++i) target[i] = samples_in_replicate(samples, i);
  return target;
}

/// The target for `samples` samples per pixel; a small number is a single replicate.
Film::Target whole_target(std::uint64_t samples) {
  if (samples < kMinReplicatedSamples) return {static_cast<std::uint32_t>(samples)};
  return target_in_replicates(samples);
}

}  // namespace

PictureTracer::PictureTracer(const Tracer& tracer, const RenderSettings& settings, int threads,
                             RenderMonitor& monitor)
    : tracer_(tracer),
      settings_(settings),
      pixels_(static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height)),
      threads_(threads),
      monitor_(monitor) {}

std::size_t PictureTracer::pixels_per_tile(std::uint64_t samples) const noexcept {
  // Lanes idle while a tile's last runs end: half a run in 64 of them, with 16 lanes. Threads idle
  // during the picture's last tiles.
  constexpr std::size_t kSamplesPerTile = 1 << 16, kMaxPixels = 1024, kTilesPerThread = 16,
                        kMaxTiles = 1 << 30;
  const std::size_t min_tile = std::max<std::size_t>(1, pixels_ / kMaxTiles);
  const std::size_t of_threads = pixels_ / (static_cast<std::size_t>(threads_) * kTilesPerThread);
  const std::size_t of_samples = kSamplesPerTile / std::max<std::uint64_t>(samples, 1);
  return std::clamp(std::min(of_samples, kMaxPixels), min_tile, std::max(min_tile, of_threads));
}

void PictureTracer::for_each_tile(
    std::size_t pixels_per_tile,
    const std::function<void(std::size_t begin, std::size_t end)>& body) const {
  const std::size_t tiles = (pixels_ + pixels_per_tile - 1) / pixels_per_tile;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, tiles, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t tile = range.begin(); tile < range.end(); ++tile) {
          if (monitor_.cancel.load(std::memory_order_relaxed)) return;
          const std::size_t begin = tile * pixels_per_tile;
          body(begin, std::min(pixels_, begin + pixels_per_tile));
        }
      },
      tbb::simple_partitioner{});
}

template <typename TargetOf, typename IsLate>
bool PictureTracer::trace_pixels(Film& film, std::size_t begin, std::size_t end,
                                 const TargetOf& target, const IsLate& is_late) {
  const std::size_t max_blocks =
      std::max<std::size_t>(1, kRunsPerBatch / (kReplicates * (end - begin)));
  thread_local std::vector<SampleRun> runs;  // thread_local, so that its memory is mapped once
  while (true) {
    runs.clear();
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      film.plan(pixel, target(pixel), static_cast<std::uint32_t>(max_blocks), runs);
    }
    if (runs.empty()) return true;
    if (is_late()) return false;
    TraceCounts counts;
    if (!tracer_.trace(runs, counts, monitor_.cancel)) return false;
    std::uint64_t samples = 0;
    for (const SampleRun& run : runs) {
      film.add(run);
      samples += run.count;
    }
    monitor_.samples_done.fetch_add(samples, std::memory_order_relaxed);
    monitor_.rays_done.fetch_add(counts.paths.rays, std::memory_order_relaxed);
    truncated_.fetch_add(counts.paths.truncated_paths, std::memory_order_relaxed);
    nonfinite_.fetch_add(counts.nonfinite_samples, std::memory_order_relaxed);
  }
}

void PictureTracer::trace_at_once(RenderResult& result, std::vector<PixelSpread>& spreads) {
  const auto samples = static_cast<std::uint64_t>(settings_.samples);
  const Film::Target target = whole_target(samples);
  for_each_tile(pixels_per_tile(samples), [&](std::size_t begin, std::size_t end) {
    Film film(begin, end - begin);
    film.reserve(target[0]);
    const auto target_of = [&](std::size_t) { return target; };
    if (!trace_pixels(film, 0, end - begin, target_of, [] { return false; })) return;
    for (std::size_t i = begin; i < end; ++i) {
      result.picture.pixels[i] = film.mean(i - begin);
      if (!spreads.empty()) spreads[i] = film.spread(i - begin);
      if (!result.variance.pixels.empty()) result.variance.pixels[i] = film.variance(i - begin);
    }
  });
}

bool PictureTracer::trace_pass(Film& film, std::uint64_t max_samples,
                               const std::function<std::uint64_t(std::size_t pixel)>& target,
                               const std::function<bool()>& is_late) {
  film.reserve(target_in_replicates(max_samples)[0]);
  std::atomic<bool> is_whole{true};
  const std::uint64_t added = max_samples - std::min(max_samples, film.samples(0));
  // Use smaller tiles if the time limit may end the pass, because started tiles are finished.
  constexpr std::uint64_t kSmaller = 8;
  const std::size_t tile = pixels_per_tile(settings_.seconds ? kSmaller * added : added);
  for_each_tile(tile, [&](std::size_t begin, std::size_t end) {
    const auto target_of = [&](std::size_t pixel) { return target_in_replicates(target(pixel)); };
    if (!trace_pixels(film, begin, end, target_of, is_late)) is_whole = false;
  });
  return is_whole && !monitor_.cancel.load();
}

}  // namespace sdlc::render
