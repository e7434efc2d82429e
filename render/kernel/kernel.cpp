#include "render/kernel/kernel.hpp"

#include <algorithm>
#include <utility>

#include "render/exactness/camera_surface.hpp"
#include "render/exactness/precision.hpp"
#include "render/kernel/light_pilot.hpp"
#include "render/kernel/wide_scene.hpp"
#include "render/parallel/workers.hpp"
#include "render/shading/choose_lights.hpp"

namespace sdlc::render {
namespace {

using Subject = KernelRefusal::Subject;

/// Why no vectors, or the portable backend if it was requested, can trace the scene.
std::optional<KernelObstacle> obstacle_to(const Scene& scene, const KernelRequest& request) {
  const bool is_portable = request.backend == &portable_backend();
  if (!is_portable && available_vectors().empty()) return KernelObstacle::NoVectors;
  if (!is_portable && scene.spheres.empty()) return KernelObstacle::NoSpheres;
  const bool tests_all = request.search == Search::All;
  if (tests_all && scene.spheres.size() > kMaxWideSpheres) return KernelObstacle::TooManySpheres;
  const Backend& backend = request.backend != nullptr ? *request.backend : best_backend();
  const bool allows_surfaces = backend.allows_camera_on_surfaces && !tests_all;
  if (!allows_surfaces && count_under_camera(scene) > 1) return KernelObstacle::SeveralSurfaces;
  return std::nullopt;
}

Kernel kernel_in_double(const Scene& scene, const RenderSettings& settings, std::string reason) {
  Kernel kernel;
  kernel.precision_reason = std::move(reason);
  kernel.bounds = judge_precision(scene, scene.camera, settings, Precision::Double);
  return kernel;
}

/// The precision that was requested, or that the scene requires, and the reason.
Kernel judged_kernel(const Scene& scene, const RenderSettings& settings,
                     const KernelRequest& request) {
  if (request.precision == Precision::Double) {
    return kernel_in_double(scene, settings, "double was requested");
  }
  FloatVerdict verdict = judge_float(scene, scene.camera, settings);
  const PrecisionClause clause = verdict.in_float.deciding();
  const std::string objection = describe(clause, verdict.in_float[clause]);
  if (!verdict.is_accepted && !request.precision) {
    return kernel_in_double(scene, settings, objection);
  }

  Kernel kernel;
  kernel.bounds = std::move(verdict.bounds);
  kernel.exact_spheres = std::move(verdict.exact_spheres);
  const bool is_mixed = !kernel.exact_spheres.empty();
  kernel.precision = is_mixed ? Precision::Mixed : Precision::Float;
  if (is_mixed) {
    kernel.precision_reason =
        std::to_string(kernel.exact_spheres.size()) + " in double: " + objection;
  } else if (!verdict.is_accepted) {
    kernel.precision_reason = "float was requested, but " + objection;
  } else {
    kernel.precision_reason = "rounding errors are far below a pixel";
  }
  return kernel;
}

Kernel refused(Subject subject, KernelObstacle obstacle, const KernelRequest& request) {
  Kernel kernel;
  kernel.refusal = {.subject = subject, .obstacle = obstacle, .backend = request.backend};
  return kernel;
}

/// Instances are traced through a BVH in double.
Kernel kernel_for_instances(const Scene& scene, const RenderSettings& settings,
                            const KernelRequest& request) {
  if (request.search == Search::All) {
    return refused(Subject::Search, KernelObstacle::InstancesByBvh, request);
  }
  if (request.precision && request.precision != Precision::Double && !request.may_take_double) {
    return refused(Subject::Precision, KernelObstacle::InstancesInDouble, request);
  }
  if (count_under_camera(scene) > 1) {
    return refused(Subject::Instances, KernelObstacle::SeveralSurfaces, request);
  }
  Kernel kernel = kernel_in_double(scene, settings, "instances are traced in double");
  kernel.backend = request.backend != nullptr ? request.backend : &best_backend();
  return kernel;
}

/// Sets the search to the requested one, or to the faster one.
void choose_search(Kernel& kernel, const Scene& scene, const KernelRequest& request) {
  if (request.search) {
    kernel.search = *request.search;
    return;
  }
  const std::size_t spheres = scene.spheres.size();
  if (spheres == 0 || spheres > kMaxWideSpheres || count_under_camera(scene) > 1) return;  // a BVH
  const SearchCost& cost = kernel.backend->cost(kernel.precision);
  kernel.ray_times = {cost.of(Search::All, spheres), cost.of(Search::Bvh, spheres)};
  if (kernel.ray_times->all <= kernel.ray_times->bvh) kernel.search = Search::All;
}

Kernel kernel_for(const Scene& scene, const RenderSettings& settings,
                  const KernelRequest& request) {
  if (request.backend != nullptr && !request.backend->is_available()) {
    return refused(Subject::Backend, KernelObstacle::OtherMachine, request);
  }
  if (!scene.instances.empty()) return kernel_for_instances(scene, settings, request);
  const bool is_portable = request.backend == &portable_backend();
  const auto obstacle = obstacle_to(scene, request);
  const bool takes_double = request.may_take_double && (is_portable || obstacle);
  const bool wants_float =
      request.precision && request.precision != Precision::Double && !takes_double;
  if (is_portable && wants_float) {
    return refused(Subject::Precision, KernelObstacle::PortableInDouble, request);
  }
  if (obstacle) {
    if (request.search) return refused(Subject::Search, *obstacle, request);
    if (request.backend != nullptr) return refused(Subject::Backend, *obstacle, request);
    if (wants_float) return refused(Subject::Precision, *obstacle, request);
  }
  Kernel kernel;
  if (is_portable || obstacle) {
    kernel = kernel_in_double(scene, settings, obstacle ? "" : "the scalar kernel was requested");
    kernel.obstacle = obstacle;
  } else {
    kernel = judged_kernel(scene, settings, request);
    kernel.backend = request.backend != nullptr ? request.backend : &best_backend();
  }
  choose_search(kernel, scene, request);
  return kernel;
}

/// What connections are made to, and by way of what.
struct Connections {
  std::vector<std::uint32_t> lights, casters;
  bool at_metal = false;  // from rough metal, too
};

/// Whether a light is so small, as seen from a caster, that scattering hardly ever finds it.
bool is_hard_to_find(const Scene& scene, const Connections& of) {
  constexpr double kSmallAngle = 1.0 / 30;  // of the light's radius
  constexpr std::size_t kMaxPairs = 4096;
  if (of.lights.size() * of.casters.size() > kMaxPairs) return false;
  for (const std::uint32_t caster : of.casters) {
    for (const std::uint32_t light : of.lights) {
      const Sphere& from = scene.spheres[caster];
      const Sphere& to = scene.spheres[light];
      const double distance = moderate_length(to.center - from.center);
      if (distance > from.radius + to.radius && to.radius < kSmallAngle * distance) return true;
    }
  }
  return false;
}

/// The connections of LightSampling::Auto. Geometry decides if the pilot found hardly any light:
/// light in one corner of the picture may be what matters.
Connections connections_by_pilot(const Scene& scene, const RenderSettings& settings,
                                 const Connections& all) {
  constexpr double kTie = 0.8;  // casters are left out unless they save this much
  std::vector<std::uint32_t> chosen = choose_lights(scene, LightSampling::Auto);
  const LightPilot of_all = run_light_pilot(scene, settings, all.lights, all.casters);
  const auto with_casters = [&](std::vector<std::uint32_t> lights) {
    Connections found{std::move(lights), all.casters, of_all.samples_at_metal};
    if (!is_hard_to_find(scene, found)) found.casters.clear();
    return found;
  };
  if (of_all.connections < kMinConnections) return with_casters(std::move(chosen));
  LightPilot of_chosen;
  if (!chosen.empty() && chosen.size() < all.lights.size()) {
    of_chosen = run_light_pilot(scene, settings, chosen, {});
  }
  const double direct = std::min(of_all.direct.product(), of_chosen.direct.product());
  const double best = std::min(direct, 1.0);
  if (of_all.caustics < kMinConnections) {
    const Connections found = with_casters(all.lights);
    if (!found.casters.empty()) return found;
  } else if (of_all.with_casters.product() < kTie * best) {
    return {all.lights, all.casters, of_all.samples_at_metal};
  }
  if (best >= 1) return {};
  if (of_chosen.direct.product() < of_all.direct.product()) {
    return {std::move(chosen), {}, of_chosen.samples_at_metal};
  }
  return {all.lights, {}, of_all.samples_at_metal};
}

Connections connections_for(const Scene& scene, const RenderSettings& settings,
                            std::span<const std::uint32_t> exact_spheres) {
  if (settings.light_sampling != LightSampling::Auto) {
    Connections all{choose_lights(scene, settings.light_sampling), {}, has_rough_metal(scene)};
    if (settings.light_sampling == LightSampling::Caustics && !all.lights.empty()) {
      all.casters = choose_casters(scene, exact_spheres);
    }
    return all;
  }
  constexpr std::size_t kMaxPilotSpheres = 1 << 17;  // building the BVH twice takes time
  if (!scene.instances.empty() || scene.spheres.size() > kMaxPilotSpheres) {
    Connections by_geometry{choose_lights(scene, LightSampling::Auto), {}};
    by_geometry.at_metal = is_metal_rough_for(scene, by_geometry.lights);
    return by_geometry;
  }
  Connections all{choose_lights(scene, LightSampling::On), {}};
  if (all.lights.empty()) return all;
  all.casters = choose_casters(scene, exact_spheres);
  return connections_by_pilot(scene, settings, all);
}

Kernel kernel_and_lights_for(const Scene& scene, const RenderSettings& settings,
                             const KernelRequest& request) {
  Kernel kernel = kernel_for(scene, settings, request);
  if (kernel.refusal) return kernel;
  Connections connections = connections_for(scene, settings, kernel.exact_spheres);
  kernel.may_have_casters = !choose_lights(scene, LightSampling::On).empty() &&
                            !choose_casters(scene, kernel.exact_spheres).empty();
  kernel.lights = std::move(connections.lights);
  kernel.casters = std::move(connections.casters);
  kernel.samples_at_metal = connections.at_metal && !kernel.lights.empty();
  if (settings.light_sampling == LightSampling::Auto &&
      !choose_lights(scene, LightSampling::On).empty()) {
    const std::size_t count = kernel.lights.size();
    const std::string lights = std::to_string(count) + (count == 1 ? " light" : " lights");
    kernel.light_choice =
        count == 0 ? "off" : (kernel.casters.empty() ? "on, " : "caustics, ") + lights;
    if (kernel.samples_at_metal) kernel.light_choice += ", also at metal";
  }
  return kernel;
}

}  // namespace

std::string describe(KernelObstacle obstacle) {
  switch (obstacle) {
    case KernelObstacle::OtherMachine: return "this machine lacks the instructions";
    case KernelObstacle::NoVectors: return "the machine lacks the instructions of the wide kernels";
    case KernelObstacle::NoSpheres: return "no spheres";
    case KernelObstacle::TooManySpheres:
      return "more than " + std::to_string(kMaxWideSpheres) + " spheres";
    case KernelObstacle::SeveralSurfaces: return "the camera is on several surfaces";
    case KernelObstacle::PortableInDouble: return "the scalar kernel computes in double";
    case KernelObstacle::InstancesByBvh: return "instances are traced with a BVH";
    default: return "instances are traced in double";
  }
}

std::string_view name_of(const Kernel& kernel) noexcept {
  if (kernel.is_portable()) return "scalar";
  return kernel.search == Search::All ? "wide" : "bvh";
}

Kernel choose_kernel(const Scene& scene, const RenderSettings& settings,
                     const KernelRequest& request) {
  return Workers(settings.threads).run([&] {
    return kernel_and_lights_for(scene, settings, request);
  });
}

std::size_t estimated_bytes(const Kernel& kernel, const Scene& scene) noexcept {
  return kernel.precision == Precision::Double
             ? WideScene<double>::estimated_bytes(scene, kernel.search)
             : WideScene<float>::estimated_bytes(scene, kernel.search);
}

}  // namespace sdlc::render
