#include "render/tiles/tracer.hpp"

#include <utility>

#include "render/sampler/sampler.hpp"
#include "render/wide/wide_integrator.hpp"

namespace sdlc::render {
namespace {

/// Traces one path after the other.
class ScalarTracer final : public Tracer {
 public:
  ScalarTracer(const Kernel& kernel, Scene scene, const RenderSettings& settings,
               EmitterTally& emitters)
      : integrator_(std::move(scene), settings.depth, kernel.bounds.near_pairs, kernel.lights,
                    &emitters),
        settings_(settings) {}

  bool trace(std::span<PixelRun> runs, TraceCounts& counts,
             const std::atomic<bool>& cancel) const override {
    for (PixelRun& run : runs) {
      for (std::uint32_t replicate = 0; replicate < kReplicates; ++replicate) {
        trace_part(run.pixel, replicate, run.parts[replicate], counts, cancel);
        if (cancel.load(std::memory_order_relaxed)) return false;
      }
    }
    return true;
  }

  std::size_t memory_bytes() const noexcept override { return integrator_.bvh().memory_bytes(); }

 private:
  void trace_part(std::uint64_t pixel, std::uint32_t replicate, PixelRun::Part& part,
                  TraceCounts& counts, const std::atomic<bool>& cancel) const {
    const std::uint64_t key = PathSampler::stream_key(settings_.seed, pixel, replicate);
    for (std::uint32_t i = 0; i < part.count; ++i) {
      const PathSampler sampler(settings_.sampler, key, part.first + i);
      const LinearRgb radiance = sample(pixel, sampler, counts.paths, cancel);
      if (is_finite(radiance)) {
        part.sum += radiance;
      } else {
        ++counts.nonfinite_samples;
      }
    }
  }

  LinearRgb sample(std::uint64_t pixel, const PathSampler& sampler, PathCounts& counts,
                   const std::atomic<bool>& cancel) const {
    const auto width = static_cast<std::uint64_t>(settings_.width);
    const auto x = static_cast<double>(pixel % width);
    const auto row = static_cast<double>(settings_.height) - 1 - static_cast<double>(pixel / width);
    const auto [dx, dy] = settings_.is_centred() ? UniformPair{0.5, 0.5} : sampler.pair(kPixel);
    return integrator_.sample((x + dx) / settings_.width, (row + dy) / settings_.height, sampler,
                              counts, &cancel);
  }

  const PathIntegrator integrator_;
  const RenderSettings settings_;
};

/// Traces one path per vector lane.
class WideTracer final : public Tracer {
 public:
  WideTracer(const Kernel& kernel, Scene scene, const RenderSettings& settings,
             EmitterTally& emitters)
      : integrator_(std::move(scene), settings,
                    {.precision = kernel.precision,
                     .isa = *kernel.isa,
                     .search = kernel.kind == KernelKind::Bvh ? Search::Bvh : Search::All,
                     .exact_spheres = kernel.exact_spheres,
                     .near_pairs = kernel.bounds.near_pairs,
                     .lights = kernel.lights,
                     .emitters = &emitters}) {}

  bool trace(std::span<PixelRun> runs, TraceCounts& counts,
             const std::atomic<bool>& cancel) const override {
    WideCounts wide;
    if (!integrator_.trace(runs, wide, cancel)) return false;
    counts.paths += {.rays = wide.rays, .truncated_paths = wide.truncated_paths};
    counts.nonfinite_samples += wide.nonfinite_samples;
    return true;
  }

  std::size_t memory_bytes() const noexcept override { return integrator_.memory_bytes(); }

 private:
  const WideIntegrator integrator_;
};

}  // namespace

std::unique_ptr<const Tracer> make_tracer(const Kernel& kernel, Scene scene,
                                          const RenderSettings& settings, EmitterTally& emitters) {
  if (kernel.kind == KernelKind::Scalar) {
    return std::make_unique<const ScalarTracer>(kernel, std::move(scene), settings, emitters);
  }
  return std::make_unique<const WideTracer>(kernel, std::move(scene), settings, emitters);
}

}  // namespace sdlc::render
