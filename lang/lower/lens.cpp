#include "lang/lower/lens.hpp"

#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "lang/object/value.hpp"
#include "lang/schema/schema.hpp"
#include "render/math/power_of_two.hpp"

namespace sdlc::lang {
namespace {

using camera_property::kAperture;
using camera_property::kFocus;

/// The max diameter of a lens in units of its distance of focus: squares of larger numbers could
/// overflow.
constexpr double kMaxLens = 1e100;

/// The point in focus, and the sphere whose centre it is.
struct Target {
  render::Vec3 point;
  const NamedSphere* sphere = nullptr;
};

std::optional<Target> find_sphere(const Object& object, const std::string& name,
                                  const NamedSpheres& names, DiagnosticSink& sink) {
  const NamedSpheres::Found& found = names.find(name);
  if (found.count == 0) {
    if (!names.is_complete()) return std::nullopt;  // the sphere may be missing because of an error
    sink.report(diag::unknown_sphere, object.location(kFocus), name)
        .suggest(names.nearest(name))
        .help("`focus` takes a point, the name of one sphere or a distance");
    return std::nullopt;
  }
  if (found.count > 1) {
    auto report = sink.report(diag::ambiguous_sphere, object.location(kFocus), name, found.count);
    for (const NamedSphere& sphere : found.spheres) report.label(sphere.where, "one of them");
    report.help("give one of them a name of its own, or write the point: `focus: (x, y, z)`");
    return std::nullopt;
  }
  const NamedSphere& sphere = found.spheres.front();
  if (!sphere.center) return std::nullopt;  // reported
  const auto shutter = object.get<render::Interval>(camera_property::kShutter);
  return Target{sphere.opening(shutter), &sphere};
}

std::optional<Target> find_target(const Object& object, const NamedSpheres& names,
                                  DiagnosticSink& sink, const render::Camera& camera) {
  if (!object.slot(kFocus).is_written) return Target{camera.at};
  if (const auto point = object.get<render::Vec3>(kFocus)) return Target{*point};
  const auto name = object.get<Word>(kFocus);
  return name ? find_sphere(object, name->text, names, sink) : std::nullopt;
}

/// The distance of the plane in focus along the view axis.
std::optional<double> find_distance(const Object& object, const NamedSpheres& names,
                                    DiagnosticSink& sink, const render::Camera& camera) {
  if (const auto distance = object.get<double>(kFocus)) return distance;
  const auto target = find_target(object, names, sink, camera);
  if (!target) return std::nullopt;
  const render::Vec3 axis = unit(render::direction_between(camera.from, camera.at));
  const double distance = dot(target->point - camera.from, axis);
  if (distance > 0 || std::isnan(distance)) return distance;
  auto report = sink.report(diag::focus_behind_camera, object.location(kFocus));
  if (target->sphere != nullptr) {
    report.label(target->sphere->where,
                 fmt::format("its centre is at {}", to_text(Value(Triple{target->point}))));
  }
  report.help(fmt::format("the distance along the view axis is {:.4g}; it must be greater than 0",
                          distance));
  return std::nullopt;
}

}  // namespace

bool lower_lens(const Object& object, const NamedSpheres& names, DiagnosticSink& sink,
                render::Camera& camera) {
  const auto aperture = object.get<double>(kAperture);
  const auto focus = find_distance(object, names, sink, camera);
  if (!aperture || !focus) return false;
  if (object.slot(kFocus).is_written && !object.slot(kAperture).is_written) {
    sink.report(diag::no_effect, object.location(kFocus), "focus")
        .help("without an `aperture` everything is in focus");
  }
  camera.aperture = *aperture;
  camera.focus = *focus;
  if (*aperture == 0) return true;
  if (std::isfinite(*focus) && *aperture / *focus <= kMaxLens) return true;
  sink.report(diag::beyond_numbers, object.location(kAperture),
              "the distance in focus, or the lens divided by it,");
  return false;
}

}  // namespace sdlc::lang
