#include "render/session/picture_tracer.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <span>
#include <utility>

#include "render/parallel/parallel_for.hpp"

namespace sdlc::render {
namespace {

// Some thousands of runs at a time keep all lanes busy, and their sums in the cache.
constexpr std::size_t kRunsPerBatch = 4096;

}  // namespace

PictureTracer::PictureTracer(const Tracer& tracer, const RenderSettings& settings,
                             EmitterTally& emitters, int threads, RenderMonitor& monitor)
    : tracer_(tracer),
      settings_(settings),
      emitters_(emitters),
      threads_(threads),
      monitor_(monitor) {}

void PictureTracer::pause_every(double seconds, std::function<void()> on_pause) {
  on_pause_ = std::move(on_pause);
  pause_interval_ =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  next_pause_ = Clock::now() + pause_interval_;
}

std::size_t PictureTracer::pixels_per_tile(std::size_t pixels,
                                           std::uint64_t samples) const noexcept {
  // Lanes idle while a tile's last runs end: half a run in 64 of them, with 16 lanes. Threads idle
  // during the picture's last tiles.
  constexpr std::size_t kSamplesPerTile = 1 << 16, kMaxPixels = 1024, kTilesPerThread = 16,
                        kMaxTiles = 1 << 30;
  const std::size_t min_tile = std::max<std::size_t>(1, pixels / kMaxTiles);
  const std::size_t of_threads = pixels / (static_cast<std::size_t>(threads_) * kTilesPerThread);
  const std::size_t of_samples = kSamplesPerTile / std::max<std::uint64_t>(samples, 1);
  return std::clamp(std::min(of_samples, kMaxPixels), min_tile, std::max(min_tile, of_threads));
}

void PictureTracer::for_each_tile(
    std::size_t pixels, std::size_t pixels_per_tile,
    const std::function<void(std::size_t begin, std::size_t end)>& body) const {
  parallel_ranges(pixels, pixels_per_tile, [&](std::size_t begin, std::size_t end) {
    if (monitor_.cancel.load(std::memory_order_relaxed)) return;
    if (monitor_.before_tile) monitor_.before_tile();
    body(begin, end);
  });
}

bool PictureTracer::trace(std::vector<PixelRun>& runs, TraceCounts& counts,
                          const std::atomic<bool>& cancel) {
  if (!settings_.crop) return tracer_.trace(settings_, &emitters_, runs, counts, cancel);
  // Films have the pixels of the crop, tracers those of the whole picture.
  const auto row = static_cast<std::uint64_t>(settings_.crop->width),
             whole_row = static_cast<std::uint64_t>(settings_.width),
             first = static_cast<std::uint64_t>(settings_.crop->y) * whole_row +
                     static_cast<std::uint64_t>(settings_.crop->x);
  thread_local std::vector<std::uint64_t> pixels;
  pixels.clear();
  for (const PixelRun& run : runs) pixels.push_back(run.pixel);
  for (PixelRun& run : runs) run.pixel = first + run.pixel / row * whole_row + run.pixel % row;
  const bool is_kept = tracer_.trace(settings_, &emitters_, runs, counts, cancel);
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].pixel = pixels[i];
  return is_kept;
}

bool PictureTracer::trace_tile(Film& film, std::size_t begin, std::size_t end, const Target& target,
                               const IsLate& is_late) {
  const std::size_t max_blocks = std::max<std::size_t>(1, kRunsPerBatch / (end - begin));
  static constexpr std::atomic<bool> kNever{false};
  const std::atomic<bool>& cancel = finishes_tiles_ ? kNever : monitor_.cancel;
  thread_local std::vector<PixelRun> runs;  // thread_local, so that its memory is mapped once
  OpenPixels pixels(film, begin, end, target);
  TraceCounts total;
  std::uint64_t total_samples = 0;
  bool is_whole = false, is_kept = true;
  while (true) {
    runs.clear();
    pixels.plan(static_cast<std::uint32_t>(max_blocks), runs);
    is_whole = runs.empty();
    if (is_whole || is_late()) break;
    TraceCounts counts;
    is_kept = trace(runs, counts, cancel);
    if (!is_kept) break;
    std::uint64_t samples = 0;
    for (const PixelRun& run : runs) {
      pixels.add(run);
      samples += run.samples();
    }
    total += counts;
    total_samples += samples;
    monitor_.samples_done.fetch_add(samples, std::memory_order_relaxed);
    monitor_.rays_done.fetch_add(counts.rays, std::memory_order_relaxed);
  }
  // The counts are those of the samples in the film: of all batches but a cancelled one, or of
  // none.
  const bool has_room = pixels.close();
  if (!is_kept || !has_room) has_dropped_ = true;
  if (!has_room) return false;
  samples_.fetch_add(total_samples, std::memory_order_relaxed);
  rays_.fetch_add(total.rays, std::memory_order_relaxed);
  truncated_.fetch_add(total.truncated_paths, std::memory_order_relaxed);
  nonfinite_.fetch_add(total.nonfinite_samples, std::memory_order_relaxed);
  return is_whole;
}

bool PictureTracer::trace_pass(Film& film, const Target& target, const IsLate& is_late,
                               const OnTile& on_tile) {
  // Only the size of tiles depends on what pixels lack: looking at all of a large picture would
  // take as long as some of the first passes.
  constexpr std::size_t kPixelsToLookAt = 4096;
  const std::size_t step = film.size() / kPixelsToLookAt + 1;
  std::uint64_t added = 0;
  for (std::size_t i = 0; i < film.size(); i += step) {
    const ReplicateCounts counts = target(i);
    const std::uint64_t samples = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    added = std::max(added, samples - std::min(samples, film.samples(i)));
  }
  // Use smaller tiles if the time limit may end the pass, because a tile is kept or dropped as a
  // whole.
  constexpr std::uint64_t kSmaller = 8;
  const std::size_t tile =
      pixels_per_tile(film.size(), settings_.seconds ? kSmaller * added : added);
  std::atomic<bool> is_whole{true}, is_paused{false};
  do {
    is_whole = true;
    is_paused = false;
    const std::uint64_t samples_before = samples_.load();
    for_each_tile(film.size(), tile, [&](std::size_t begin, std::size_t end) {
      const bool is_due = Clock::now() >= next_pause_ && samples_.load() > samples_before;
      if (is_paused.load() || is_due) {
        is_paused = true;
      } else if (!trace_tile(film, begin, end, target, is_late)) {
        is_whole = false;
      } else if (on_tile) {
        on_tile(film, begin, end);
      }
    });
    if (!is_paused.load()) break;
    on_pause_();
    next_pause_ = Clock::now() + pause_interval_;
  } while (!monitor_.cancel.load());
  return is_whole && !is_paused.load() && !monitor_.cancel.load();
}

void PictureTracer::trace_tiles(const FilmExtent& extent, const ReplicateCounts& target,
                                const OnTile& on_tile) {
  std::uint64_t samples = 0;
  for (const std::uint32_t count : target) samples += count;
  for_each_tile(extent.pixels, pixels_per_tile(extent.pixels, samples),
                [&](std::size_t begin, std::size_t end) {
                  FilmExtent tile = extent;
                  tile.first_pixel += begin;
                  tile.pixels = end - begin;
                  Film film(tile, channels_of(settings_));
                  film.reserve(std::span(&target, 1));
                  const bool is_whole = trace_tile(
                      film, 0, film.size(), [&](std::size_t) { return target; },
                      [] { return false; });
                  if (is_whole) on_tile(film, 0, film.size());
                });
}

}  // namespace sdlc::render
