#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "lang/lint/sphere_tree.hpp"

namespace sdlc::lang {
namespace {

using render::Vec3;

/// The other spheres of the scene, seen from inside a sphere.
struct Surroundings {
  bool has_inside = false;   ///< completely inside, or reaching in
  bool has_outside = false;  ///< completely outside
};

/// Whether sphere `a` is completely outside of sphere `b` while the shutter is open: they do not
/// meet even if their whole relative motion is towards each other.
bool is_outside(const LintContext& context, std::uint32_t a, std::uint32_t b) {
  const render::Sphere &one = context.spheres()[a], &other = context.spheres()[b];
  const double motion = length(context.shift_of(a) - context.shift_of(b));
  const double margin =
      rounding_margin(one.center, one.radius, other.center, other.radius + motion);
  return length(one.center - other.center) - motion > one.radius + other.radius + margin;
}

/// The smallest opaque sphere that contains the point while the shutter is open.
std::optional<std::uint32_t> smallest_around(const LintContext& context, Vec3 point) {
  std::optional<std::uint32_t> smallest;
  for (std::uint32_t i = 0; i < context.spheres().size(); ++i) {
    context.stop_if_requested();
    if (context.is_transmissive(i) || !is_inside(context, point, i)) continue;
    if (!smallest || context.spheres()[i].radius < context.spheres()[*smallest].radius) {
      smallest = i;
    }
  }
  return smallest;
}

Surroundings surroundings_of(const LintContext& context, std::uint32_t shell) {
  Surroundings others;
  for (std::uint32_t i = 0; i < context.spheres().size(); ++i) {
    context.stop_if_requested();
    if (i == shell) continue;
    bool& has_some = is_outside(context, i, shell) ? others.has_outside : others.has_inside;
    has_some = true;
  }
  return others;
}

std::string with_name(const std::string& name) { return name.empty() ? "" : " `" + name + "`"; }

}  // namespace

/// The camera is inside an opaque sphere, which hides everything outside: |from − centre| < radius
/// at both ends of the shutter. In between the distance is not larger, because it is a convex
/// function of time. A room or a dome around the whole scene is intended, so this is reported only
/// if spheres are completely outside, or none reaches inside. Checks at most kMaxCameras cameras.
void check_camera_inside(LintContext& context) {
  const auto& cameras = context.lowered().checked_cameras;
  std::map<std::uint32_t, Surroundings> known;
  std::vector<std::pair<std::size_t, std::uint32_t>> inside;  // camera, sphere
  for (std::size_t i = 0; i < std::min(cameras.size(), LintContext::kMaxCameras); ++i) {
    const auto shell = smallest_around(context, cameras[i].camera.from);
    if (!shell) continue;
    const auto [others, is_new] = known.try_emplace(*shell);
    if (is_new) others->second = surroundings_of(context, *shell);
    if (others->second.has_inside && !others->second.has_outside) continue;
    inside.emplace_back(i, *shell);
  }
  if (inside.empty()) return;

  std::vector<std::uint32_t> shells;
  for (const auto& [camera, shell] : inside) shells.push_back(shell);
  const SphereOrigins origins(context, std::move(shells));
  for (const auto& [camera, shell] : inside) {
    const render::Sphere& sphere = context.spheres()[shell];
    const double distance = length(cameras[camera].camera.from - sphere.center);
    Finding& finding =
        context.add(diag::camera_inside, LintPlace::of(cameras[camera].from),
                    with_name(cameras[camera].name), with_name(origins.of(shell).name));
    finding.labels.push_back({LintPlace::of_sphere(shell), "this sphere hides everything outside"});
    finding.help.push_back(fmt::format(
        "the camera is {:.4g} from the centre, and the radius is {:.4g}", distance, sphere.radius));
  }
}

}  // namespace sdlc::lang
