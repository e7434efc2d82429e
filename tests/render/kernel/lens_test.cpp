#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/kernel/tracer.hpp"
#include "render/scene/digest.hpp"
#include "render/session/render.hpp"
#include "tests/render/kernel/kernels.hpp"
#include "tests/support/reference/path_tracer.hpp"
#include "tests/support/statistics/scaled_scene.hpp"
#include "tests/support/statistics/scenes.hpp"

// Depth of field: the thin lens against its equation, against a lens of another construction
// (rejection sampling of the disc, in tests/support/reference), and in all kernels.
namespace sdlc::test {
namespace {

using render::Kernel;
using render::KernelRequest;
using render::LightSampling;
using render::LinearRgb;
using render::Precision;
using render::RenderResult;
using render::RenderSettings;
using render::SamplerKind;
using render::Scene;
using render::Search;
using render::Vec3;

/// All materials, a lamp and a ground, mostly out of focus. A large ground is computed in double
/// when the rest is float.
Scene blurred_room(double ground = 50, bool has_motion = false) {
  Scene scene = beam_scene({0, 1, 4}, {0, 0, 0}, LinearRgb{0.4});
  scene.camera.aspect = 1.5;
  scene.camera.plane_height = 1;
  scene.camera.aperture = 0.5;
  scene.camera.focus = 3;
  add_sphere(scene, {0, -ground - 0.5, 0}, ground, diffuse({0.5, 0.6, 0.3}));
  add_sphere(scene, {-1, 0, 0}, 0.5, specular({0.8, 0.8, 0.6}, 0.2));
  add_sphere(scene, {0, 0, 1}, 0.5, transmissive({1, 0.9, 1}, 1.5));
  add_sphere(scene, {1, 0, -2}, 0.5, diffuse({0.9, 0.2, 0.1}));
  add_sphere(scene, {0, 3, 0}, 1, emissive({1, 0.9, 0.8}, 2));
  if (has_motion) {
    scene.shifts.assign(scene.spheres.size(), Vec3{});
    scene.shifts[3] = {0.25, 0.5, 0};
  }
  return scene;
}

double brightness(LinearRgb c) { return (c.r + c.g + c.b) / 3; }

/// The mean of each pixel and the variance of that mean, from independent pictures.
struct PixelMeans {
  static constexpr int kRuns = 16;
  std::vector<double> mean, variance;

  template <typename Render>
  static PixelMeans of(RenderSettings settings, const Render& render) {
    std::vector<double> sums, squares;
    for (int run = 0; run < kRuns; ++run) {
      settings.seed += 1000;
      const RenderResult result = render(settings);
      sums.resize(result.picture.pixels.size());
      squares.resize(sums.size());
      for (std::size_t i = 0; i < sums.size(); ++i) {
        const double value = brightness(result.picture.pixels[i]);
        sums[i] += value, squares[i] += value * value;
      }
    }
    PixelMeans means;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const double mean = sums[i] / kRuns;
      means.mean.push_back(mean);
      means.variance.push_back((squares[i] / kRuns - mean * mean) / (kRuns - 1));
    }
    return means;
  }
};

/// Hypothesis: both have the same expectation in every pixel. Student's t has about 30 degrees of
/// freedom; over 384 pixels |t| exceeds 6.5 with a probability of 1e-4, and the mean of t² (1.07
/// with a standard deviation of 0.09) exceeds 1.45 with less than that.
void expect_same_means(const PixelMeans& a, const PixelMeans& b, const std::string& what) {
  double squares = 0, largest = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.mean.size(); ++i) {
    const double variance = a.variance[i] + b.variance[i];
    if (variance < 1e-14) {  // of one colour: rounding decides
      EXPECT_NEAR(a.mean[i], b.mean[i], 1e-5) << what << ", pixel " << i;
      continue;
    }
    const double t = (a.mean[i] - b.mean[i]) / std::sqrt(variance);
    squares += t * t;
    largest = std::max(largest, std::fabs(t));
    ++count;
  }
  EXPECT_LT(largest, 6.5) << what;
  EXPECT_LT(squares / static_cast<double>(count), 1.45) << what;
}

