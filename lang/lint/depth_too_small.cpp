#include <algorithm>
#include <vector>

#include "lang/lint/sphere_tree.hpp"

namespace sdlc::lang {

/// A point inside k transmissive spheres, and no camera inside any of these: a path that passes
/// through it crosses each surface at least twice, in and out, and each crossing begins a new ray.
/// So it has at least 2 k + 1 rays, and if `depth` is less, all that is seen through the point is
/// black. The points looked at are the centres of transmissive spheres, at the opening of the
/// shutter; the one in most spheres is told.
void check_depth_too_small(LintContext& context) {
  if (context.is_part()) return;
  std::vector<std::uint32_t> members;
  for (std::uint32_t i = 0; i < context.spheres().size(); ++i) {
    if (!context.is_transmissive(i)) continue;
    const render::Sphere& sphere = context.spheres()[i];
    const auto& cameras = context.lowered().checked_cameras;
    constexpr std::size_t kMostCameras = 100;
    if (cameras.size() > kMostCameras) return;
    const bool is_around_camera = std::ranges::any_of(cameras, [&](const CheckedCamera& camera) {
      return length(camera.camera.from - sphere.center) <= sphere.radius * (1 + 0x1p-20);
    });
    if (!is_around_camera) members.push_back(i);
  }

  SphereTree tree(context, members);
  std::size_t most = 0;
  std::uint32_t innermost = 0;
  for (const std::uint32_t member : tree.members()) {
    const std::size_t count = tree.count_around(context.spheres()[member].center);
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
  Finding& finding = context.add(diag::depth_too_small, place, most, rays, depth);
  if (written.file != nullptr) {
    finding.labels.push_back({LintPlace::of_sphere(innermost), "the innermost"});
    finding.fixes.push_back({written, fmt::format("{}", rays), false});
  }
  finding.help.push_back(
      fmt::format("what is behind the innermost is black; `depth: {}` shows it", rays));
}

}  // namespace sdlc::lang
