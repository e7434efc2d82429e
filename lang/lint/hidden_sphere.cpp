#include <algorithm>
#include <vector>

#include "lang/lint/sphere_tree.hpp"

namespace sdlc::lang {
namespace {

using render::Vec3;

/// Whether the camera may see the sphere's inside: at some moment it is in it, or nearly so.
bool may_look_into(const LintContext& context, std::uint32_t index, Vec3 from) {
  const render::Sphere& sphere = context.spheres()[index];
  const double way = length(context.shift_of(index));
  return !(length(from - sphere.center) > (sphere.radius + way) * (1 + 0x1p-20));
}

}  // namespace

/// Sphere a is wholly inside sphere b, and b's surface is not transmissive: |a − b| + radius of a
/// ≤ radius of b, less a margin for rounding, at both ends of the shutter, and so between them, the
/// distance of two centres that move straight being a convex function of the time. No path from a
/// camera outside of b gets into b. Spheres with a camera inside, or nearly, are no such b. Of a
/// film it is claimed if it is so in the first and the last frame.
void check_hidden_sphere(LintContext& context) {
  if (context.is_part()) return;  // a room for others to look into
  constexpr std::size_t kMostCameras = 100;
  const auto& cameras = context.lowered().checked_cameras;
  if (cameras.size() > kMostCameras) return;
  std::vector<std::uint32_t> opaque;
  for (std::uint32_t i = 0; i < context.spheres().size(); ++i) {
    const bool is_open = std::ranges::any_of(cameras, [&](const CheckedCamera& camera) {
      return may_look_into(context, i, camera.camera.from);
    });
    if (!context.is_transmissive(i) && !is_open) opaque.push_back(i);
  }

  SphereTree tree(context, opaque);
  std::size_t findings = 0;
  std::vector<std::uint32_t> order = tree.members();
  std::vector<bool> is_member(context.spheres().size());
  for (const std::uint32_t member : order) is_member[member] = true;
  for (std::uint32_t i = 0; i < is_member.size(); ++i) {
    if (!is_member[i]) order.push_back(i);
  }
  for (const std::uint32_t i : order) {
    const auto around = tree.find_around(i);
    if (!around) continue;
    const render::Sphere &inner = context.spheres()[i], &outer = context.spheres()[*around];
    Finding& finding = context.add(diag::hidden_sphere, LintPlace::of_sphere(i));
    finding.labels.push_back({LintPlace::of_sphere(*around), "inside this one"});
    finding.help.push_back(fmt::format(
        "the centres are {:.4g} apart; that and the radius {:.4g} are less than the radius {:.4g}",
        length(inner.center - outer.center), inner.radius, outer.radius));
    if (++findings == LintContext::kMostFindings) return;
  }
}

}  // namespace sdlc::lang
