#pragma once

#include <optional>
#include <string>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The range of depths, along the view axis, that a lens shows sharply.
struct DepthOfField {
  double from = 0;
  std::optional<double> to{};  ///< nullopt: everything behind `from` is sharp
};

/// "1.94 to 2.067", with 4 digits.
std::string describe(const DepthOfField& sharp);

/// The depths at which the blur of a point is at most `pixels` high, in a picture of `height` rows.
/// A thin lens of diameter a, focused at f, spreads a point at depth z over a disc of the diameter
/// a |1/f − 1/z| in the image plane at distance 1.
inline DepthOfField depth_of_field(const Camera& camera, int height, double pixels) noexcept {
  if (!camera.has_lens()) return {};
  const double blur = pixels * camera.plane_height / height / camera.aperture;
  const double sharpness = 1 / camera.focus;
  DepthOfField range{.from = 1 / (sharpness + blur)};
  if (sharpness > blur) range.to = 1 / (sharpness - blur);
  return range;
}

/// The nearest distance of focus with which everything behind it is sharp, to within a blur of
/// `pixels`: the hyperfocal distance.
inline double hyperfocal_distance(const Camera& camera, int height, double pixels) noexcept {
  return camera.aperture * height / (pixels * camera.plane_height);
}

}  // namespace sdlc::render