constexpr RenderSettings kSmall{.width = 24, .height = 16, .samples = 64, .depth = 6, .seed = 3};

RenderSettings with_samples(int samples) {
  RenderSettings settings = kSmall;
  settings.samples = samples;
  return settings;
}

PixelMeans reference_of(const Scene& scene) {
  RenderSettings settings = kSmall;
  settings.sampler = SamplerKind::Independent;
  settings.light_sampling = LightSampling::Off;
  settings.seed = 900'000;
  return PixelMeans::of(settings,
                        [&](const RenderSettings& s) { return render_by_reference(scene, s); });
}

std::vector<KernelRequest> all_requests() {
  std::vector<KernelRequest> requests;
  for (const Search search : {Search::All, Search::Bvh}) {
    requests.push_back({.search = search, .backend = &render::portable_backend()});
    for (const WideForm& form : wide_forms()) {
      requests.push_back({.search = search, .precision = form.precision, .backend = form.backend});
    }
  }
  return requests;
}

std::string name_of_request(const KernelRequest& request) {
  const bool tests_all = request.search == Search::All;
  return std::string(request.backend->name) + (tests_all ? ", all, " : ", bvh, ") +
         (request.precision ? std::string(name_of(*request.precision)) : "double");
}

class LensOfAnotherConstruction : public testing::TestWithParam<bool> {};

TEST_P(LensOfAnotherConstruction, HasTheSamePixelsInAllKernels) {
  for (const double ground : {50.0, 1e4}) {
    const Scene scene = blurred_room(ground, GetParam());
    const PixelMeans expected = reference_of(scene);
    for (const KernelRequest& request : all_requests()) {
      const auto means = PixelMeans::of(
          kSmall, [&](const RenderSettings& s) { return render_with(scene, s, request); });
      expect_same_means(means, expected, name_of_request(request));
    }
  }
}

TEST_P(LensOfAnotherConstruction, HasTheSamePixelsWithAllSamplersAndLights) {
  const Scene scene = blurred_room(50, GetParam());
  const PixelMeans expected = reference_of(scene);
  for (const SamplerKind sampler : {SamplerKind::Sobol, SamplerKind::Independent}) {
    for (const LightSampling lights : {LightSampling::Off, LightSampling::On}) {
      RenderSettings settings = kSmall;
      settings.sampler = sampler;
      settings.light_sampling = lights;
      const auto means = PixelMeans::of(
          settings, [&](const RenderSettings& s) { return render_with(scene, s, {}); });
      expect_same_means(means, expected,
                        std::string(name_of(sampler)) + ", lights " + std::string(name_of(lights)));
    }
  }
}

/// Scattered paths rarely find a small lamp: connections to it divide the variance by 3.
TEST(Lens, IsTracedWithSampledLightsInAllKernels) {
  Scene scene = blurred_room();
  scene.background = {.bottom = LinearRgb{}, .top = LinearRgb{}};
  scene.spheres.back().radius = 0.1;
  for (const KernelRequest& request : all_requests()) {
    const auto noise = [&](LightSampling lights) {
      RenderSettings settings = with_samples(16);
      settings.light_sampling = lights;
      const auto means = PixelMeans::of(
          settings, [&](const RenderSettings& s) { return render_with(scene, s, request); });
      return std::accumulate(means.variance.begin(), means.variance.end(), 0.0);
    };
    EXPECT_LT(noise(LightSampling::On), noise(LightSampling::Off) / 2) << name_of_request(request);
  }
}

INSTANTIATE_TEST_SUITE_P(Lens, LensOfAnotherConstruction, testing::Bool(),
                         [](const auto& test) { return test.param ? "Moving" : "Still"; });

