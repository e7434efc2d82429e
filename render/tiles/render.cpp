#include "render/tiles/render.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include "render/film/sample_sum.hpp"
#include "render/integrator/path_integrator.hpp"
#include "render/light/emitter_tally.hpp"
#include "render/math/color.hpp"
#include "render/sampler/sampler.hpp"
#include "render/tiles/threads.hpp"
#include "render/wide/wide_integrator.hpp"

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

/// A picture in parts that are rendered independently of each other, on any thread.
class Tiles {
 public:
  virtual ~Tiles() = default;

  virtual int count() const = 0;
  virtual void render(int tile) = 0;
  virtual std::size_t bvh_bytes() const { return 0; }

  std::uint64_t truncated_paths() const { return truncated_; }
  std::uint64_t nonfinite_samples() const { return nonfinite_; }

 protected:
  void report(RenderMonitor& monitor, const Counts& counts) {
    monitor.samples_done.fetch_add(counts.samples, std::memory_order_relaxed);
    monitor.rays_done.fetch_add(counts.paths.rays, std::memory_order_relaxed);
    truncated_.fetch_add(counts.paths.truncated_paths, std::memory_order_relaxed);
    nonfinite_.fetch_add(counts.nonfinite, std::memory_order_relaxed);
  }

 private:
  std::atomic<std::uint64_t> truncated_{0};
  std::atomic<std::uint64_t> nonfinite_{0};
};

/// Square tiles, one path after the other.
class ScalarTiles final : public Tiles {
 public:
  ScalarTiles(Scene scene, const RenderSettings& settings, const Kernel& kernel,
              EmitterTally& emitters, Picture& picture, RenderMonitor& monitor)
      : integrator_(std::move(scene), settings.depth, kernel.bounds.near_pairs, kernel.lights,
                    &emitters),
        settings_(settings),
        picture_(picture),
        monitor_(monitor) {}

  int count() const override {
    return tiles_across() * ((settings_.height + kTileSize - 1) / kTileSize);
  }

  void render(int tile) override {
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

  std::size_t bvh_bytes() const override { return integrator_.bvh().memory_bytes(); }

 private:
  int tiles_across() const { return (settings_.width + kTileSize - 1) / kTileSize; }

  /// The mean of the pixel's samples, or nothing when the render was cancelled meanwhile.
  std::optional<LinearRgb> mean_radiance(int x, int y) {
    const auto pixel = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(settings_.width) +
                       static_cast<std::uint64_t>(x);
    const std::uint64_t key = PathSampler::stream_key(settings_.seed, pixel, 0);
    const auto samples = static_cast<std::uint64_t>(settings_.samples);
    SampleSum sum;
    while (sum.count() < samples) {
      Counts counts;
      const std::uint64_t end = std::min(samples, sum.count() + SampleSum::kBlock);
      for (std::uint64_t i = sum.count(); i < end; ++i) {
        sum.add(sample(x, y, PathSampler(settings_.sampler, key, static_cast<std::uint32_t>(i)),
                       counts));
      }
      if (monitor_.cancel.load(std::memory_order_relaxed)) return std::nullopt;
      report(monitor_, counts);
    }
    return sum.total() / static_cast<double>(samples);
  }

  /// One sample of a pixel; black, and counted, where it is not finite.
  LinearRgb sample(int x, int y, const PathSampler& sampler, Counts& counts) const {
    // A picture of one sample a pixel looks through the middle of each.
    const bool is_centred = settings_.samples == 1;
    const auto [dx, dy] = is_centred ? UniformPair{0.5, 0.5} : sampler.pair(kPixel);
    const double s = (x + dx) / settings_.width;
    const double t = (settings_.height - 1 - y + dy) / settings_.height;
    const LinearRgb radiance = integrator_.sample(s, t, sampler, counts.paths, &monitor_.cancel);
    ++counts.samples;
    if (is_finite(radiance)) return radiance;
    ++counts.nonfinite;
    return LinearRgb{};
  }

  const PathIntegrator integrator_;
  const RenderSettings& settings_;
  Picture& picture_;
  RenderMonitor& monitor_;
};

/// Runs of pixels, long enough to keep all lanes busy, and short enough to keep all threads so.
class WideTiles final : public Tiles {
 public:
  WideTiles(Scene scene, const RenderSettings& settings, const Kernel& kernel,
            EmitterTally& emitters, int threads, Picture& picture, RenderMonitor& monitor)
      : integrator_(std::move(scene), settings, options(kernel, emitters)),
        picture_(picture),
        monitor_(monitor),
        pixels_a_tile_(pixels_a_tile(settings, picture.pixels.size(), threads)) {}

  int count() const override {
    return static_cast<int>((picture_.pixels.size() + pixels_a_tile_ - 1) / pixels_a_tile_);
  }

