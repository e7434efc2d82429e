#include "render/aov/aov.hpp"

#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "render/math/power_of_two.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::render {
namespace {

constexpr Aovs kFirstHits{.normal = true, .depth = true, .albedo = true};

using Channels = std::map<std::string, std::vector<float>>;

Channels channels_of(Scene scene, const RenderSettings& settings) {
  const std::atomic<bool> cancel = false;
  Channels channels;
  for (Layer& layer : first_hit_layers(std::move(scene), settings, kFirstHits, cancel)) {
    channels[layer.name] = std::move(layer.values);
  }
  return channels;
}

/// The channels of one pixel.
struct Pixel {
  Vec3 normal;
  double depth;
  LinearRgb albedo;
};

Pixel pixel_of(const Channels& channels, std::size_t i) {
  const auto value = [&](const char* name) -> double { return channels.at(name)[i]; };
  return {.normal = {value("normal.X"), value("normal.Y"), value("normal.Z")},
          .depth = value("Z"),
          .albedo = {value("albedo.R"), value("albedo.G"), value("albedo.B")}};
}

/// Of a picture of one pixel with one ray through its centre.
Pixel middle_of(Scene scene) {
  return pixel_of(channels_of(std::move(scene), {.width = 1, .height = 1, .samples = 1}), 0);
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

TEST(FirstHitLayers, TellOfTheSphereInTheMiddle) {
  const Pixel middle = middle_of(ball());
  EXPECT_EQ(middle.depth, 4);
  EXPECT_EQ(middle.normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(middle.albedo, kTan);
}

TEST(FirstHitLayers, AreThoseThatAreAskedForInTheirOrder) {
  const std::atomic<bool> cancel = false;
  const auto names = [&](const Aovs& aovs) {
    std::string all;
    for (const Layer& layer : first_hit_layers(ball(), {.width = 2, .height = 3}, aovs, cancel)) {
      EXPECT_EQ(layer.values.size(), 6u);
      all += layer.name + ' ';
    }
    return all;
  };
  EXPECT_EQ(names(kFirstHits), "normal.X normal.Y normal.Z Z albedo.R albedo.G albedo.B ");
  EXPECT_EQ(names({.depth = true, .variance = true, .samples = true}), "Z ");
  EXPECT_EQ(names({.albedo = true}), "albedo.R albedo.G albedo.B ");
}

TEST(FirstHitLayers, HoldTheSkyAsNoSurface) {
  const Pixel corner = pixel_of(channels_of(ball(), kSmall), 0);
  EXPECT_EQ(corner.depth, kNoDepth);
  EXPECT_EQ(corner.normal, Vec3{});
  EXPECT_EQ(corner.albedo, LinearRgb{});
}

// Depth is along the view, as in Cycles: for a sphere so large that it is flat it is constant over
// the picture, unlike the distance to the camera.
TEST(FirstHitLayers, MeasureDepthAlongTheView) {
  Scene scene = ball();
  scene.camera.plane_height = 2;
  scene.spheres = {{.center = {0, 0, -1e9}, .radius = 1e9, .material = 0}};
  const Channels channels = channels_of(scene, kSmall);
  EXPECT_NEAR(pixel_of(channels, kMiddle).depth, 5, 1e-5);
  EXPECT_NEAR(pixel_of(channels, 0).depth, 5, 1e-5);
}

TEST(FirstHitLayers, AreMeansOverThePixel) {
  // At distance 1 the ball is a disc of radius 1 / √24: half of the only pixel.
  Scene scene = ball();
  scene.camera.plane_height = std::sqrt(2 * 3.14159265 / 24);
  const Pixel pixel = pixel_of(channels_of(scene, {.width = 1, .height = 1, .samples = 2}), 0);
  EXPECT_NEAR(pixel.albedo.r, kTan.r / 2, kTan.r / 8);
  EXPECT_EQ(pixel.albedo.r * 32, std::round(pixel.albedo.r * 32)) << "sixteenths of its colour";
  EXPECT_GT(pixel.normal.z, 0.2);
  EXPECT_LT(pixel.normal.z, 0.6) << "the sky counts as a normal of length 0";
  EXPECT_GT(pixel.depth, 4) << "of those rays that meet it";
  EXPECT_LT(pixel.depth, 5);
}

TEST(FirstHitLayers, FollowWhatMovesWhileTheShutterIsOpen) {
  Scene scene = ball();
  scene.shifts = {{0, 0, -2}};
  scene.camera.plane_height = 1e-6;  // so that curvature does not count
  const double mean =
      pixel_of(channels_of(scene, {.width = 1, .height = 1, .samples = 2}), 0).depth;
  EXPECT_NEAR(mean, 5, 2.0 / 16) << "4 at the opening, 6 at the closing, stratified";
}

TEST(FirstHitLayers, TurnNormalsToTheCameraInsideOfASphere) {
  Scene scene = ball();
  scene.spheres[0].radius = 8;
  const Pixel middle = middle_of(scene);
  EXPECT_EQ(middle.depth, 13);
  EXPECT_EQ(middle.normal, (Vec3{0, 0, 1}));
}

TEST(FirstHitLayers, LeaveTheSurfaceThatTheCameraStandsOn) {
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
TEST(FirstHitLayers, LeaveTheSurfaceThatTheCameraStandsOnButForRounding) {
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

TEST(FirstHitLayers, KeepTheirBitsInAScaledScene) {
  const auto scaled = [](int e) {
    Scene scene = ball();
    scene.spheres.push_back({.center = {0.4, 0.3, 1.1}, .radius = 0.7, .material = 0});
    scene.camera.from = scaled_by_power_of_two({1.3, 0.7, 5}, e);
    for (Sphere& sphere : scene.spheres) {
      sphere.center = scaled_by_power_of_two(sphere.center, e);
      sphere.radius = std::ldexp(sphere.radius, e);
    }
    return channels_of(scene, kSmall);
  };
  const Channels one = scaled(0);
  for (const int e : {-60, 60}) {
    const Channels other = scaled(e);
    for (const auto& [name, values] : one) {
      for (std::size_t i = 0; i < values.size(); ++i) {
        const bool is_scaled = name == "Z" && values[i] != static_cast<float>(kNoDepth);
        ASSERT_EQ(other.at(name)[i], is_scaled ? std::ldexp(values[i], e) : values[i]) << name;
      }
    }
  }
}

TEST(FirstHitLayers, KeepDepthsThatAFloatCannotHoldAsTheLargest) {
  Scene scene = ball();
  scene.camera.from.z = 5e200;
  scene.spheres[0].radius = 1e200;
  EXPECT_EQ(middle_of(scene).depth, std::numeric_limits<float>::max());
}

TEST(FirstHitLayers, AreTheSameBitsForAnyNumberOfThreads) {
  RenderSettings settings = kSmall;
  settings.threads = 1;
  const Channels one = channels_of(ball(), settings);
  settings.threads = 7;
  EXPECT_EQ(channels_of(ball(), settings), one);
  settings.seed = 1;
  EXPECT_NE(channels_of(ball(), settings), one) << "and others for another seed";
}

TEST(FirstHitLayers, SeeTheSpheresOfInstances) {
  Scene scene = ball();
  scene.prototypes = {{.spheres = scene.spheres, .shifts = {}}};
  scene.spheres.clear();
  scene.instances = {{.prototype = 0, .placement = {.translate = {0, 0, 1}}, .shift = {}}};
  const Pixel middle = middle_of(scene);
  EXPECT_EQ(middle.depth, 3);
  EXPECT_EQ(middle.albedo, kTan);
}

TEST(FirstHitLayers, TakeLightAndTintsForColoursUpToOne) {
  const auto albedo = [](const Material& material) { return middle_of(ball(material)).albedo; };
  EXPECT_EQ(albedo({.color = kTan, .parameter = 0, .type = MaterialType::Specular}), kTan);
  EXPECT_EQ(albedo({.color = kTan, .parameter = 1.5, .type = MaterialType::Transmissive}), kTan);
  EXPECT_EQ(albedo({.color = {2, 0.5, 1}, .type = MaterialType::Unlit}), (LinearRgb{1, 0.5, 1}));
  EXPECT_EQ(albedo({.color = kTan, .parameter = 4, .type = MaterialType::Emissive}),
            (LinearRgb{1, 1, 0.5}));
}

TEST(FirstHitLayers, AreEmptyOnceTheyAreCancelled) {
  const std::atomic<bool> cancel = true;
  EXPECT_TRUE(first_hit_layers(ball(), kSmall, kFirstHits, cancel).empty());
}

TEST(FirstHitLayers, HoldNothingInAnEmptyScene) {
  Scene scene = ball();
  scene.spheres.clear();
  EXPECT_EQ(middle_of(scene).depth, kNoDepth);
}

TEST(PictureLayers, HoldTheVarianceByChannel) {
  const std::vector<Layer> layers = variance_layers(Picture(2, 1, {1, 2, 3}));
  ASSERT_EQ(layers.size(), 3u);
  EXPECT_EQ(layers[0].name, "variance.R");
  EXPECT_EQ(layers[1].values, std::vector(2, 2.0F));
  EXPECT_EQ(layers[2].values, std::vector(2, 3.0F));
}

TEST(PictureLayers, HoldTheSamplesOfEachPixelOrThoseOfAll) {
  const std::vector<std::uint32_t> samples{3, 5};
  EXPECT_EQ(samples_layer(samples, 9, 2).values, (std::vector{3.0F, 5.0F}));
  EXPECT_EQ(samples_layer({}, 9, 2).values, (std::vector{9.0F, 9.0F}));
}

}  // namespace
}  // namespace sdlc::render