// The thin lens equation

/// A small glowing sphere on the axis, on black. Returns the scene with a picture `half` units high
/// at distance 1 on each side of the axis.
Scene glowing_point(double depth, double radius, double half) {
  Scene scene = beam_scene({0, 0, 0}, {0, 0, -1}, LinearRgb{0});
  scene.camera.plane_height = 2 * half;
  add_sphere(scene, {0, 0, -depth}, radius, emissive({1, 1, 1}, 1));
  return scene;
}

/// Where the light of a picture is. Distances from the axis are in the plane at distance 1.
struct Spot {
  double hits = 0;  // camera rays that hit the light
  double mean_square = 0, largest = 0;
};

constexpr RenderSettings kSpot{.width = 64,
                               .height = 64,
                               .samples = 2048,
                               .depth = 1,
                               .seed = 11,
                               .sampler = SamplerKind::Independent,
                               .light_sampling = LightSampling::Off};

Spot spot_of(const Scene& scene) {
  const RenderResult result = render_with(scene, kSpot, {});
  const double side = scene.camera.plane_height / kSpot.height;
  Spot spot;
  for (int y = 0; y < kSpot.height; ++y) {
    for (int x = 0; x < kSpot.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * kSpot.width + static_cast<std::size_t>(x);
      const double light = result.picture.pixels[i].g * kSpot.samples;
      const double distance =
          std::hypot(x + 0.5 - kSpot.width / 2.0, y + 0.5 - kSpot.height / 2.0) * side;
      spot.hits += light;
      spot.mean_square += light * (distance * distance + side * side / 6);
      if (light > 0) spot.largest = std::max(spot.largest, distance);
    }
  }
  spot.mean_square /= spot.hits;
  return spot;
}

/// A point at depth z becomes a uniform disc of radius a/2 · |1/f − 1/z| in the plane at distance
/// 1. Over a uniform disc, the square of the distance has the mean R²/2 and the standard deviation
/// R²/√12; limits are 4.5 standard errors, a false alarm in 150,000. The number of hits is that of
/// a pinhole: no light is lost.
TEST(Lens, SpreadsAPointOverTheDiscOfTheThinLensEquation) {
  struct Case {
    double aperture, focus, depth;
  };
  for (const Case& c : {Case{1, 20, 10}, Case{1, 7, 10}, Case{0.3, 2, 10}, Case{1, 1e300, 10}}) {
    const double disc = c.aperture / 2 * std::fabs(1 / c.focus - 1 / c.depth);
    const double own = disc / 16;  // of the sphere, in the plane at distance 1
    Scene scene = glowing_point(c.depth, own * c.depth, 1.25 * disc);
    scene.camera.aperture = c.aperture;
    scene.camera.focus = c.focus;
    const Spot spot = spot_of(scene);

    const double area = 4 * 1.25 * 1.25 * disc * disc;
    const double rays = 64.0 * 64 * 2048, expected_hits = rays * M_PI * own * own / area;
    EXPECT_NEAR(spot.hits, expected_hits, 4.5 * std::sqrt(expected_hits) + 0.002 * expected_hits);
    const double expected = (disc * disc + own * own) / 2;
    EXPECT_NEAR(spot.mean_square, expected,
                4.5 * disc * disc / std::sqrt(12 * spot.hits) + 0.003 * expected);
    const double diagonal = std::sqrt(2.0) * 2.5 * disc / 64;
    EXPECT_LT(spot.largest, disc + own + diagonal);
    EXPECT_GT(spot.largest, 0.95 * disc);
  }
}

