#include "render/kernel/tracer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "render/exactness/lens_contact.hpp"
#include "render/exactness/rebase.hpp"
#include "render/exactness/touching.hpp"
#include "render/kernel/path_kernel.hpp"
#include "render/shading/pinhole.hpp"

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
                   .height = static_cast<std::uint64_t>(settings.height),
                   .seed = settings.seed,
                   .max_depth = static_cast<std::uint32_t>(settings.depth),
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

/// `camera`: of the rebased scene.
template <typename T>
void put_lens(const Camera& camera, const Pinhole& pinhole, WideView<T>& view) {
  const Vec3 right = pinhole.right() * (camera.aperture / 2);
  const Vec3 up = pinhole.up() * (camera.aperture / 2);
  view.lens_right = rounded<T>(right);
  view.lens_up = rounded<T>(up);
  view.lens_right_in_view = rounded<T>(right / camera.focus);
  view.lens_up_in_view = rounded<T>(up / camera.focus);
}

/// Adds a sphere of radius 0, which is never hit, to a scene without any: tables need a row.
void fill_sky(Scene& scene) {
  scene.spheres.emplace_back();
  scene.materials.emplace_back();
  scene.shifts.clear();
  // A picture of one colour may have no camera.
  if (scene.camera.from == scene.camera.at) scene.camera.at.z -= 1;
}

/// An upper limit for the distance of a surface from the camera in a rebased scene.
double reach_of(const Scene& rebased, std::span<const std::uint32_t> exact_spheres) {
  double reach = 4;  // twice the extent of the other spheres
  for (const std::uint32_t i : exact_spheres) {
    const Vec3 shift = rebased.shifts.empty() ? Vec3{} : rebased.shifts[i];
    const Sphere& sphere = rebased.spheres[i];
    reach = std::fmax(
        reach, 2 * (moderate_length(sphere.center) + moderate_length(shift) + sphere.radius));
  }
  return reach;
}

/// The tracer for numbers of type T.
template <typename T>
class TracerIn final : public Tracer {
 public:
  TracerIn(const Scene& rebased, const Rebase& rebase, const Pinhole& pinhole,
           const TracerOptions& options, ChooseKernel<T>& choose)
      : Tracer(rebase, reach_of(rebased, options.exact_spheres)),
        scene_(rebased, options.search, options.exact_spheres, options.lights, options.casters,
               options.samples_at_metal),
        camera_(rebased.camera),
        kernel_(choose(kernel_features(scene_, camera_))),
        pinhole_(pinhole),
        glints_(in_leaves(options.glints)) {}

  bool trace(const RenderSettings& settings, EmitterTally* emitters, std::span<PixelRun> runs,
             TraceCounts& counts, const std::atomic<bool>& cancel) const override {
    WideView<T> view = this->view(settings, emitters, runs);
    if (camera_.has_lens()) put_lens(camera_, pinhole_, view);
    kernel_(scene_, view, runs, counts, cancel);
    return !cancel.load(std::memory_order_relaxed);
  }

  std::optional<PickedSphere> pick(const RenderSettings& settings,
                                   std::uint64_t pixel) const override {
    RenderSettings centred = settings;
    centred.samples = centred.depth = 1;
    centred.error.reset();
    centred.seconds.reset();
    FirstHitSums sums;
    PixelRun run{
        .pixel = pixel, .parts = {{{.first = 0, .count = 1, .sum = {}}}}, .first_hits = &sums};
    const std::span<PixelRun> runs(&run, 1);
    PickedSlot picked;
    WideView<T> view = this->view(centred, nullptr, runs);
    view.picked = &picked;
    TraceCounts counts;
    kernel_(scene_, view, runs, counts, std::atomic<bool>{false});
    if (picked.slot == PickedSlot::kNone) return std::nullopt;
    PickedSphere sphere{.sphere = scene_.index_in_scene[picked.slot],
                        .distance = rebase().length_in_scene(picked.distance)};
    if (picked.row > 0) sphere.instance = picked.row - 1;
    return sphere;
  }

  std::size_t memory_bytes() const noexcept override { return scene_.memory_bytes(); }

 private:
  WideView<T> view(const RenderSettings& settings, EmitterTally* emitters,
                   std::span<const PixelRun> runs) const {
    WideView<T> view = view_of<T>(pinhole_, settings, emitters);
    view.keeps_first_hits = !runs.empty() && runs.front().first_hits != nullptr;
    view.forward = rounded<T>(pinhole_.place(0.5, 0.5));
    view.depth_units = std::ldexp(1.0, units_exponent());
    if (!settings.is_centred()) view.glints = glints_;
    return view;
  }

  /// Replaces spheres by leaves.
  std::vector<Glint> in_leaves(std::span<const Glint> of_spheres) const {
    std::vector<Glint> glints(of_spheres.begin(), of_spheres.end());
    const auto leaf_of = [&](const WideLights<T>& lights, std::uint32_t sphere) {
      const auto slot = std::ranges::find(scene_.index_in_scene, sphere);
      return lights.leaf_of_slot[static_cast<std::size_t>(slot - scene_.index_in_scene.begin())];
    };
    for (Glint& glint : glints) {
      glint.caster = leaf_of(scene_.casters, glint.caster);
      glint.light = leaf_of(scene_.lights, glint.light);
    }
    return glints;
  }

  static KernelFeatures kernel_features(const WideScene<T>& scene, const Camera& camera) {
    return {.motion = scene.has_motion,
            .exact_spheres = scene.exact_spheres > 0,
            .bvh = scene.search == Search::Bvh,
            .instances = !scene.instances.empty(),
            .lights = scene.lights.nodes > 0,
            .lens = camera.has_lens(),
            .caustics = scene.casters.nodes > 0};
  }

  const WideScene<T> scene_;
  const Camera camera_;
  TraceRuns<T>* const kernel_;
  const Pinhole pinhole_;
  const std::vector<Glint> glints_;
};

}  // namespace

Tracer::Tracer(const Rebase& rebase, double reach) noexcept
    : rebase_(rebase), units_exponent_(94 - std::ilogb(reach)) {}

std::unique_ptr<const Tracer> make_tracer(Scene scene, const TracerOptions& options) {
  if (scene.spheres.empty() && scene.instances.empty()) fill_sky(scene);
  if (find_lens_contact(scene, scene.camera)) {
    throw std::invalid_argument("the lens touches the surface of a sphere");
  }
  const Pinhole pinhole(scene.camera);
  const Rebase rebase(scene, options.exact_spheres);
  rebase_to_camera(scene, options.exact_spheres);
  part_touching(scene, options.precision, options.exact_spheres, options.near_pairs);
  const Backend& backend = *options.backend;
  if (options.precision == Precision::Double) {
    return std::make_unique<TracerIn<double>>(scene, rebase, pinhole, options,
                                              *backend.kernel_in_double);
  }
  return std::make_unique<TracerIn<float>>(scene, rebase, pinhole, options,
                                           *backend.kernel_in_float);
}

}  // namespace sdlc::render
