#include "lang/lower/camera.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/lower/lens.hpp"
#include "lang/schema/schema.hpp"
#include "lang/text/nearest_name.hpp"
#include "render/math/interval.hpp"
#include "render/math/power_of_two.hpp"
#include "render/math/sincos.hpp"

namespace sdlc::lang {
namespace {

/// Tangent of half an angle in (0°, 180°).
double tan_half(Angle angle) {
  const render::SinCos half = render::sincos_turns(angle.degrees / 720);
  return half.sin / half.cos;
}

/// The max side of a view plane at distance 1: squares of longer sides could overflow.
constexpr double kMaxPlane = 1e100;

bool are_parallel(render::Vec3 a, render::Vec3 b) {
  // Below this the cross product, and so the picture's horizon, is only rounding error.
  constexpr double kMinSine = 0x1p-40;
  a = render::with_moderate_length(a);
  b = render::with_moderate_length(b);
  return length(cross(a, b)) <= kMinSine * length(a) * length(b);
}

void report_unknown_camera(const WantedSettings& wanted, const std::string& name,
                           std::span<const Object> cameras) {
  std::vector<std::string_view> names;
  for (const Object& camera : cameras) names.push_back(camera.name);
  const auto nearest = nearest_name(name, names);
  std::erase(names, "");
  const std::string all =
      names.empty() ? "" : fmt::format("cameras of the scene: {}", fmt::join(names, ", "));
  // A name from the command line has no location.
  const bool is_by_flag = wanted.overrides.has(render_property::kCamera);
  const Location where = is_by_flag ? Location{} : wanted.place(render_property::kCamera);
  auto report = wanted.sink.report(diag::unknown_camera, where, name);
  if (is_by_flag) {
    if (nearest) report.help(fmt::format("did you mean `{}`?", *nearest));
    report.help_if(all);
    return;
  }
  report.suggest(nearest).help_if(all);
  if (!nearest) return;
  const auto named = std::ranges::find(cameras, *nearest, &Object::name);
  report.label(named->where, fmt::format("`{}` is declared here", *nearest));
}

}  // namespace

const Object* choose_camera(const WantedSettings& wanted, std::span<const Object> cameras,
                            bool takes_any) {
  using render_property::kCamera;
  const auto named = wanted.get<Word>(kCamera);
  if (!named && wanted.is_written(kCamera)) return nullptr;  // invalid, and reported
  if (named && !named->text.empty()) {
    const auto found = std::ranges::find(cameras, named->text, &Object::name);
    if (found != cameras.end()) return &*found;
    report_unknown_camera(wanted, named->text, cameras);
    return nullptr;
  }
  if (cameras.empty()) return nullptr;
  if (cameras.size() == 1 || takes_any) return &cameras.front();
  wanted.sink.report(diag::ambiguous_camera, cameras[1].where, static_cast<int>(cameras.size()))
      .label(cameras[0].where, "the first camera")
      .help("choose one with --camera NAME or `render { camera: NAME }`");
  return nullptr;
}

std::optional<LoweredCamera> lower_camera(const Object& object, SourceFormat format,
                                          const NamedSpheres& names, DiagnosticSink& sink) {
  using namespace camera_property;
  const auto from = object.get<render::Vec3>(kFrom);
  const auto at = object.get<render::Vec3>(kAt);
  const auto up = object.get<render::Vec3>(kUp);
  const auto fov = object.get<Angle>(kFov);
  const auto view_height = object.get<double>(kViewHeight);
  const auto aspect = object.get<double>(kAspect);
  // Missing values have been reported; check the others anyway.
  const bool has_view = from && at;
  const render::Vec3 view = has_view ? render::direction_between(*from, *at) : render::Vec3{};
  if (has_view && view == render::Vec3{}) {
    sink.report(diag::no_view_direction, object.location(kAt), property_name(object, kFrom, format),
                property_name(object, kAt, format))
        .label(object.location(kFrom), "the camera is here");
    return std::nullopt;
  }
  const Location up_place =
      object.slot(kUp).is_written ? object.location(kUp) : object.location(kAt);
  if (up && *up == render::Vec3{}) {
    sink.report(diag::no_up_direction, up_place, "is zero")
        .help("`up` is the direction that points up in the picture, such as (0, 1, 0)");
    return std::nullopt;
  }
  if (has_view && up && are_parallel(view, *up)) {
    sink.report(diag::no_up_direction, up_place, "is parallel to the view direction")
        .help(
            "choose an `up` that is not parallel to the line from the camera to the point it "
            "looks at, such as (0, 0, 1)");
    return std::nullopt;
  }
  if (!has_view || !up || !fov || !view_height || !aspect) return std::nullopt;
  const double plane_height = *view_height * tan_half(*fov);
  if (!(plane_height * std::max(1.0, *aspect) <= kMaxPlane)) {
    sink.report(diag::beyond_numbers, object.where, "the width or height of the view plane");
    return std::nullopt;
  }
  render::Camera camera{
      .from = *from, .at = *at, .up = *up, .plane_height = plane_height, .aspect = *aspect};
  if (!lower_lens(object, names, sink, camera)) return std::nullopt;
  return LoweredCamera{.camera = camera,
                       .written = {.name = object.name,
                                   .fov = *fov,
                                   .view_height = *view_height,
                                   .shutter = object.get<render::Interval>(kShutter),
                                   .aperture = written_location(object, kAperture)}};
}

Location written_location(const Object& object, std::size_t property) {
  return object.slot(property).is_written ? object.location(property) : Location{};
}

std::string_view property_name(const Object& object, std::size_t property, SourceFormat format) {
  if (format == SourceFormat::Json) {
    const std::string_view key = json_key_of(*object.kind, property);
    if (!key.empty()) return key;
  }
  return object.kind->properties[property].name;
}

}  // namespace sdlc::lang