/// A point that crosses the axis while the shutter is open becomes a line of length m, and each
/// point of it a disc: the mean squares add up if the point on the lens is independent of the time.
/// The square of a distance is within 0 and (R + m/2)², so its standard deviation is at most half
/// of that; limits are 4.5 standard errors.
TEST(Lens, IsSampledIndependentlyOfTheTime) {
  const double depth = 10, disc = 0.5 * (1.0 / 10 - 1.0 / 20), own = disc / 16, line = disc;
  for (const Vec3 way : {Vec3{line, 0, 0}, Vec3{-line, 0, 0}, Vec3{0, line, 0}}) {
    Scene scene = glowing_point(depth, own * depth, 1.75 * disc);
    scene.camera.aperture = 1;
    scene.camera.focus = 20;
    scene.shifts = {way * depth};
    scene.spheres[0].center = scene.spheres[0].center - way * (depth / 2);
    const Spot spot = spot_of(scene);
    const double expected = (disc * disc + own * own) / 2 + line * line / 12;
    const double largest = (disc + line / 2) * (disc + line / 2);
    EXPECT_NEAR(spot.mean_square, expected,
                4.5 * largest / 2 / std::sqrt(spot.hits) + 0.003 * expected);
  }
}

/// Hypothesis: the distances of the light from the axis have the same mean square with and without
/// a lens. Limits as above, for the difference of two pictures.
TEST(Lens, ShowsTheSphereInFocusAsSharplyAsAPinhole) {
  Scene scene = glowing_point(10, 0.1, 0.016);
  const Spot pinhole = spot_of(scene);
  scene.camera.aperture = 0.2;
  scene.camera.focus = 10;
  const Spot lens = spot_of(scene);
  const double square = 0.01 * 0.01;
  EXPECT_NEAR(lens.mean_square, pinhole.mean_square,
              4.5 * square * std::sqrt(2 / (12 * pinhole.hits)) + 1e-4 * square);
  EXPECT_NEAR(lens.hits, pinhole.hits, 4.5 * std::sqrt(2 * pinhole.hits));
  scene.camera.focus = 20;
  EXPECT_GT(spot_of(scene).mean_square, 1.2 * pinhole.mean_square);
}

TEST(Lens, InsideAGlowingShellSeesItsRadianceExactly) {
  Scene scene = blurred_room();
  scene.spheres.clear(), scene.materials.clear();
  add_sphere(scene, {0, 0, 0}, 30, emissive({0.25, 0.5, 0.75}, 1));
  const LinearRgb expected{0.25, 0.5, 0.75};
  for (const LinearRgb& pixel : render_with(scene, kSmall, {}).picture.pixels) {
    EXPECT_EQ(pixel, expected);
  }
}

// What does not change the picture

TEST(Lens, OfDiameterZeroIsAPinhole) {
  Scene scene = blurred_room();
  scene.camera.aperture = 0;
  Scene usual = scene;
  usual.camera.focus = render::Camera{}.focus;
  EXPECT_EQ(render_with(scene, kSmall, {}).picture.pixels,
            render_with(usual, kSmall, {}).picture.pixels);
  EXPECT_EQ(digest_of(scene), digest_of(usual));
}

/// A tiny lens moves every path by next to nothing, so a path that used another random number would
/// show.
TEST(Lens, LeavesAllOtherRandomNumbersAsTheyAre) {
  for (const bool has_motion : {false, true}) {
    for (const SamplerKind sampler : {SamplerKind::Sobol, SamplerKind::Independent}) {
      Scene scene = blurred_room(50, has_motion);
      RenderSettings settings = kSmall;
      settings.sampler = sampler;
      const KernelRequest request{.precision = Precision::Double};
      scene.camera.aperture = 1e-11;
      const auto tiny = render_with(scene, settings, request).picture.pixels;
      scene.camera.aperture = 0;
      const auto pinhole = render_with(scene, settings, request).picture.pixels;
      std::size_t different = 0;
      for (std::size_t i = 0; i < tiny.size(); ++i) {
        different += difference(tiny[i], pinhole[i]) > 1e-5 ? 1 : 0;
      }
      EXPECT_LE(different, 3u);  // of 384, whose paths pass an edge
    }
  }
}

