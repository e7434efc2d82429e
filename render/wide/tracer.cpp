#include "render/wide/tracer.hpp"

#include <array>
#include <utility>

#include "render/camera/pinhole.hpp"
#include "render/scene/rebase.hpp"
#include "render/scene/touching.hpp"
#include "render/wide/path_kernel.hpp"

namespace sdlc::render {
namespace {

template <typename T>
std::array<T, 3> rounded(Vec3 v) {
  return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}

template <typename T>
WideView<T> view_of(const Pinhole& pinhole, const RenderSettings& settings,
                    EmitterTally* emitters) {
  WideView<T> view{.width = static_cast<std::uint64_t>(settings.width),
                   .seed = settings.seed,
                   .corner = pinhole.place(0, 1),
                   .right = pinhole.across() / settings.width,
                   .down = -pinhole.upwards() / settings.height,
                   .sampler = settings.sampler,
                   .emitters = emitters};
  if (settings.is_centred()) {
    view.corner = view.corner + (view.right - view.down) * 0.5;
  } else {
    view.spread_right = rounded<T>(view.right);
    view.spread_up = rounded<T>(-view.down);
  }
  return view;
}

/// Adds a sphere of radius 0, which is never hit, to a scene without any: tables need a row.
void fill_sky(Scene& scene) {
  scene.spheres.emplace_back();
  scene.materials.emplace_back();
  scene.shifts.clear();
  // A picture of one colour may have no camera.
  if (scene.camera.from == scene.camera.at) scene.camera.at.z -= 1;
}

/// The tracer for numbers of type T.
template <typename T>
class TracerIn final : public Tracer {
 public:
  TracerIn(const Scene& rebased, const RenderSettings& settings, const TracerOptions& options,
           const WideView<T>& view, ChooseKernel<T>& choose)
      : scene_(rebased, settings.depth, options.search, options.exact_spheres, options.lights),
        kernel_(choose(features_of(scene_))),
        view_(view) {}

  bool trace(std::span<PixelRun> runs, TraceCounts& counts,
             const std::atomic<bool>& cancel) const override {
    kernel_(scene_, view_, runs, counts, cancel);
    return !cancel.load(std::memory_order_relaxed);
  }

  std::size_t memory_bytes() const noexcept override { return scene_.memory_bytes(); }

 private:
  static KernelFeatures features_of(const WideScene<T>& scene) {
    return {.motion = scene.has_motion,
            .exact_spheres = scene.exact_spheres > 0,
            .bvh = scene.search == Search::Bvh,
            .instances = !scene.instances.empty(),
            .lights = scene.lights.nodes > 0};
  }

  const WideScene<T> scene_;
  TraceRuns<T>* const kernel_;
  const WideView<T> view_;
};

}  // namespace

std::unique_ptr<const Tracer> make_tracer(Scene scene, const RenderSettings& settings,
                                          const TracerOptions& options) {
  if (scene.spheres.empty() && scene.instances.empty()) fill_sky(scene);
  const Pinhole pinhole(scene.camera);
  rebase_to_camera(scene, options.exact_spheres);
  part_touching(scene, options.precision, options.exact_spheres, options.near_pairs);
  const Backend& backend = *options.backend;
  if (options.precision == Precision::Double) {
    return std::make_unique<TracerIn<double>>(scene, settings, options,
                                              view_of<double>(pinhole, settings, options.emitters),
                                              *backend.kernel_in_double);
  }
  return std::make_unique<TracerIn<float>>(scene, settings, options,
                                           view_of<float>(pinhole, settings, options.emitters),
                                           *backend.kernel_in_float);
}

}  // namespace sdlc::render
