#include <algorithm>
#include <vector>

#include "lang/lint/sphere_tree.hpp"

namespace sdlc::lang {

/// A point is inside k transmissive spheres that contain no camera. A path through the point
/// crosses each surface at least twice, in and out, and each crossing begins a new ray, so it has
/// at least 2 k + 1 rays. If `depth` is less, everything seen through the point is black. Checks
/// the centres of visible transmissive spheres at the opening of the shutter, and reports the
/// maximum of k.
void check_depth_too_small(LintContext& context) {
  const auto& cameras = context.lowered().checked_cameras;
  if (context.is_part() || cameras.size() > LintContext::kMaxCameras) return;
  std::vector<std::uint32_t> spheres = context.visible_transmissive();
  std::erase_if(spheres, [&](std::uint32_t i) {
    context.stop_if_requested();
    return std::ranges::any_of(cameras, [&](const CheckedCamera& camera) {
      return may_be_inside(context, camera.camera.from, i);
    });
  });

  SphereTree tree(context, spheres), occluders(context, context.occluders());
  std::size_t max_count = 0;
  std::uint32_t innermost = 0;
  for (const std::uint32_t sphere : tree.spheres()) {
    const render::Vec3 center = context.spheres()[sphere].center;
    if (occluders.count_containing(center) > 0) continue;
    const std::size_t count = tree.count_containing(center);
    if (count > max_count || (count == max_count && sphere < innermost)) {
      max_count = count;
      innermost = sphere;
    }
  }
  const std::size_t rays = 2 * max_count + 1;
  const int depth = context.lowered().settings.depth;
  if (rays <= static_cast<std::size_t>(depth)) return;
  const Location written = context.lowered().places.depth;
  const LintPlace place =
      written.file == nullptr ? LintPlace::of_sphere(innermost) : LintPlace::of(written);
  const bool is_one = max_count == 1;
  const std::string crossed =
      is_one ? "a transmissive sphere" : fmt::format("{} nested transmissive spheres", max_count);
  Finding& finding = context.add(diag::depth_too_small, place, crossed, rays, depth);
  if (written.file != nullptr) {
    finding.labels.push_back(
        {LintPlace::of_sphere(innermost), is_one ? "this one" : "the innermost"});
    finding.fixes.push_back({written, fmt::format("{}", rays), false});
  }
  finding.help.push_back(fmt::format("everything behind {} is black; `depth: {}` shows it",
                                     is_one ? "it" : "the innermost", rays));
}

}  // namespace sdlc::lang