  void render(int tile) override {
    if (monitor_.cancel.load(std::memory_order_relaxed)) return;
    const std::size_t first = static_cast<std::size_t>(tile) * pixels_a_tile_;
    std::vector<LinearRgb> means(std::min(pixels_a_tile_, picture_.pixels.size() - first));
    const auto tell = [&](std::uint64_t samples, const WideCounts& counts) {
      report(monitor_, {.paths = {.rays = counts.rays, .truncated_paths = counts.truncated_paths},
                        .samples = samples,
                        .nonfinite = counts.nonfinite_samples});
    };
    if (!integrator_.render(first, means, monitor_.cancel, tell)) return;
    std::copy(means.begin(), means.end(),
              picture_.pixels.begin() + static_cast<std::ptrdiff_t>(first));
  }

  std::size_t bvh_bytes() const override { return integrator_.memory_bytes(); }

 private:
  static WideIntegrator::Options options(const Kernel& kernel, EmitterTally& emitters) {
    return {.precision = kernel.precision,
            .isa = *kernel.isa,
            .search = kernel.kind == KernelKind::Bvh ? Search::Bvh : Search::All,
            .exact_spheres = kernel.exact_spheres,
            .near_pairs = kernel.bounds.near_pairs,
            .lights = kernel.lights,
            .emitters = &emitters};
  }

  static std::size_t pixels_a_tile(const RenderSettings& settings, std::size_t pixels,
                                   int threads) {
    // Lanes idle while a tile's last blocks of samples end: half a block in 64 of them, with 16
    // lanes. Threads idle while the picture's last tiles do.
    constexpr std::size_t kBlocksATile = 1024, kTilesAThread = 16, kMostTiles = 1 << 30;
    const auto blocks =
        (static_cast<std::size_t>(settings.samples) + SampleSum::kBlock - 1) / SampleSum::kBlock;
    const std::size_t of_threads = pixels / (static_cast<std::size_t>(threads) * kTilesAThread);
    const std::size_t most = std::max({std::size_t{1}, of_threads, pixels / kMostTiles});
    return std::clamp<std::size_t>(kBlocksATile / blocks,
                                   std::max<std::size_t>(1, pixels / kMostTiles), most);
  }

  const WideIntegrator integrator_;
  Picture& picture_;
  RenderMonitor& monitor_;
  std::size_t pixels_a_tile_;
};

std::unique_ptr<Tiles> make_tiles(Scene scene, const RenderSettings& settings, const Kernel& kernel,
                                  EmitterTally& emitters, int threads, Picture& picture,
                                  RenderMonitor& monitor) {
  if (kernel.kind == KernelKind::Scalar) {
    return std::make_unique<ScalarTiles>(std::move(scene), settings, kernel, emitters, picture,
                                         monitor);
  }
  return std::make_unique<WideTiles>(std::move(scene), settings, kernel, emitters, threads, picture,
                                     monitor);
}

}  // namespace

RenderResult render(Scene scene, const RenderSettings& settings, RenderMonitor& monitor,
                    const KernelRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  Kernel kernel = choose_kernel(scene, settings, request);
  const double choice_seconds = seconds_since(start);
  RenderResult result = render(std::move(kernel), std::move(scene), settings, monitor);
  result.build_seconds += choice_seconds;
  return result;
}

RenderResult render(Kernel kernel, Scene scene, const RenderSettings& settings,
                    RenderMonitor& monitor) {
  RenderResult result;
  result.picture = Picture(settings.width, settings.height);
  result.threads = thread_count(settings.threads);
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
  // before the clocks run.
  for_each(result.threads, [](int) {});
  const auto build_start = std::chrono::steady_clock::now();
  result.kernel = std::move(kernel);
  EmitterTally emitters(scene);
  const std::unique_ptr<Tiles> tiles = arena.execute([&] {
    return make_tiles(std::move(scene), settings, result.kernel, emitters, result.threads,
                      result.picture, monitor);
  });
  result.kernel.bounds.near_pairs.reset();  // of a lattice that touches, more than its spheres
  result.build_seconds = seconds_since(build_start);
  result.bvh_bytes = tiles->bvh_bytes();
  if (monitor.on_tracing) monitor.on_tracing();

  const auto render_start = std::chrono::steady_clock::now();
  for_each(tiles->count(), [&](int tile) { tiles->render(tile); });
  result.render_seconds = seconds_since(render_start);
  result.is_complete = !monitor.cancel.load();
  result.camera_samples = monitor.samples_done.load();
  result.rays = monitor.rays_done.load();
  result.truncated_paths = tiles->truncated_paths();
  result.nonfinite_samples = tiles->nonfinite_samples();
  result.scarce_emitters = emitters.scarce();
  result.sampled_lights = static_cast<std::uint32_t>(result.kernel.lights.size());
  return result;
}

}  // namespace sdlc::render
