#include "lang/lower/checks.hpp"

#include <cstddef>

#include "lang/lower/camera.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {

std::vector<CheckedCamera> check_cameras(std::span<const Object> cameras, SourceFormat format,
                                         const NamedSpheres& names, DiagnosticSink& sink) {
  using namespace camera_property;
  std::vector<CheckedCamera> checked;
  for (const Object& declared : cameras) {
    const auto lowered = lower_camera(declared, format, names, sink);
    if (!lowered) continue;
    checked.push_back({.name = declared.name,
                       .camera = lowered->camera,
                       .shutter = lowered->written.shutter,
                       .from = declared.location(kFrom),
                       .aspect = written_location(declared, kAspect),
                       .aperture = written_location(declared, kAperture),
                       .focus = written_location(declared, kFocus)});
  }
  return checked;
}

WrittenPlaces find_places(const WantedSettings& wanted, const Object* background) {
  using namespace render_property;
  return {.background = background != nullptr ? background->where : Location{},
          .width = wanted.place(kWidth),
          .height = wanted.place(kHeight),
          .samples = wanted.place(kSamples),
          .depth = wanted.place(kDepth),
          .precision = wanted.place(kPrecision),
          .error = wanted.place(kError),
          .output = wanted.place(kOutput)};
}

GroupPath GroupPath::around(const GroupPath& inner) const {
  return {.halfway = halfway.around(inner.halfway), .is_turning = is_turning || inner.is_turning};
}

double sagitta_of(const Placing& group, const GroupPath& path, render::Vec3 opening,
                  render::Vec3 closing) {
  const render::Vec3 from = group.placements[0].apply(opening);
  const render::Vec3 to = group.placements[1].apply(closing);
  const render::Vec3 middle = path.halfway.apply((opening + closing) * 0.5);
  return length(middle - (from + to) * 0.5);
}

void renumber(std::span<const render::CoincidentSphere> dropped, std::vector<BentPath>& paths) {
  std::size_t next = 0;
  std::erase_if(paths, [&](BentPath& path) {
    while (next < dropped.size() && dropped[next].sphere < path.sphere) ++next;
    const bool is_dropped = next < dropped.size() && dropped[next].sphere == path.sphere;
    path.sphere -= static_cast<std::uint32_t>(next);
    return is_dropped;
  });
}

}  // namespace sdlc::lang
