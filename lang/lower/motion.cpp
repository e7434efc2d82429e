#include "lang/lower/motion.hpp"

namespace sdlc::lang {

render::Vec3 center_at(const MotionValue& motion, render::Vec3 center, double time) noexcept {
  const double duration = motion.over.to - motion.over.from;
  return center + (motion.to - center) * ((time - motion.over.from) / duration);
}

void lower_motion(std::span<const MovingSphere> moving, render::Interval shutter,
                  DiagnosticSink& sink, std::vector<render::Sphere>& spheres,
                  std::vector<render::Vec3>& shifts) {
  for (const MovingSphere& each : moving) {
    const render::Interval over = each.motion.over;
    const double duration = over.to - over.from;
    const render::Vec3 path = each.motion.to - each.center;
    render::Vec3 opening = center_at(each.motion, each.center, shutter.from);
    render::Vec3 shift = path * ((shutter.to - shutter.from) / duration);
    if (each.groups) {
      const auto& [at_opening, at_closing] = *each.groups;
      const render::Vec3 closing = at_closing.apply(opening + shift);
      opening = at_opening.apply(opening);
      shift = closing - opening;
    }
    if (!is_finite(opening) || !is_finite(opening + shift)) {
      sink.report(diag::beyond_numbers, each.where, "the path of the motion");
      continue;
    }
    spheres[each.sphere].center = opening;
    shifts[each.sphere] = shift;
  }
}

}  // namespace sdlc::lang
