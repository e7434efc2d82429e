#include "lang/lower/precision_fault.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/exactness/near_pairs.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::lang {
namespace {

using render::Precision;
using render::PrecisionBound;
using render::PrecisionBounds;
using render::PrecisionClause;

std::vector<PrecisionFault::Role> roles_of(PrecisionClause clause, const PrecisionBound& bound) {
  std::vector<PrecisionFault::Role> roles;
  switch (clause) {
    case PrecisionClause::Hit:
      if (bound.sphere) roles.push_back({*bound.sphere, "the smallest sphere"});
      if (bound.other != bound.sphere && bound.other) {
        roles.push_back({*bound.other, "the farthest"});
      }
      break;
    case PrecisionClause::Across:
      if (bound.sphere) roles.push_back({*bound.sphere, "the surface that is too near"});
      break;
    case PrecisionClause::Gap:
      if (bound.sphere) roles.push_back({*bound.sphere, "one of the two surfaces"});
      if (bound.other) roles.push_back({*bound.other, "the other one"});
      break;
    case PrecisionClause::Radiance:
      if (bound.sphere) {
        roles.push_back({*bound.sphere, bound.other ? "the brightest light" : "its material"});
      }
      if (bound.other) roles.push_back({*bound.other, "what multiplies light most"});
      break;
    default: break;
  }
  return roles;
}

std::string help_for(PrecisionClause clause, const PrecisionBound& bound, Precision precision) {
  if (precision != Precision::Double) return "`auto` chooses a sufficient precision";
  if (clause != PrecisionClause::Radiance) {
    return "there is no higher precision: objects this small, near or far away are rendered wrong";
  }
  return bound.value >= 1
             ? "there is no higher precision: use darker lights, and colors up to white"
             : "there is no higher precision: use brighter lights and colors";
}

PrecisionFault beyond_double_fault(const render::ScaleRatio& scale) {
  PrecisionFault fault{
      .info = &diag::beyond_double,
      .message = fmt::format(fmt::runtime(diag::beyond_double.message),
                             std::isfinite(scale.ratio) ? fmt::format("{:.3g}", scale.ratio)
                                                        : std::string("over 1e308")),
      .roles = {},
      .help =
          "move the smallest or the farthest objects to a scene of their own; --precision double "
          "renders it anyway, with errors"};
  if (scale.smallest) fault.roles.push_back({*scale.smallest, "the smallest sphere"});
  if (scale.farthest && scale.farthest != scale.smallest) {
    fault.roles.push_back({*scale.farthest, "the farthest"});
  }
  return fault;
}

}  // namespace

std::optional<PrecisionFault> find_scale_fault(const render::Scene& scene,
                                               const render::Camera& camera,
                                               std::optional<Precision> wanted) {
  if (wanted == Precision::Double) return std::nullopt;
  const render::ScaleRatio scale = measure_scale(scene, camera);
  if (scale.ratio <= render::kMaxScaleInDouble) return std::nullopt;
  return beyond_double_fault(scale);
}

std::optional<PrecisionFault> find_bounds_fault(const PrecisionBounds& bounds,
                                                Precision precision) {
  if (bounds.is_accepted()) return std::nullopt;
  const PrecisionClause clause = bounds.deciding();
  return PrecisionFault{
      .info = &diag::beyond_precision,
      .message = fmt::format(fmt::runtime(diag::beyond_precision.message), name_of(precision),
                             describe(clause, bounds[clause])),
      .roles = roles_of(clause, bounds[clause]),
      .help = help_for(clause, bounds[clause], precision)};
}

std::optional<PrecisionFault> find_precision_fault(const render::Scene& scene,
                                                   const render::Camera& camera,
                                                   const render::RenderSettings& settings,
                                                   std::optional<Precision> wanted) {
  if (auto fault = find_scale_fault(scene, camera, wanted)) return fault;
  if (wanted == Precision::Float) {
    return find_bounds_fault(judge_float(scene, camera, settings).bounds, Precision::Float);
  }
  return find_bounds_fault(judge_precision(scene, camera, settings, Precision::Double),
                           Precision::Double);
}

std::size_t cameras_to_judge(std::size_t cameras, std::size_t spheres) noexcept {
  constexpr std::size_t kMaxCost = 2'000'000;
  // A pair of spheres takes half the time of a sphere; the search for near pairs ten times it.
  const std::size_t pairs = spheres <= render::kFewSpheres ? spheres * spheres / 2 : 10 * spheres;
  const std::size_t cost = 1 + spheres + pairs;
  return std::min(cameras, std::max<std::size_t>(1, kMaxCost / cost));
}

}  // namespace sdlc::lang
