#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "tests/support/statistics/estimate.hpp"
#include "tests/support/statistics/scenes.hpp"

namespace sdlc::test {
namespace {

/// A sphere of radius 1 that moves from x = −2 to x = 2 within the time from 0 to 1, seen along the
/// z axis: it covers the axis from t = 1/4 to t = 3/4.
render::Scene passing_sphere(const std::string& shutter) {
  const lang::Document file("test.json", fmt::format(R"({{
    "background": [0, 0, 0],
    "camera": {{"look_from": [0, 0, 5], "look_at": [0, 0, 0], "up": [0, 1, 0], "vfov": 1, "focal_length": 1,
                "aspect_ratio": 1, "viewport_height": 1, "samples_per_pixel": 1, "time_interval": {}}},
    "rendering": {{"width": 1, "render_depth": 1}}, "saving": {{}},
    "spheres": [{{"origin": [-2, 0, 0], "radius": 1, "material": {{"type": "no_texture", "color": [255, 255, 255]}},
                  "movement": [[2, 0, 0], 0, 1]}}]}})",
                                                     shutter));
  lang::DiagnosticSink sink;
  auto lowered = lang::compile(file, {}, sink);
  EXPECT_TRUE(lowered);
  return std::move(lowered->scene);
}

// H0: the share of the shutter interval during which the axis is covered. Significance 1e-4 each.
TEST(MovingSphere, CoversItsShareOfTheShutter) {
  const std::pair<const char*, double> cases[] = {
      {"[0, 1]", 0.5},   {"[0.5, 0.5]", 1},   {"[1, 3]", 0},   {"[-1, 0]", 0},
      {"[0, 0.5]", 0.5}, {"[0, 100]", 0.005}, {"[1, 0]", 0.5}, {"null", 0}};
  for (const auto& [shutter, share] : cases) {
    const Estimate estimate =
        radiance_along_axis(passing_sphere(shutter), {.depth = 1, .samples = 1 << 17});
    EXPECT_TRUE(agrees(estimate, render::LinearRgb{share})) << "shutter " << shutter;
  }
}

}  // namespace
}  // namespace sdlc::test
