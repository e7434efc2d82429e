#include <algorithm>
#include <vector>

#include "lang/lint/sphere_tree.hpp"

namespace sdlc::lang {

/// A point inside k transmissive spheres, and no camera inside any of these: a path that passes
/// through it crosses each surface at least twice, in and out, and each crossing begins a new ray.
/// So it has at least 2 k + 1 rays, and if `depth` is less, all that is seen through the point is
/// black. The points looked at are the centres of transmissive spheres, at the opening of the
/// shutter, but for those that opaque spheres hide; the one in most spheres is told.
void check_depth_too_small(LintContext& context) {
  const auto& cameras = context.lowered().checked_cameras;
  if (context.is_part() || cameras.size() > LintContext::kMostCameras) return;
  std::vector<std::uint32_t> members;
  for (std::uint32_t i = 0; i < context.spheres().size(); ++i) {
    context.stop_if_requested();
    if (!context.is_transmissive(i) || context.is_hidden(i)) continue;
    const bool is_around_camera = std::ranges::any_of(cameras, [&](const CheckedCamera& camera) {
      return may_be_inside(context, camera.camera.from, i);
    });
    if (!is_around_camera) members.push_back(i);
  }

  SphereTree tree(context, members), closed(context, context.closed());
  std::size_t most = 0;
  std::uint32_t innermost = 0;
  for (const std::uint32_t member : tree.members()) {
    const render::Vec3 center = context.spheres()[member].center;
    if (closed.count_around(center) > 0) continue;
    const std::size_t count = tree.count_around(center);
    if (count > most || (count == most && member < innermost)) {
      most = count;
      innermost = member;
    }
  }
  const std::size_t rays = 2 * most + 1;
  const int depth = context.lowered().settings.depth;
  if (rays <= static_cast<std::size_t>(depth)) return;
  const Location written = context.lowered().places.depth;
  const LintPlace place =
      written.file == nullptr ? LintPlace::of_sphere(innermost) : LintPlace::of(written);
  const std::string spheres =
      most == 1 ? "a transmissive sphere" : fmt::format("{} nested transmissive spheres", most);
  Finding& finding = context.add(diag::depth_too_small, place, spheres, rays, depth);
  if (written.file != nullptr) {
    finding.labels.push_back(
        {LintPlace::of_sphere(innermost), most == 1 ? "this one" : "the innermost"});
    finding.fixes.push_back({written, fmt::format("{}", rays), false});
  }
  finding.help.push_back(fmt::format("what is behind {} is black; `depth: {}` shows it",
                                     most == 1 ? "it" : "the innermost", rays));
}

}  // namespace sdlc::lang
