#pragma once

#include <string>
#include <vector>

#include "render/math/color.hpp"
#include "render/scene/scene.hpp"
#include "tests/extremes/forms.hpp"
#include "tests/support/statistics/estimate.hpp"

/// Extreme scenes whose radiance is known in closed form.
namespace sdlc::test {

/// The radiance along the camera's axis.
struct ExtremeVariant {
  std::string what;  ///< the numbers: "radius 1e-8"
  render::Scene scene;
  int depth = 50;
  render::LinearRgb expected;
  int samples = 64;  ///< per pixel
};

struct ExtremeCase {
  std::string name;
  std::vector<ExtremeVariant> variants;
};

const std::vector<ExtremeCase>& extreme_cases();

/// The mean over a picture of 16 × 16 pixels so narrow that all see the same.
struct Measured {
  Estimate estimate;
  render::RenderResult result;
};
render::RenderSettings settings_of(const ExtremeVariant& variant);
Measured measure(const ExtremeVariant& variant, const Form& form);

}  // namespace sdlc::test
