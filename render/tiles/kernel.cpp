#include "render/tiles/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/global_control.h>

#include "render/bvh/bvh.hpp"
#include "render/integrator/light_pilot.hpp"
#include "render/light/choose_lights.hpp"
#include "render/scene/camera_surface.hpp"
#include "render/scene/precision.hpp"
#include "render/tiles/threads.hpp"
#include "render/wide/wide_scene.hpp"

namespace sdlc::render {
namespace {

// Nanoseconds per ray, fitted to a ground with 23 to 249 spheres on it, on one thread of a Zen 4
// with AVX2. With AVX-512 the crossover is at about the same number of spheres.
double cost_of_all(double spheres, Precision precision) {
  return precision == Precision::Double ? 25 + 0.55 * spheres : 16 + 0.36 * spheres;
}
double cost_of_bvh(double spheres, Precision precision) {
  const double depth = std::log2(spheres);
  return precision == Precision::Double ? 70 + 4 * depth : 30 + 3.4 * depth;
}

std::string whole(double number) { return std::to_string(std::lround(number)); }

/// Why no wide kernel can trace the scene; empty if one can.
std::string objection_to_wide(const Scene& scene, const KernelRequest& request) {
  if (available_isas().empty()) return "the machine lacks the instructions of the wide kernels";
  if (scene.spheres.empty() && scene.instances.empty()) return "no spheres";
  if (request.kind == KernelKind::Wide && scene.spheres.size() > kMaxWideSpheres) {
    return "more than " + std::to_string(kMaxWideSpheres) + " spheres";
  }
  return count_under_camera(scene) > 1 ? "the camera is on several surfaces" : "";
}

bool has(Isa isa) {
  const auto isas = available_isas();
  return std::find(isas.begin(), isas.end(), isa) != isas.end();
}

Kernel kernel_in_double(const Scene& scene, const RenderSettings& settings, std::string reason) {
  Kernel kernel;
  kernel.reason = std::move(reason);
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
    kernel.reason = std::to_string(kernel.exact_spheres.size()) + " in double: " + objection;
  } else if (!verdict.is_accepted) {
    kernel.reason = "float was requested, but " + objection;
  } else {
    kernel.reason = "rounding errors are far below a pixel";
  }
  return kernel;
}

Kernel refused(std::string refusal) {
  Kernel kernel;
  kernel.reason = refusal;
  kernel.refusal = std::move(refusal);
  return kernel;
}

/// Only the BVH kernel supports instances.
Kernel kernel_for_instances(const Scene& scene, const RenderSettings& settings,
                            const KernelRequest& request) {
  const std::string hint = "; --instances never expands them";
  if (request.isa && !has(*request.isa)) {
    return refused("--isa: this machine has no " + std::string(name_of(*request.isa)));
  }
  if (request.kind && *request.kind != KernelKind::Bvh) {
    return refused("--kernel: instances are traced with a BVH" + hint);
  }
  if (request.precision && request.precision != Precision::Double && !request.may_take_double) {
    return refused("--precision: instances are traced in double" + hint);
  }
  const std::string objection = objection_to_wide(scene, request);
  if (!objection.empty()) {
    return refused("--instances: not with the scalar kernel, which is needed as " + objection +
                   hint);
  }
  Kernel kernel = kernel_in_double(scene, settings, "instances are traced in double");
  kernel.kind = KernelKind::Bvh;
  kernel.isa = request.isa.value_or(available_isas().back());
  return kernel;
}

Kernel wide_kernel_for(const Scene& scene, const RenderSettings& settings,
                       const KernelRequest& request) {
  Kernel kernel = judged_kernel(scene, settings, request);
  if (request.kind) {
    kernel.kind = *request.kind;
  } else {
    const auto spheres = static_cast<double>(scene.spheres.size());
    const double all = cost_of_all(spheres, kernel.precision);
    const double bvh = cost_of_bvh(spheres, kernel.precision);
    const bool is_small = scene.spheres.size() <= kMaxWideSpheres && all <= bvh;
    kernel.kind = is_small ? KernelKind::Wide : KernelKind::Bvh;
    kernel.reason +=
        "; model: " + whole(all) + " ns per ray with every sphere, " + whole(bvh) + " with a BVH";
  }
  kernel.isa = request.isa.value_or(available_isas().back());
  return kernel;
}

Kernel kernel_for(const Scene& scene, const RenderSettings& settings,
                  const KernelRequest& request) {
  const auto scalar = [&](std::string reason) {
    return kernel_in_double(scene, settings, std::move(reason));
  };
  // The search for gaps is parallel.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(thread_count(settings.threads)));
  if (!scene.instances.empty()) return kernel_for_instances(scene, settings, request);
  const bool is_scalar = request.kind == KernelKind::Scalar;
  const std::string objection = is_scalar ? std::string() : objection_to_wide(scene, request);
  const bool takes_double = request.may_take_double && (is_scalar || !objection.empty());
  const bool wants_float =
      request.precision && request.precision != Precision::Double && !takes_double;
  if (request.isa && !has(*request.isa)) {
    return refused("--isa: this machine has no " + std::string(name_of(*request.isa)));
  }
  if (is_scalar) {
    if (wants_float) return refused("--precision: the scalar kernel computes in double");
    if (request.isa) return refused("--isa: the scalar kernel has no other instruction sets");
    return scalar("the scalar kernel was requested");
  }

  const bool must_be_wide = request.kind || request.isa || wants_float;
  if (!objection.empty()) {
    if (!must_be_wide) return scalar(objection);
    const char* flag = request.kind ? "--kernel" : request.isa ? "--isa" : "--precision";
    return refused(std::string(flag) + ": not with the wide kernels: " + objection);
  }
  return wide_kernel_for(scene, settings, request);
}

/// The emitters that diffuse surfaces sample. The geometric choice decides if the pilot found
/// hardly any light: light in one corner of the picture may be what matters.
std::vector<std::uint32_t> lights_for(const Scene& scene, const RenderSettings& settings) {
  std::vector<std::uint32_t> chosen = choose_lights(scene, settings.light_sampling);
  constexpr std::size_t kMaxPilotSpheres = 1 << 17;  // building the BVH twice takes time
  if (settings.light_sampling != LightSampling::Auto || !scene.instances.empty() ||
      scene.spheres.size() > kMaxPilotSpheres) {
    return chosen;
  }
  std::vector<std::uint32_t> all = choose_lights(scene, LightSampling::On);
  if (all.empty()) return all;
  constexpr std::uint64_t kEnoughConnections = 30;
  const LightPilot of_all = run_light_pilot(scene, settings, all);
  if (of_all.connections < kEnoughConnections) return chosen;
  LightPilot of_chosen;
  if (!chosen.empty() && chosen.size() < all.size()) {
    of_chosen = run_light_pilot(scene, settings, chosen);
  }
  const auto cost = [](const LightPilot& pilot) { return pilot.variance * pilot.work; };
  if (std::min(cost(of_all), cost(of_chosen)) >= 1) return {};
  return cost(of_chosen) < cost(of_all) ? chosen : all;
}

}  // namespace

std::string_view name_of(KernelKind kind) noexcept {
  switch (kind) {
    case KernelKind::Wide: return "wide";
    case KernelKind::Bvh: return "bvh";
    default: return "scalar";
  }
}

Kernel choose_kernel(const Scene& scene, const RenderSettings& settings,
                     const KernelRequest& request) {
  Kernel kernel = kernel_for(scene, settings, request);
  if (kernel.refusal.empty()) kernel.lights = lights_for(scene, settings);
  return kernel;
}

std::size_t estimated_bytes(const Kernel& kernel, const Scene& scene) noexcept {
  if (kernel.kind == KernelKind::Scalar) {
    return Bvh::estimated_bytes(scene.spheres.size(), !scene.shifts.empty());
  }
  const Search search = kernel.kind == KernelKind::Bvh ? Search::Bvh : Search::All;
  return kernel.precision == Precision::Double ? WideScene<double>::estimated_bytes(scene, search)
                                               : WideScene<float>::estimated_bytes(scene, search);
}

}  // namespace sdlc::render
