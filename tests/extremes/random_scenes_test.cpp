#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "tests/extremes/forms.hpp"
#include "tests/support/statistics/estimate.hpp"
#include "tests/support/statistics/scenes.hpp"

// Random scenes: spheres of many sizes that touch, cross, contain and nearly coincide with each
// other, seen from anywhere, some of them moving. Every kernel and precision that supports one must
// agree with the scalar kernel.
namespace sdlc::test {
namespace {

using render::LinearRgb;
using render::RenderResult;
using render::RenderSettings;
using render::Scene;
using render::Vec3;

class SceneMaker {
 public:
  explicit SceneMaker(std::uint64_t seed) : random_(seed) {}

  Scene make() {
    Scene scene;
    const double scale = std::pow(10, uniform(-6, 6));
    scene.background = {};
    if (chance(0.3)) scene.background = {.bottom = color(), .top = color()};
    const int count = static_cast<int>(uniform(1, 8));
    if (chance(0.5)) {  // a ground below the origin
      const double radius = scale * std::pow(10, uniform(0.5, 7));
      add_sphere(scene, {0, -radius, 0}, radius, material());
    }
    for (int i = 0; i < count; ++i) add_next(scene, scale);
    scene.camera.from = direction() * (scale * std::pow(10, uniform(-1, 2)));
    scene.camera.from.y = std::fabs(scene.camera.from.y);
    if (chance(0.2)) {  // on or next to a surface
      const render::Sphere& sphere = scene.spheres[pick(scene)];
      scene.camera.from =
          sphere.center +
          direction() * (sphere.radius * (chance(0.5) ? 1 : 1 + uniform(-0.01, 0.01)));
    }
    scene.camera.at = scene.spheres[pick(scene)].center + direction() * (0.1 * scale);
    if (scene.camera.at == scene.camera.from) scene.camera.at.x += scale;
    scene.camera.up = unit(Vec3{0.1, 1, 0.05});
    scene.camera.plane_height = std::pow(10, uniform(-3, 1));
    scene.camera.aspect = std::pow(10, uniform(-1, 1));
    if (chance(0.25)) {
      for (const render::Sphere& sphere : scene.spheres) {
        scene.shifts.push_back(chance(0.5) ? Vec3{}
                                           : direction() * (sphere.radius * uniform(0, 3)));
      }
    }
    return scene;
  }

 private:
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  bool chance(double p) { return uniform(0, 1) < p; }
  Vec3 direction() {
    Vec3 v;
    do {
      v = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    } while (length_squared(v) > 1 || length_squared(v) < 0.01);
    return unit(v);
  }
  LinearRgb color() { return {uniform(0, 1), uniform(0, 1), uniform(0, 1)}; }
  std::size_t pick(const Scene& scene) {
    return static_cast<std::size_t>(uniform(0, static_cast<double>(scene.spheres.size())));
  }

  render::Material material() {
    const double kind = uniform(0, 1);
    if (kind < 0.4) return diffuse(color());
    if (kind < 0.55) return specular(color(), chance(0.5) ? 0 : uniform(0, 1.5));
    if (kind < 0.9) {
      return transmissive(color(), std::pow(2.5, uniform(-1, 1)),
                          chance(0.3) ? render::Fresnel::Exact : render::Fresnel::Schlick);
    }
    return emissive(color(), std::pow(10, uniform(-1, 1)));
  }

  void add_next(Scene& scene, double scale) {
    const double radius = scale * std::pow(10, uniform(-2, 0.3));
    if (scene.spheres.empty() || chance(0.3)) {
      return add_sphere(scene, direction() * (scale * uniform(0, 4)), radius, material());
    }
    const render::Sphere other = scene.spheres[pick(scene)];
    const Vec3 way = direction();
    const double sliver = other.radius * std::pow(10, uniform(-7, -0.5));
    switch (static_cast<int>(uniform(0, 6))) {
      case 0:  // touches from outside, or nearly
        return add_sphere(scene,
                          other.center + way * (other.radius + radius + (chance(0.5) ? 0 : sliver)),
                          radius, material());
      case 1:  // a thin shell
        return add_sphere(scene, other.center, other.radius - sliver, material());
      case 2:  // touches from inside
        return add_sphere(scene, other.center + way * sliver, other.radius - sliver, material());
      case 3:  // crosses, or nearly coincides
        return add_sphere(scene, other.center + way * sliver, other.radius, material());
      case 4:  // crosses
        return add_sphere(scene, other.center + way * other.radius, radius, material());
      default:  // somewhere inside
        return add_sphere(scene, other.center + way * (other.radius * uniform(0, 0.5)),
                          other.radius * uniform(0.05, 0.5), material());
    }
  }

