#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "lang/lint/sphere_tree.hpp"

namespace sdlc::lang {
namespace {

using render::Vec3;

/// What a sphere around a camera leaves of the scene.
struct Enclosed {
  bool shows_spheres = false;  ///< wholly inside, or coming in
  bool hides_spheres = false;  ///< wholly outside
};

/// Whether sphere `a` is wholly outside of sphere `b` while the shutter is open: not even with all
/// of the way that one makes towards the other they meet.
bool is_outside(const LintContext& context, std::uint32_t a, std::uint32_t b) {
  const render::Sphere &one = context.spheres()[a], &other = context.spheres()[b];
  const double way = length(context.shift_of(a) - context.shift_of(b));
  const double margin = rounding_margin(one.center, one.radius, other.center, other.radius + way);
  return length(one.center - other.center) - way > one.radius + other.radius + margin;
}

/// The smallest opaque sphere that has the point inside while the shutter is open.
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

Enclosed look_into(const LintContext& context, std::uint32_t shell) {
  Enclosed enclosed;
  for (std::uint32_t i = 0; i < context.spheres().size(); ++i) {
    context.stop_if_requested();
    if (i == shell) continue;
    if (is_outside(context, i, shell)) {
      enclosed.hides_spheres = true;
    } else {
      enclosed.shows_spheres = true;
    }
  }
  return enclosed;
}

std::string with_name(const std::string& name) { return name.empty() ? "" : " `" + name + "`"; }

}  // namespace

/// The camera stands inside a sphere whose surface lets nothing through, and so sees nothing beyond
/// it: |from − centre| < radius at both ends of the shutter, and between them, where a distance is
/// no larger than at one of its ends. A room or a dome that holds the whole scene is meant; it is
/// told where spheres are wholly outside, or none comes in. Of more than a hundred cameras the
/// first hundred are looked at.
void check_camera_inside(LintContext& context) {
  const auto& cameras = context.lowered().checked_cameras;
  std::map<std::uint32_t, Enclosed> looked_into;
  std::vector<std::pair<std::size_t, std::uint32_t>> inside;  // camera, sphere
  for (std::size_t i = 0; i < std::min(cameras.size(), LintContext::kMostCameras); ++i) {
    const auto shell = smallest_around(context, cameras[i].camera.from);
    if (!shell) continue;
    const auto [found, is_new] = looked_into.try_emplace(*shell);
    if (is_new) found->second = look_into(context, *shell);
    if (found->second.shows_spheres && !found->second.hides_spheres) continue;
    inside.emplace_back(i, *shell);
  }
  if (inside.empty()) return;

  std::vector<std::uint32_t> wanted;
  for (const auto& [camera, shell] : inside) wanted.push_back(shell);
  std::ranges::sort(wanted);
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  const std::vector<Origin> origins = context.trace(wanted);
  for (const auto& [camera, shell] : inside) {
    const auto at = std::ranges::lower_bound(wanted, shell) - wanted.begin();
    const render::Sphere& sphere = context.spheres()[shell];
    const double distance = length(cameras[camera].camera.from - sphere.center);
    Finding& finding = context.add(diag::camera_inside, LintPlace::of(cameras[camera].from),
                                   with_name(cameras[camera].name),
                                   with_name(origins[static_cast<std::size_t>(at)].name));
    finding.labels.push_back({LintPlace::of_sphere(shell), "which hides all that is outside"});
    finding.help.push_back(fmt::format("it is {:.4g} from the centre, and the radius is {:.4g}",
                                       distance, sphere.radius));
  }
}

}  // namespace sdlc::lang
