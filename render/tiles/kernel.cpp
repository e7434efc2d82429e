#include "render/tiles/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/scene/camera_surface.hpp"
#include "render/scene/precision.hpp"
#include "render/scene/rebase.hpp"
#include "render/wide/wide_scene.hpp"

namespace sdlc::render {
namespace {

// Nanoseconds that a ray takes, fitted to scenes of 4 to 250 spheres on one thread of a Cascade
// Lake at 2.5 GHz with AVX2. Machines with other instructions decide by the same numbers, so that a
// scene gives the same picture everywhere.
double wide_cost(std::size_t spheres, Precision precision) {
  const auto n = static_cast<double>(spheres);
  return precision == Precision::Double ? 50 + 2.3 * n : 20 + 0.9 * n;
}
double scalar_cost(std::size_t spheres) {
  return 200 + 12 * std::log2(static_cast<double>(spheres + 1));
}

// Gaps between spheres are looked for wherever float may be taken.
static_assert(kMostWideSpheres <= kMostSpheresForGaps);

/// Why the wide kernel does not take a scene; empty: it does.
std::string objection_to_wide(const Scene& scene) {
  if (available_isas().empty()) return "the machine lacks the instructions of the wide kernel";
  if (scene.spheres.empty()) return "no spheres";
  if (scene.spheres.size() > kMostWideSpheres) {
    return "more than " + std::to_string(kMostWideSpheres) + " spheres";
  }
  Scene rebased = scene;
  rebase_to_camera(rebased);
  int under_camera = 0;
  for (std::size_t i = 0; i < rebased.spheres.size(); ++i) {
    const Vec3 shift = rebased.shifts.empty() ? Vec3{} : rebased.shifts[i];
    under_camera += has_camera_on_it(rebased.spheres[i], shift);
  }
  return under_camera > 1 ? "the camera stands on several surfaces" : "";
}

bool has(Isa isa) {
  const auto isas = available_isas();
  return std::find(isas.begin(), isas.end(), isa) != isas.end();
}

Kernel scalar_kernel(std::string reason) {
  Kernel kernel;
  kernel.reason = std::move(reason);
  return kernel;
}

/// The wide kernel in the precision that is asked for, or that the scene asks for.
Kernel wide_kernel_for(const Scene& scene, const RenderSettings& settings,
                       const KernelRequest& request) {
  Kernel kernel;
  kernel.kind = KernelKind::Wide;
  kernel.isa = request.isa.value_or(available_isas().back());
  if (request.precision == Precision::Double) {
    kernel.reason = "double was asked for";
    return kernel;
  }
  const FloatVerdict verdict = judge_float(scene, scene.camera, settings);
  const PrecisionClause clause = verdict.in_float.deciding();
  const std::string objection = describe(clause, verdict.in_float[clause]);
  kernel.exact_spheres = verdict.exact_spheres;
  const bool is_mixed = !verdict.exact_spheres.empty();
  if (verdict.is_accepted || request.precision) {
    kernel.precision = is_mixed ? Precision::Mixed : Precision::Float;
  }
  if (is_mixed) {
    kernel.reason = std::to_string(verdict.exact_spheres.size()) + " met in double: " + objection;
  } else if (!verdict.is_accepted) {
    kernel.reason = objection;
  } else {
    kernel.reason = "rounding stays far below a pixel";
  }
  return kernel;
}

}  // namespace

std::string_view name_of(KernelKind kind) noexcept {
  return kind == KernelKind::Wide ? "wide" : "scalar";
}

Kernel choose_kernel(const Scene& scene, const RenderSettings& settings,
                     const KernelRequest& request) {
  const auto refused = [](std::string refusal) {
    Kernel kernel = scalar_kernel(refusal);
    kernel.refusal = std::move(refusal);
    return kernel;
  };
  const bool wants_float = request.precision && request.precision != Precision::Double;
  if (wants_float && request.may_take_double &&
      (request.kind == KernelKind::Scalar || !objection_to_wide(scene).empty())) {
    KernelRequest rest = request;
    rest.precision.reset();
    return choose_kernel(scene, settings, rest);
  }
  if (request.isa && !has(*request.isa)) {
    return refused("--isa: this machine has no " + std::string(name_of(*request.isa)));
  }
  if (request.kind == KernelKind::Scalar) {
    if (wants_float) return refused("--precision: the scalar kernel computes in double");
    if (request.isa) return refused("--isa: the scalar kernel has no other instructions");
    return scalar_kernel("the scalar kernel was asked for");
  }

  const bool must_be_wide = request.kind == KernelKind::Wide || request.isa || wants_float;
  if (const std::string objection = objection_to_wide(scene); !objection.empty()) {
    if (!must_be_wide) return scalar_kernel(objection);
    const char* flag = request.kind ? "--kernel" : request.isa ? "--isa" : "--precision";
    return refused(std::string(flag) + ": not with the wide kernel: " + objection);
  }
  Kernel kernel = wide_kernel_for(scene, settings, request);
  if (must_be_wide) return kernel;

  const std::size_t spheres = scene.spheres.size();
  if (wide_cost(spheres, kernel.precision) <= scalar_cost(spheres)) return kernel;
  return scalar_kernel("its hierarchy is faster for so many spheres");
}

PrecisionBounds bounds_of(const Kernel& kernel, const Scene& scene,
                          const RenderSettings& settings) {
  if (kernel.precision == Precision::Double) {
    return judge_precision(scene, scene.camera, settings, Precision::Double);
  }
  return judge_float(scene, scene.camera, settings).bounds;
}

}  // namespace sdlc::render
