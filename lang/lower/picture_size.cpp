#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lang/lower/settings.hpp"
#include "lang/schema/schema.hpp"
#include "render/image/picture.hpp"

namespace sdlc::lang {
namespace {

using namespace render_property;

struct Size {
  double width = 0, height = 0;
};

/// The size of the picture, in pixels. A flag takes precedence over both written sides. A missing
/// side follows from the other one and the ratio width / height: that of the written sides if both
/// are written, else `aspect`. Without any side, the width is the default.
Size choose_size(const WantedSettings& wanted, std::optional<double> width,
                 std::optional<double> height, double aspect) {
  const bool has_both = width && height;
  const double proportion = has_both ? *width / *height : aspect;
  const auto width_of = [&](double rows) { return std::max(1.0, std::round(rows * proportion)); };
  const auto height_of = [&](double columns) {
    // Multiply first: a product of whole numbers is exact below 2^53, and the floor of its quotient
    // is then exact too.
    return std::floor(has_both ? columns * *height / *width : columns / proportion);
  };
  const auto wide = wanted.overrides.get<double>(kWidth);
  const auto high = wanted.overrides.get<double>(kHeight);
  if (wide && high) return {*wide, *high};
  if (high) return {width_of(*high), *high};
  if (wide) return {*wide, height_of(*wide)};
  if (has_both) return {*width, *height};
  if (height) return {width_of(*height), *height};
  const double default_width = wanted.render.get<double>(kWidth).value_or(0);
  return {default_width, height_of(default_width)};
}

}  // namespace

void lower_size(const WantedSettings& wanted, const Object* camera, LoweredScene& lowered) {
  std::optional<double> width;
  if (wanted.is_written(kWidth)) width = wanted.render.get<double>(kWidth);
  const auto height = wanted.render.get<double>(kHeight);
  lowered.settings.width = lowered.settings.height = 0;
  // An invalid side or camera has been reported: the size stays unknown, because one computed
  // without it would be wrong.
  const bool lacks_width = wanted.is_written(kWidth) && !width;
  const bool lacks_height = wanted.is_written(kHeight) && !height;
  const bool lacks_camera = !lowered.camera && wanted.sink.has_errors();
  if (lacks_width || lacks_height || lacks_camera) return;

  const bool has_aspect = camera != nullptr && camera->slot(camera_property::kAspect).is_written;
  double& aspect = lowered.scene.camera.aspect;
  if (width && height && !has_aspect) aspect = *width / *height;
  const Size size = choose_size(wanted, width, height, aspect);
  if (wanted.overrides.has(kWidth) && wanted.overrides.has(kHeight)) {
    aspect = size.width / size.height;
  }

  const Location whole_file{&wanted.file, {0, 0}};
  if (size.height < 1) {
    Location where = has_aspect ? camera->location(camera_property::kAspect) : whole_file;
    if (width) where = wanted.place(kWidth);
    const double proportion = width && height ? *width / *height : aspect;
    wanted.sink.report(diag::no_rows, where, static_cast<int>(size.width), to_text(proportion))
        .help(
            "the height is width / aspect, rounded down; increase the width or reduce the aspect");
  } else if (!(size.width * size.height <= static_cast<double>(render::kMaxPicturePixels))) {
    wanted.sink
        .report(diag::picture_too_large, width ? wanted.place(kWidth) : whole_file,
                fmt::format("{:.0f}", size.width), fmt::format("{:.0f}", size.height))
        .help(fmt::format("the limit is {} pixels", render::kMaxPicturePixels));
  } else {
    lowered.settings.width = static_cast<int>(size.width);
    lowered.settings.height = static_cast<int>(size.height);
  }
}

}  // namespace sdlc::lang
