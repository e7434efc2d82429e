#include "render/tiles/render.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include "render/film/sample_sum.hpp"
#include "render/integrator/path_integrator.hpp"
#include "render/math/color.hpp"
#include "render/sampler/sampler.hpp"

namespace sdlc::render {
namespace {

constexpr int kTileSize = 16;  // pixels a side

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// What a block of samples adds to the totals; sums of whole numbers do not depend on their order.
struct Counts {
  PathCounts paths;
  std::uint64_t samples = 0;
  std::uint64_t nonfinite = 0;
};

class TileRenderer {
 public:
  TileRenderer(const PathIntegrator& integrator, const RenderSettings& settings, Picture& picture,
               RenderMonitor& monitor)
      : integrator_(integrator), settings_(settings), picture_(picture), monitor_(monitor) {}

  int tile_count() const {
    return tiles_across() * ((settings_.height + kTileSize - 1) / kTileSize);
  }

  void render_tile(int tile) {
    const int x0 = tile % tiles_across() * kTileSize, y0 = tile / tiles_across() * kTileSize;
    const int x1 = std::min(x0 + kTileSize, settings_.width);
    const int y1 = std::min(y0 + kTileSize, settings_.height);
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const std::optional<LinearRgb> mean = mean_radiance(x, y);
        if (!mean) return;
        picture_.at(x, y) = *mean;
      }
    }
  }

  std::uint64_t truncated_paths() const { return truncated_; }
  std::uint64_t nonfinite_samples() const { return nonfinite_; }

 private:
  int tiles_across() const { return (settings_.width + kTileSize - 1) / kTileSize; }

  /// The mean of the pixel's samples, or nothing when the render was cancelled meanwhile.
  std::optional<LinearRgb> mean_radiance(int x, int y) {
    const auto pixel = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(settings_.width) +
                       static_cast<std::uint64_t>(x);
    const std::uint64_t key = PathSampler::pixel_key(settings_.seed, pixel);
    const auto samples = static_cast<std::uint64_t>(settings_.samples);
    SampleSum sum;
    while (sum.count() < samples) {
      Counts counts;
      const std::uint64_t end = std::min(samples, sum.count() + SampleSum::kBlock);
      for (std::uint64_t i = sum.count(); i < end; ++i) {
        sum.add(sample(x, y, PathSampler(key, i), counts));
      }
      if (monitor_.cancel.load(std::memory_order_relaxed)) return std::nullopt;
      report(counts);
    }
    return sum.total() / static_cast<double>(samples);
  }

  /// One sample of a pixel; black, and counted, where it is not finite.
  LinearRgb sample(int x, int y, const PathSampler& sampler, Counts& counts) const {
    // A picture of one sample a pixel looks through the middle of each.
    const bool is_centred = settings_.samples == 1;
    const double dx = is_centred ? 0.5 : sampler.uniform(kPixelX);
    const double dy = is_centred ? 0.5 : sampler.uniform(kPixelY);
    const double s = (x + dx) / settings_.width;
    const double t = (settings_.height - 1 - y + dy) / settings_.height;
    const LinearRgb radiance = integrator_.sample(s, t, sampler, counts.paths, &monitor_.cancel);
    ++counts.samples;
    if (is_finite(radiance)) return radiance;
    ++counts.nonfinite;
    return LinearRgb{};
  }

  void report(const Counts& counts) {
    monitor_.samples_done.fetch_add(counts.samples, std::memory_order_relaxed);
    monitor_.rays_done.fetch_add(counts.paths.rays, std::memory_order_relaxed);
    truncated_.fetch_add(counts.paths.truncated_paths, std::memory_order_relaxed);
    nonfinite_.fetch_add(counts.nonfinite, std::memory_order_relaxed);
  }

  const PathIntegrator& integrator_;
  const RenderSettings& settings_;
  Picture& picture_;
  RenderMonitor& monitor_;
  std::atomic<std::uint64_t> truncated_{0};
  std::atomic<std::uint64_t> nonfinite_{0};
};

int thread_count(int asked) {
  constexpr int kMost = 1024;  // more only cost memory
  const int machine = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return std::min(asked > 0 ? asked : machine, kMost);
}

}  // namespace

Kernel choose_kernel(const Scene& /*scene*/) noexcept {
  return {.precision = "double", .name = "scalar", .reason = "there is no other yet"};
}

RenderResult render(Scene scene, const RenderSettings& settings, RenderMonitor& monitor) {
  RenderResult result;
  result.kernel = choose_kernel(scene);
  const auto build_start = std::chrono::steady_clock::now();
  const PathIntegrator integrator(std::move(scene), settings.depth);
  result.build_seconds = seconds_since(build_start);
  result.bvh_bytes = integrator.bvh().memory_bytes();

  result.picture = Picture(settings.width, settings.height);
  result.threads = thread_count(settings.threads);
  TileRenderer tiles(integrator, settings, result.picture, monitor);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(result.threads));
  tbb::task_arena arena(result.threads);
  const auto for_each = [&](int count, const auto& body) {
    arena.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<int>(0, count, 1),
          [&](const tbb::blocked_range<int>& range) {
            for (int i = range.begin(); i < range.end(); ++i) body(i);
          },
          tbb::simple_partitioner{});
    });
  };
  // Threads start, and oneTBB loads its allocator, before anything else may load a library and
  // before the clock runs.
  for_each(result.threads, [](int) {});
  if (monitor.on_tracing) monitor.on_tracing();

  const auto render_start = std::chrono::steady_clock::now();
  for_each(tiles.tile_count(), [&](int tile) { tiles.render_tile(tile); });
  result.render_seconds = seconds_since(render_start);
  result.is_complete = !monitor.cancel.load();
  result.camera_samples = monitor.samples_done.load();
  result.rays = monitor.rays_done.load();
  result.truncated_paths = tiles.truncated_paths();
  result.nonfinite_samples = tiles.nonfinite_samples();
  return result;
}

}  // namespace sdlc::render