  std::mt19937_64 random_;
};

// H0: the same expectation. Both trace the same paths, which diverge where rounding decides
// differently; the pictures differ in those, by differences of mean 0. With few of them the
// distribution is not normal, so the limit is generous: 7 standard errors.
TEST(RandomScenes, LookTheSameInAllKernelsThatTakeThem) {
  int scenes = 40;
  if (const char* more = std::getenv("SDLC_SCENES")) scenes = std::atoi(more);
  int first = 0;
  if (const char* seed = std::getenv("SDLC_FIRST")) first = std::atoi(seed);
  const RenderSettings settings{
      .width = 32, .height = 32, .samples = 32, .depth = 12, .threads = 1};
  std::map<std::string, int> traced;
  for (int i = first; i < first + scenes; ++i) {
    const Scene scene = SceneMaker(static_cast<std::uint64_t>(i)).make();
    if (!judge_precision(scene, scene.camera, settings, render::Precision::Double).is_accepted()) {
      continue;
    }
    const RenderResult expected = render_in(Form{}, scene, settings);
    EXPECT_EQ(expected.nonfinite_samples, 0u) << "scene " << i;
    for (const Form& form : all_forms()) {
      if (form.is_scalar() || !may_trace(form, scene, settings)) continue;
      const RenderResult result = render_in(form, scene, settings);
      ++traced[name_of(form) + " " + std::string(name_of(result.kernel.precision))];
      EXPECT_EQ(result.nonfinite_samples, 0u) << "scene " << i;
      EstimateBuilder differences, whole;
      for (std::size_t k = 0; k < result.picture.pixels.size(); ++k) {
        differences.add(result.picture.pixels[k] - expected.picture.pixels[k]);
        whole.add(expected.picture.pixels[k]);
      }
      const Estimate estimate = differences.estimate();
      const LinearRgb size = whole.estimate().mean;
      // Float rounds colours to 1e-7, along a path a few times.
      const double rounding = form.precision == render::Precision::Float ? 2e-6 : 1e-9;
      const auto is_noise = [&](double mean, double error, double value) {
        return std::fabs(mean) <= 7 * error + rounding * (1 + value);
      };
      EXPECT_TRUE(is_noise(estimate.mean.r, estimate.standard_error.r, size.r) &&
                  is_noise(estimate.mean.g, estimate.standard_error.g, size.g) &&
                  is_noise(estimate.mean.b, estimate.standard_error.b, size.b))
          << "scene " << i << ", " << name_of(form) << " (" << name_of(result.kernel.precision)
          << "): " << estimate.mean.r << " " << estimate.mean.g << " " << estimate.mean.b
          << ", standard error " << estimate.standard_error.r;
    }
  }
  for (const auto& [form, count] : traced) RecordProperty(form, count);
  for (const Form& form : all_forms()) {
    if (form.is_scalar()) continue;
    const bool is_double = form.precision == render::Precision::Double;
    EXPECT_GT(traced[name_of(form) + (is_double ? " double" : " mixed")], 0) << name_of(form);
    EXPECT_TRUE(is_double || traced[name_of(form) + " float"] > 0) << name_of(form);
  }
  if (std::getenv("SDLC_SCENES") != nullptr) {
    for (const auto& [form, count] : traced) std::printf("%s: %d\n", form.c_str(), count);
  }
}

}  // namespace
}  // namespace sdlc::test
