#include <algorithm>

#include "lang/lint/context.hpp"
#include "render/math/power_of_two.hpp"
#include "render/scene/bounding_sphere.hpp"
#include "render/scene/depth_of_field.hpp"
#include "render/scene/instances.hpp"

namespace sdlc::lang {
namespace {

/// The max blur of what is in focus, as the diameter in pixels.
constexpr double kSharp = 4;

/// Whether the sphere, at some time of the shutter, has a point within these depths.
bool reaches(const render::Sphere& sphere, render::Vec3 shift, const render::Camera& camera,
             const render::DepthOfField& sharp) {
  const render::Vec3 axis = unit(render::direction_between(camera.from, camera.at));
  const double opening = dot(sphere.center - camera.from, axis);
  const double closing = opening + dot(shift, axis);
  return std::max(opening, closing) + sphere.radius >= sharp.from &&
         (!sharp.to || std::min(opening, closing) - sphere.radius <= *sharp.to);
}

/// Instances count by their bounding spheres: what is reported is certain.
bool has_any(const LintContext& context, const render::Camera& camera,
             const render::DepthOfField& sharp) {
  for (std::uint32_t i = 0; i < context.spheres().size(); ++i) {
    context.stop_if_requested();
    if (reaches(context.spheres()[i], context.shift_of(i), camera, sharp)) return true;
  }
  const auto all_bounds = render::bounding_spheres(context.scene().prototypes);
  return std::ranges::any_of(context.scene().instances, [&](const render::Instance& instance) {
    context.stop_if_requested();
    const render::BoundingSphere& bounds = all_bounds[instance.prototype];
    const render::Sphere around = placed(instance, {bounds.center, bounds.radius, 0});
    return reaches(around, instance.shift, camera, sharp);
  });
}

}  // namespace

/// The camera has a lens, and no sphere reaches into the depths at which the blur of a point is at
/// most 4 pixels wide (depth_of_field): even the sharpest surface is visibly blurred. Images in
/// mirrors do not count. Checks at most kMaxCameras cameras, and only if the size of the picture is
/// known.
void check_nothing_in_focus(LintContext& context) {
  const auto& cameras = context.lowered().checked_cameras;
  const int height = context.lowered().settings.height;
  if (height <= 0 || render::count_spheres(context.scene()) == 0) return;
  for (std::size_t k = 0; k < std::min(cameras.size(), LintContext::kMaxCameras); ++k) {
    const CheckedCamera& checked = cameras[k];
    if (!checked.camera.has_lens()) continue;
    const auto sharp = render::depth_of_field(checked.camera, height, kSharp);
    if (has_any(context, checked.camera, sharp)) continue;
    const bool is_written = checked.focus.file != nullptr;
    Finding& finding =
        context.add(diag::nothing_in_focus,
                    LintPlace::of(is_written ? checked.focus : checked.aperture), describe(sharp));
    finding.help.push_back("focus on a sphere by its name, or choose a smaller `aperture`");
  }
}

}  // namespace sdlc::lang
