#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "tests/extremes/forms.hpp"
#include "tests/support/statistics/estimate.hpp"
#include "tests/support/statistics/scenes.hpp"

// Coincident spheres in a text: only the first one is kept.
namespace sdlc::test {
namespace {

using render::LinearRgb;
using render::RenderResult;
using render::RenderSettings;
using render::Scene;

constexpr RenderSettings kSettings{.width = 32, .height = 32, .samples = 16, .depth = 60};

Scene lowered(const std::string& spheres) {
  const lang::Document file(
      "test.scene",
      "scene 1\ncamera { from: (1, 2, 5), at: (0, 0, 0), fov: 30deg, aspect: 1 }\n" + spheres);
  lang::DiagnosticSink sink;
  auto scene = lang::compile(file, {}, sink);
  EXPECT_TRUE(scene);
  return std::move(scene->scene);
}

class Coincident : public testing::TestWithParam<Form> {};

TEST_P(Coincident, SpheresGiveThePictureOfTheFirstAlone) {
  const std::string diffuse = "material: diffuse(color: rgb(0.8, 0.4, 0.2))",
                    glass = "material: transmissive(color: rgb(0.9, 0.9, 0.8), ior: 1.5)",
                    metal = "material: specular(color: white, fuzz: 0.1)";
  const auto sphere = [](const std::string& center, const std::string& radius,
                         const std::string& material) {
    return fmt::format("sphere {{ center: {}, radius: {}, {} }}\n", center, radius, material);
  };
  for (const auto& [first, second] :
       {std::pair{diffuse, diffuse}, {glass, glass}, {diffuse, glass}, {glass, metal}}) {
    const std::string alone = sphere("(0, 0, 0)", "1", first);
    const auto expected = render_in(GetParam(), lowered(alone), kSettings).picture.pixels;
    for (const auto& [center, radius] : {std::pair{"(0, 0, 0)", "1"},
                                         {"(1e-13, 0, 0)", "1"},
                                         {"(0, -2e-13, 1e-13)", "1 - 3e-13"}}) {
      std::string many = alone;
      for (int i = 0; i < 5; ++i) many += sphere(center, radius, second);
      EXPECT_EQ(render_in(GetParam(), lowered(many), kSettings).picture.pixels, expected)
          << center << ", " << radius;
    }
  }
}

// Along the axis a ray hits 4 surfaces if none reflected; reflection, with any probability, does
// not change the mean: surfaces hit twice compensate for those not hit. H0: 5 rays per path.
// Significance 1e-4 each.
TEST_P(Coincident, ShellsOfAnyThicknessAreMetFourTimes) {
  for (const double gap : {0.01, 1e-4, 1e-6, 1e-9, 1e-11}) {
    Scene scene = beam_scene({0, 0, 4}, {0, 0, 0}, LinearRgb{1});
    scene.camera.plane_height = 2e-4;
    add_sphere(scene, {0, 0, 0}, 1, transmissive({1, 1, 1}, 1.5));
    add_sphere(scene, {0, 0, 0}, 1 - gap, transmissive({1, 1, 1}, 1 / 1.5));
    RenderSettings settings{.width = 8, .height = 8, .samples = 256, .depth = 1000, .threads = 1};
    if (!may_trace(GetParam(), scene, settings)) continue;
    EstimateBuilder rays;
    for (std::uint64_t seed = 0; seed < 32; ++seed) {
      settings.seed = seed;
      const RenderResult result = render_in(GetParam(), scene, settings);
      EXPECT_EQ(result.truncated_paths, 0u);
      rays.add(
          LinearRgb{static_cast<double>(result.rays) / static_cast<double>(result.camera_samples)});
    }
    EXPECT_TRUE(agrees(rays.estimate(), LinearRgb{5})) << "gap " << gap;
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, Coincident, testing::ValuesIn(all_forms()), form_name);

}  // namespace
}  // namespace sdlc::test