TEST(Lens, GivesTheSameBytesAtEveryScale) {
  const Scene scene = blurred_room(50, true);
  const auto expected = render_with(scene, kSmall, {}).picture.pixels;
  for (const int exponent : {-60, 60}) {
    EXPECT_EQ(render_with(scaled(scene, exponent), kSmall, {}).picture.pixels, expected);
  }
}

TEST(Lens, GivesTheSameBytesFarFromTheOrigin) {
  Scene scene = blurred_room(50, true);
  const auto expected = render_with(scene, kSmall, {}).picture.pixels;
  const Vec3 offset{1e8, -1e8, 1e8};
  scene.camera.from += offset;
  scene.camera.at += offset;
  for (render::Sphere& sphere : scene.spheres) sphere.center += offset;
  EXPECT_EQ(render_with(scene, kSmall, {}).picture.pixels, expected);
}

TEST(Lens, GivesTheSameBytesForAnyNumberOfThreadsAndBothSearches) {
  const Scene scene = blurred_room(50, true);
  RenderSettings settings = kSmall;
  settings.threads = 1;
  const KernelRequest all{.search = Search::All, .precision = Precision::Double};
  const KernelRequest bvh{.search = Search::Bvh, .precision = Precision::Double};
  const auto expected = render_with(scene, settings, all).picture.pixels;
  EXPECT_EQ(render_with(scene, settings, bvh).picture.pixels, expected);
  settings.threads = 3;
  EXPECT_EQ(render_with(scene, settings, all).picture.pixels, expected);
}

TEST(Lens, GivesTheSameBytesOnBackendsThatRoundAlike) {
  expect_same_bytes({{"room", blurred_room()},
                     {"moving", blurred_room(50, true)},
                     {"large ground", blurred_room(1e4)}},
                    with_samples(8));
}

TEST(Lens, IsPartOfTheDigest) {
  const Scene scene = blurred_room();
  Scene wider = scene, nearer = scene;
  wider.camera.aperture *= 2;
  nearer.camera.focus /= 2;
  EXPECT_NE(digest_of(scene), digest_of(wider));
  EXPECT_NE(digest_of(scene), digest_of(nearer));
}

// First hits

/// The surface is nearly plane: its depth is 10 everywhere, whatever the point on the lens.
TEST(Lens, MeasuresDepthAlongTheAxisFromItsPlane) {
  Scene scene = beam_scene({0, 0, 0}, {0, 0, -1}, LinearRgb{1});
  scene.camera.aperture = 4;
  scene.camera.focus = 2;
  add_sphere(scene, {0, 0, -1e7 - 10}, 1e7, diffuse({0.5, 0.5, 0.5}));
  RenderSettings settings = with_samples(16);
  settings.keeps_first_hits = true;
  for (const auto& features : render_with(scene, settings, {}).features) {
    EXPECT_NEAR(features.depth, 10, 1e-3);
  }
}

TEST(Lens, IsRefusedWhereItTouchesASurface) {
  Scene scene = glowing_point(10, 9.8, 1);
  scene.camera.aperture = 0.1;
  EXPECT_NO_THROW(render_with(scene, with_samples(1), {}));
  scene.spheres[0].radius = 10;
  EXPECT_THROW(render_with(scene, with_samples(1), {}), std::invalid_argument);
}

TEST(Lens, PicksThroughItsCentre) {
  Scene scene = glowing_point(10, 0.01, 0.01);
  scene.camera.aperture = 1;
  scene.camera.focus = 2;
  const auto tracer = make_tracer(scene, {.backend = &render::portable_backend()});
  const RenderSettings settings{.width = 3, .height = 3};
  const auto picked = tracer->pick(settings, 4);
  ASSERT_TRUE(picked);
  EXPECT_NEAR(picked->distance, 9.99, 1e-9);
  EXPECT_FALSE(tracer->pick(settings, 0));
}

}  // namespace
}  // namespace sdlc::test
