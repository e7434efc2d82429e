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
  bool has_spheres_inside = false, has_spheres_outside = false;
};

bool is_around(const LintContext& context, std::uint32_t index, Vec3 point) {
  const render::Sphere& sphere = context.spheres()[index];
  for (const double u : {0.0, 1.0}) {
    const Vec3 center = sphere.center + context.shift_of(index) * u;
    const double margin = rounding_margin(point, 0, center, sphere.radius);
    if (!(length(point - center) + margin < sphere.radius)) return false;
  }
  return true;
}

/// The smallest opaque sphere that has the point inside while the shutter is open.
std::optional<std::uint32_t> smallest_around(const LintContext& context, Vec3 point) {
  std::optional<std::uint32_t> smallest;
  for (std::uint32_t i = 0; i < context.spheres().size(); ++i) {
    if (context.is_transmissive(i) || !is_around(context, i, point)) continue;
    if (!smallest || context.spheres()[i].radius < context.spheres()[*smallest].radius) {
      smallest = i;
    }
  }
  return smallest;
}

Enclosed look_into(const LintContext& context, std::uint32_t shell) {
  Enclosed enclosed;
  for (std::uint32_t i = 0; i < context.spheres().size(); ++i) {
    if (i == shell) continue;
    (is_inside(context, i, shell) ? enclosed.has_spheres_inside : enclosed.has_spheres_outside) =
        true;
  }
  return enclosed;
}

std::string with_name(const std::string& name) { return name.empty() ? "" : " `" + name + "`"; }

}  // namespace

/// The camera stands inside a sphere whose surface lets nothing through, and so sees nothing beyond
/// it: |from − centre| < radius at both ends of the shutter, and between them, where a distance is
/// no larger than at one of its ends. A room or a dome that holds the whole scene is meant; it is
/// told where spheres are outside, or none is inside. Of more than a hundred cameras the first
/// hundred are looked at.
void check_camera_inside(LintContext& context) {
  constexpr std::size_t kMostCameras = 100;
  const auto& cameras = context.lowered().checked_cameras;
  std::map<std::uint32_t, Enclosed> looked_into;
  std::vector<std::pair<std::size_t, std::uint32_t>> inside;  // camera, sphere
  for (std::size_t i = 0; i < std::min(cameras.size(), kMostCameras); ++i) {
    const auto shell = smallest_around(context, cameras[i].camera.from);
    if (!shell) continue;
    const auto found = looked_into.find(*shell);
    const Enclosed enclosed = found != looked_into.end()
                                  ? found->second
                                  : looked_into[*shell] = look_into(context, *shell);
    if (enclosed.has_spheres_inside && !enclosed.has_spheres_outside) continue;
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
