#include "render/wide/wide_integrator.hpp"

#include <array>
#include <utility>

#include "render/camera/pinhole.hpp"
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
  virtual bool trace(std::span<PixelRun> runs, WideCounts& counts,
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
        view_{.width = static_cast<std::uint64_t>(settings.width),
              .seed = settings.seed,
              .corner = pinhole.place(0, 1),
              .right = pinhole.across() / settings.width,
              .down = -pinhole.upwards() / settings.height,
              .sampler = settings.sampler,
              .emitters = options.emitters} {
    if (settings.is_centred()) {
      view_.corner = view_.corner + (view_.right - view_.down) * 0.5;
    } else {
      view_.spread_right = rounded<T>(view_.right);
      view_.spread_up = rounded<T>(-view_.down);
    }
  }

  bool trace(std::span<PixelRun> runs, WideCounts& counts,
             const std::atomic<bool>& cancel) const override {
    kernel_(scene_, view_, runs, counts, cancel);
    return !cancel.load(std::memory_order_relaxed);
  }

  std::size_t memory_bytes() const noexcept override { return scene_.memory_bytes(); }

 private:
  WideScene<T> scene_;
  TraceRuns<T>* kernel_;
  WideView<T> view_;
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

bool WideIntegrator::trace(std::span<PixelRun> runs, WideCounts& counts,
                           const std::atomic<bool>& cancel) const {
  return tracer_->trace(runs, counts, cancel);
}

std::size_t WideIntegrator::memory_bytes() const noexcept { return tracer_->memory_bytes(); }

}  // namespace sdlc::render
