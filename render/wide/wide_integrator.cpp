#include "render/wide/wide_integrator.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "render/camera/pinhole.hpp"
#include "render/sampler/sampler.hpp"
#include "render/scene/rebase.hpp"
#include "render/scene/touching.hpp"
#include "render/wide/path_kernel.hpp"
#include "render/wide/wide_scene.hpp"

namespace sdlc::render {
namespace {

template <typename T>
std::array<T, 3> rounded(Vec3 v) {
  return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}

}  // namespace

class WideIntegrator::Tracer {
 public:
  virtual ~Tracer() = default;
  virtual bool trace(std::span<SampleRun> runs, WideCounts& counts,
                     const std::atomic<bool>& cancel) const = 0;
  virtual std::size_t memory_bytes() const noexcept = 0;
};

/// The tracer for numbers of type T.
template <typename T>
class WideIntegrator::TracerIn final : public Tracer {
 public:
  TracerIn(const Scene& rebased, const Pinhole& pinhole, const RenderSettings& settings,
           const Options& options)
      : scene_(rebased, settings.depth, options.search, options.exact_spheres, options.lights),
        kernel_(wide_kernel<T>(options.isa, {.motion = scene_.has_motion,
                                             .exact_spheres = scene_.exact_spheres > 0,
                                             .bvh = options.search == Search::Bvh,
                                             .instances = !scene_.instances.empty(),
                                             .lights = scene_.lights.nodes > 0})),
        width_(static_cast<std::uint64_t>(settings.width)),
        seed_(settings.seed),
        corner_(pinhole.place(0, 1)),
        right_(pinhole.across() / settings.width),
        down_(-pinhole.upwards() / settings.height) {
    view_.sampler = settings.sampler;
    view_.emitters = options.emitters;
    if (settings.is_centred()) {
      corner_ = corner_ + (right_ - down_) * 0.5;
      return;
    }
    view_.right = rounded<T>(right_);
    view_.up = rounded<T>(-down_);
  }

  bool trace(std::span<SampleRun> runs, WideCounts& counts,
             const std::atomic<bool>& cancel) const override {
    // thread_local: new memory would have to be mapped each time.
    thread_local std::vector<SampleBlock<T>> blocks;
    thread_local std::vector<LinearRgb> sums;
    blocks.clear();
    for (const SampleRun& run : runs) blocks.push_back(block_of(run));
    sums.resize(runs.size());
    kernel_(scene_, view_, blocks, sums, counts, cancel);
    if (cancel.load(std::memory_order_relaxed)) return false;
    for (std::size_t i = 0; i < runs.size(); ++i) runs[i].sum = sums[i];
    return true;
  }

  std::size_t memory_bytes() const noexcept override { return scene_.memory_bytes(); }

 private:
  SampleBlock<T> block_of(const SampleRun& run) const {
    const auto x = static_cast<double>(run.pixel % width_);
    const auto y = static_cast<double>(run.pixel / width_ + 1);  // the pixel's lower edge
    return {.corner = rounded<T>(corner_ + right_ * x + down_ * y),
            .first = run.first,
            .count = run.count,
            .stream_key = PathSampler::stream_key(seed_, run.pixel, run.replicate),
            .sum = {run.sum.r, run.sum.g, run.sum.b}};
  }

  WideScene<T> scene_;
  TraceBlocks<T>* kernel_;
  std::uint64_t width_, seed_;
  Vec3 corner_;        // upper left corner of the picture
  Vec3 right_, down_;  // a pixel's sides
  WideView<T> view_{};
};

WideIntegrator::WideIntegrator(Scene scene, const RenderSettings& settings,
                               const Options& options) {
  const Pinhole pinhole(scene.camera);
  rebase_to_camera(scene, options.exact_spheres);
  part_touching(scene, options.precision, options.exact_spheres, options.near_pairs);
  if (options.precision == Precision::Double) {
    tracer_ = std::make_unique<TracerIn<double>>(scene, pinhole, settings, options);
  } else {
    tracer_ = std::make_unique<TracerIn<float>>(scene, pinhole, settings, options);
  }
}

WideIntegrator::~WideIntegrator() = default;

bool WideIntegrator::trace(std::span<SampleRun> runs, WideCounts& counts,
                           const std::atomic<bool>& cancel) const {
  return tracer_->trace(runs, counts, cancel);
}

std::size_t WideIntegrator::memory_bytes() const noexcept { return tracer_->memory_bytes(); }

}  // namespace sdlc::render
