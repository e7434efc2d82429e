#include "render/film/aov.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "render/math/power_of_two.hpp"
#include "render/math/vec3.hpp"
#include "render/session/render.hpp"

namespace sdlc::render {
namespace {

constexpr Aovs kFeatures{.normal = true, .depth = true, .albedo = true};

std::vector<PixelFeatures> features_of(Scene scene, RenderSettings settings) {
  settings.keeps_first_hits = true;
  RenderMonitor monitor;
  return render(std::move(scene), settings, monitor).features;
}

/// Of a picture of one pixel with one ray through its centre.
PixelFeatures middle_of(Scene scene) {
  return features_of(std::move(scene), {.width = 1, .height = 1, .samples = 1})[0];
}

constexpr LinearRgb kTan{0.5, 0.25, 0.125};

/// A ball of radius 1 around the origin, seen from (0, 0, 5); all of it in view.
Scene ball(Material material = {.color = kTan}) {
  Scene scene;
  scene.camera = {.from = {0, 0, 5}, .at = {0, 0, 0}, .plane_height = 1, .aspect = 1};
  scene.materials = {material};
  scene.spheres = {{.center = {0, 0, 0}, .radius = 1, .material = 0}};
  return scene;
}

constexpr RenderSettings kSmall{.width = 33, .height = 33, .samples = 64};
constexpr std::size_t kMiddle = 16 * 33 + 16;

TEST(PixelFeatures, TellOfTheSphereInTheMiddle) {
  const PixelFeatures middle = middle_of(ball());
  EXPECT_EQ(middle.depth, 4);
  EXPECT_EQ(middle.normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(middle.albedo, kTan);
}

TEST(FeatureLayers, AreThoseThatAreRequestedInTheirOrder) {
  const std::vector<PixelFeatures> features(6);
  const auto names = [&](const Aovs& aovs) {
    std::string all;
    for (const Layer& layer : feature_layers(features, aovs)) {
      EXPECT_EQ(layer.values.size(), 6u);
      all += layer.name + ' ';
    }
    return all;
  };
  EXPECT_EQ(names(kFeatures), "normal.X normal.Y normal.Z Z albedo.R albedo.G albedo.B ");
  EXPECT_EQ(names({.depth = true, .variance = true, .samples = true}), "Z ");
  EXPECT_EQ(names({.albedo = true}), "albedo.R albedo.G albedo.B ");
}

TEST(FeatureLayers, ClampDepthsToTheLargestFloat) {
  const std::vector<PixelFeatures> features{{.normal = {}, .depth = 4e200, .albedo = {}}};
  EXPECT_EQ(feature_layers(features, {.depth = true})[0].values[0],
            std::numeric_limits<float>::max());
}

TEST(PixelFeatures, HoldTheSkyAsNoSurface) {
  const PixelFeatures corner = features_of(ball(), kSmall)[0];
  EXPECT_EQ(corner.depth, kNoDepth);
  EXPECT_EQ(corner.normal, Vec3{});
  EXPECT_EQ(corner.albedo, LinearRgb{});
}

// Depth is along the view, as in Cycles: for a sphere so large that it is flat it is constant over
// the picture, unlike the distance to the camera.
TEST(PixelFeatures, MeasureDepthAlongTheView) {
  Scene scene = ball();
  scene.camera.plane_height = 2;
  scene.spheres = {{.center = {0, 0, -1e9}, .radius = 1e9, .material = 0}};
  const auto channels = features_of(scene, kSmall);
  EXPECT_NEAR(channels[kMiddle].depth, 5, 1e-5);
  EXPECT_NEAR(channels[0].depth, 5, 1e-5);
}

TEST(PixelFeatures, AreMeansOverThePixel) {
  // At distance 1 the ball is a disc of radius 1 / √24: half of the only pixel.
  Scene scene = ball();
  scene.camera.plane_height = std::sqrt(2 * 3.14159265 / 24);
  const PixelFeatures pixel = features_of(scene, {.width = 1, .height = 1, .samples = 16})[0];
  EXPECT_NEAR(pixel.albedo.r, kTan.r / 2, kTan.r / 8);
  EXPECT_EQ(pixel.albedo.r * 32, std::round(pixel.albedo.r * 32)) << "sixteenths of its colour";
  EXPECT_GT(pixel.normal.z, 0.2);
  EXPECT_LT(pixel.normal.z, 0.6) << "the sky counts as a normal of length 0";
  EXPECT_GT(pixel.depth, 4) << "of those rays that meet it";
  EXPECT_LT(pixel.depth, 5);
}

TEST(PixelFeatures, FollowWhatMovesWhileTheShutterIsOpen) {
  Scene scene = ball();
  scene.shifts = {{0, 0, -2}};
  scene.camera.plane_height = 1e-6;  // so that curvature does not count
  const double mean = features_of(scene, {.width = 1, .height = 1, .samples = 16})[0].depth;
  EXPECT_NEAR(mean, 5, 2.0 / 16) << "4 at the opening, 6 at the closing, stratified";
}

TEST(PixelFeatures, TurnNormalsToTheCameraInsideOfASphere) {
  Scene scene = ball();
  scene.spheres[0].radius = 8;
  const PixelFeatures middle = middle_of(scene);
  EXPECT_EQ(middle.depth, 13);
  EXPECT_EQ(middle.normal, (Vec3{0, 0, 1}));
}

TEST(PixelFeatures, LeaveTheSurfaceThatTheCameraStandsOn) {
  Scene scene = ball();
  scene.spheres.push_back({.center = {0, 0, 6}, .radius = 1, .material = 0});
  EXPECT_EQ(middle_of(scene).depth, 4) << "looking away from it";
  scene.spheres = {{.center = {0, 0, 3}, .radius = 2, .material = 0}};
  EXPECT_EQ(middle_of(scene).depth, 4) << "looking through it, at its far side";
  EXPECT_EQ(middle_of(scene).normal, (Vec3{0, 0, 1}));
  scene.spheres.push_back({.center = {0, 0, 4}, .radius = 1, .material = 0});
  EXPECT_EQ(middle_of(scene).depth, 2) << "of two that it stands on";
}

// Rounding would put half of the cameras before the surface, and half of them beyond it.
TEST(PixelFeatures, LeaveTheSurfaceThatTheCameraStandsOnButForRounding) {
  for (int i = 0; i < 100; ++i) {
    Scene scene = ball();
    const Vec3 view = unit({std::sin(i), std::cos(i), std::sin(3 * i)});
    scene.camera.from = {0.1, 0.7, -0.3};
    scene.camera.at = scene.camera.from + view;
    scene.camera.up = cross(view, unit({1, 2, 3}));
    const auto ahead = [&](double radius) {
      return Sphere{.center = scene.camera.from + view * radius, .radius = std::fabs(radius)};
    };
    scene.spheres = {ahead(0.3)};
    EXPECT_NEAR(middle_of(scene).depth, 0.6, 1e-6) << i;
    scene.spheres = {ahead(0.3), ahead(0.15), ahead(0.7)};
    EXPECT_NEAR(middle_of(scene).depth, 0.3, 1e-6) << i;
    scene.spheres = {ahead(-0.3)};
    EXPECT_EQ(middle_of(scene).depth, kNoDepth) << i;
  }
}

TEST(PixelFeatures, KeepTheirBitsInAScaledScene) {
  const auto scaled = [](int e) {
    Scene scene = ball();
    scene.spheres.push_back({.center = {0.4, 0.3, 1.1}, .radius = 0.7, .material = 0});
    scene.camera.from = scaled_by_power_of_two({1.3, 0.7, 5}, e);
    for (Sphere& sphere : scene.spheres) {
      sphere.center = scaled_by_power_of_two(sphere.center, e);
      sphere.radius = std::ldexp(sphere.radius, e);
    }
    return features_of(scene, kSmall);
  };
  const std::vector<PixelFeatures> one = scaled(0);
  for (const int e : {-60, 60, 900}) {
    const std::vector<PixelFeatures> other = scaled(e);
    for (std::size_t i = 0; i < one.size(); ++i) {
      PixelFeatures expected = one[i];
      if (expected.depth != kNoDepth) expected.depth = std::ldexp(expected.depth, e);
      ASSERT_TRUE(other[i] == expected) << i;
    }
  }
}

// A speck of 1e-12 in front of the camera, and a planet 1e12 away in the same picture.
TEST(PixelFeatures, KeepTheDigitsOfDepthsThatDifferInMagnitude) {
  Scene scene = ball();
  scene.spheres = {{.center = {0, 0, 5 - 2e-12}, .radius = 1e-12, .material = 0},
                   {.center = {0, 0, -1e12}, .radius = 9e11, .material = 0}};
  scene.camera.from = {0, 0, 0};
  scene.camera.at = {0, 0, -1};
  scene.spheres[0].center.z = -2e-12;
  const auto features = features_of(scene, kSmall);
  EXPECT_NEAR(features[kMiddle].depth, 1e-12, 1e-14);
}

TEST(PixelFeatures, AreTheSameBitsForAnyNumberOfThreadsAndPasses) {
  RenderSettings settings = kSmall;
  settings.threads = 1;
  const std::vector<PixelFeatures> one = features_of(ball(), settings);
  settings.threads = 7;
  EXPECT_TRUE(features_of(ball(), settings) == one);
  RenderSettings passes = settings;
  passes.seconds = 1e9;  // a time limit alone makes many passes
  EXPECT_TRUE(features_of(ball(), passes) == one);
  settings.seed = 1;
  EXPECT_FALSE(features_of(ball(), settings) == one) << "another seed";
}

TEST(PixelFeatures, SeeTheSpheresOfInstances) {
  Scene scene = ball();
  scene.prototypes = {{.spheres = scene.spheres, .shifts = {}}};
  scene.spheres.clear();
  scene.instances = {{.prototype = 0, .placement = {.translate = {0, 0, 1}}, .shift = {}}};
  const PixelFeatures middle = middle_of(scene);
  EXPECT_EQ(middle.depth, 3);
  EXPECT_EQ(middle.albedo, kTan);
}

TEST(PixelFeatures, TakeLightAndTintsForColoursUpToOne) {
  const auto albedo = [](const Material& material) { return middle_of(ball(material)).albedo; };
  EXPECT_EQ(albedo({.color = kTan, .parameter = 0, .type = MaterialType::Specular}), kTan);
  EXPECT_EQ(albedo({.color = kTan, .parameter = 1.5, .type = MaterialType::Transmissive}), kTan);
  EXPECT_EQ(albedo({.color = {2, 0.5, 1}, .type = MaterialType::Unlit}), (LinearRgb{1, 0.5, 1}));
  EXPECT_EQ(albedo({.color = kTan, .parameter = 4, .type = MaterialType::Emissive}),
            (LinearRgb{1, 1, 0.5}));
}

TEST(PixelFeatures, AreEmptyWhereNothingWasTraced) {
  for (const bool has_goal : {false, true}) {
    RenderSettings settings = kSmall;
    settings.keeps_first_hits = true;
    if (has_goal) settings.error = 0.01;
    RenderMonitor monitor;
    monitor.cancel = true;
    const auto features = render(ball(), settings, monitor).features;
    ASSERT_EQ(features.size(), 33u * 33);
    for (const PixelFeatures& pixel : features) EXPECT_EQ(pixel, PixelFeatures{});
  }
}

TEST(PixelFeatures, HoldNothingInAnEmptyScene) {
  Scene scene = ball();
  scene.spheres.clear();
  EXPECT_EQ(middle_of(scene).depth, kNoDepth);
}

// The first rays of both samplers pass through the centre only with one sample.
TEST(PreparedScene, PicksTheSphereAtThePixel) {
  Scene scene = ball();
  scene.spheres.push_back({.center = {0, 0, 20}, .radius = 1, .material = 0});
  const PreparedScene prepared = prepare(scene, kSmall);
  const auto picked = prepared.pick(kSmall, kMiddle);
  ASSERT_TRUE(picked);
  EXPECT_EQ(picked->sphere, 0u);
  EXPECT_FALSE(picked->instance);
  EXPECT_NEAR(picked->distance, 4, 1e-6);
  EXPECT_FALSE(prepared.pick(kSmall, 0));
}

TEST(PreparedScene, PicksTheInstanceOfASphere) {
  Scene scene = ball();
  scene.prototypes = {{.spheres = {{.center = {9, 9, 0}, .radius = 1, .material = 0},
                                   {.center = {0, 0, 0}, .radius = 1, .material = 0}},
                       .shifts = {}}};
  scene.spheres = {{.center = {0, 9, 0}, .radius = 1, .material = 0}};
  scene.instances = {{.prototype = 0, .placement = {.translate = {50, 0, 1}}, .shift = {}},
                     {.prototype = 0, .placement = {.translate = {0, 0, 1}}, .shift = {}}};
  const auto picked = prepare(scene, kSmall).pick(kSmall, kMiddle);
  ASSERT_TRUE(picked);
  EXPECT_EQ(picked->sphere, 1u);
  EXPECT_EQ(picked->instance, 1u);
  EXPECT_NEAR(picked->distance, 3, 1e-9);
}

TEST(PictureLayers, HoldTheVarianceByChannel) {
  const std::vector<Layer> layers = variance_layers(Picture(2, 1, {1, 2, 3}));
  ASSERT_EQ(layers.size(), 3u);
  EXPECT_EQ(layers[0].name, "variance.R");
  EXPECT_EQ(layers[1].values, std::vector(2, 2.0F));
  EXPECT_EQ(layers[2].values, std::vector(2, 3.0F));
}

TEST(PictureLayers, HoldAVarianceOnlyIfFloatsCan) {
  const auto fits = [](double variance, double mean) {
    Picture variances(2, 1), means(2, 1);
    variances.pixels[1].g = variance;
    means.pixels[1].g = mean;
    return fits_float(variances, means);
  };
  EXPECT_TRUE(fits(0, 1));
  EXPECT_TRUE(fits(3e38, 1e25));
  EXPECT_FALSE(fits(4e38, 1e25));
  EXPECT_FALSE(fits(INFINITY, 1e200));
  EXPECT_FALSE(fits(NAN, 1e200));
  EXPECT_TRUE(fits(1e-37, 1e-18));
  EXPECT_FALSE(fits(1e-39, 1e-18));
  EXPECT_TRUE(fits(1e-39, 1e-3)) << "the means differ by rounding";
}

TEST(PictureLayers, HoldTheSamplesOfEachPixelOrThoseOfAll) {
  const std::vector<std::uint32_t> samples{3, 5};
  EXPECT_EQ(samples_layer(samples, 9, 2).values, (std::vector{3.0F, 5.0F}));
  EXPECT_EQ(samples_layer({}, 9, 2).values, (std::vector{9.0F, 9.0F}));
}

}  // namespace
}  // namespace sdlc::render
