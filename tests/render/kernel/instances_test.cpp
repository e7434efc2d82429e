#include "render/scene/instances.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "render/session/render.hpp"
#include "tests/render/kernel/kernels.hpp"
#include "tests/support/statistics/random.hpp"
#include "tests/support/statistics/scenes.hpp"

// Instances equal their expanded spheres: the same paths give the same pictures.
namespace sdlc::test {
namespace {

using render::Backend;
using render::Instance;
using render::LinearRgb;
using render::Picture;
using render::Placement;
using render::Precision;
using render::Prototype;
using render::RenderSettings;
using render::Scene;
using render::Search;
using render::Vec3;

constexpr RenderSettings kSettings{.width = 60, .height = 40, .samples = 4, .depth = 8, .seed = 5};

/// A rotation by unit quaternions, with a scale.
Placement random_placement(Random& random, double reach, double scale) {
  double w = 0, x = 0, y = 0, z = 0, length = 0;
  do {
    w = random.between(-1, 1);
    const Vec3 v = random.in_box(1);
    x = v.x, y = v.y, z = v.z;
    length = std::sqrt(w * w + x * x + y * y + z * z);
  } while (length < 0.1 || length > 1);
  w /= length, x /= length, y /= length, z /= length;
  return {.x = Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)} * scale,
          .y = Vec3{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)} * scale,
          .z = Vec3{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)} * scale,
          .translate = random.in_box(reach),
          .scale = scale};
}

struct Moves {
  bool prototypes = false, instances = false;
};

/// A ground, and instances of prototypes of all materials that overlap each other.
Scene random_scene(unsigned seed, Moves moves = {}) {
  Random random(seed);
  Scene scene = beam_scene({0, 1, 6}, {0, 0, 0}, LinearRgb{1});
  scene.background = {};
  scene.camera.aspect = 1.5;
  scene.camera.plane_height = 1.2;
  add_sphere(scene, {0, -101, 0}, 100, diffuse({0.5, 0.6, 0.3}));
  scene.materials.insert(scene.materials.end(),
                         {diffuse({0.8, 0.3, 0.2}), specular({0.8, 0.8, 0.6}, 0.2),
                          transmissive({1, 0.9, 1}, 1.5), emissive({1, 0.9, 0.8}, 2)});
  const int prototypes = 1 + static_cast<int>(random.between(0, 3));
  for (int i = 0; i < prototypes; ++i) {
    Prototype prototype;
    const int spheres = 1 + static_cast<int>(random.between(0, 200));
    const Vec3 middle = random.in_box(20);  // far from its own origin
    for (int k = 0; k < spheres; ++k) {
      prototype.spheres.push_back(
          {.center = middle + random.in_box(1),
           .radius = random.between(0.02, 0.15),
           .material = 1 + static_cast<std::uint32_t>(random.between(0, 4))});
      if (moves.prototypes) prototype.shifts.push_back(random.in_box(0.2));
    }
    scene.prototypes.push_back(prototype);
  }
  const int instances = 1 + static_cast<int>(random.between(0, 60));
  for (int i = 0; i < instances; ++i) {
    Instance instance;
    instance.prototype = static_cast<std::uint32_t>(random.between(0, prototypes));
    instance.placement = random_placement(random, 2, std::exp(random.between(-2, 0)));
    // Moves the prototype to where it is visible.
    const Vec3 middle = scene.prototypes[instance.prototype].spheres[0].center;
    instance.placement.translate += -instance.placement.turn(middle);
    if (moves.instances) instance.shift = random.in_box(0.3);
    scene.instances.push_back(instance);
  }
  return scene;
}

Picture picture_of(const Scene& scene, const RenderSettings& settings = kSettings,
                   const Backend* backend = render::available_vectors().back()) {
  const auto result = render_with(
      scene, settings, {.search = Search::Bvh, .precision = Precision::Double, .backend = backend});
  EXPECT_FALSE(result.kernel.refusal);
  EXPECT_EQ(result.nonfinite_samples, 0u);
  return result.picture;
}

/// The number of pixels that differ by more than rounding.
std::size_t count_different(const Picture& a, const Picture& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const LinearRgb p = a.pixels[i], q = b.pixels[i];
    const double apart =
        std::max({std::fabs(p.r - q.r), std::fabs(p.g - q.g), std::fabs(p.b - q.b)});
    count += apart > 1e-6 ? 1 : 0;
  }
  return count;
}

class Instances : public testing::TestWithParam<const Backend*> {};

TEST_P(Instances, AreSeenAsSpheresOfTheirOwn) {
  std::size_t different = 0, pixels = 0;
  for (unsigned seed = 0; seed < 24; ++seed) {
    Scene scene = random_scene(seed, {.prototypes = seed % 4 >= 2, .instances = seed % 2 == 1});
    if (seed % 3 == 0) scene.camera.aperture = 0.2, scene.camera.focus = 5;
    const Picture held_once = picture_of(scene, kSettings, GetParam());
    const Picture plain = picture_of(without_instances(scene), kSettings, GetParam());
    different += count_different(held_once, plain);
    pixels += plain.pixels.size();
  }
  // Rounding errors grow with each hit: one path in about ten thousand diverges.
  EXPECT_LE(different, pixels / 1000);
}

TEST_P(Instances, AreTheSameToTheBitWithEachInstructionSetThatFuses) {
  if (GetParam()->is_fused != render::best_backend().is_fused) {
    GTEST_SKIP() << "it rounds products";
  }
  const Scene scene = random_scene(7, {.prototypes = true, .instances = true});
  EXPECT_EQ(picture_of(scene, kSettings, GetParam()).pixels, picture_of(scene).pixels);
}

INSTANTIATE_TEST_SUITE_P(Isas, Instances, testing::ValuesIn(render::available_vectors()),
                         [](const auto& test) { return std::string(test.param->name); });

TEST(InstancedScenes, DoNotDependOnThreads) {
  const Scene scene = random_scene(3, {.prototypes = true, .instances = true});
  RenderSettings one = kSettings, three = kSettings;
  one.threads = 1;
  three.threads = 3;
  EXPECT_EQ(picture_of(scene, one).pixels, picture_of(scene, three).pixels);
}

TEST(InstancedScenes, OfAnySizeGiveTheSamePicture) {
  for (const int exponent : {-300, -30, 1, 60, 400}) {
    const Scene scene = random_scene(11, {.prototypes = true, .instances = true});
    Scene other = scene;
    const double factor = std::ldexp(1.0, exponent);
    other.camera.from = other.camera.from * factor;
    for (auto& sphere : other.spheres) {
      sphere.center = sphere.center * factor;
      sphere.radius *= factor;
    }
    for (Instance& instance : other.instances) {
      Placement& placement = instance.placement;
      for (Vec3* column : {&placement.x, &placement.y, &placement.z, &placement.translate}) {
        *column = *column * factor;
      }
      placement.scale *= factor;
      instance.shift = instance.shift * factor;
    }
    EXPECT_EQ(picture_of(other).pixels, picture_of(scene).pixels) << exponent;

    // Prototypes in a unit of their own.
    for (Prototype& prototype : other.prototypes) {
      for (auto& sphere : prototype.spheres) {
        sphere.center = sphere.center * factor;
        sphere.radius *= factor;
      }
      for (Vec3& shift : prototype.shifts) shift = shift * factor;
    }
    for (Instance& instance : other.instances) {
      Placement& placement = instance.placement;
      for (Vec3* column : {&placement.x, &placement.y, &placement.z}) *column = *column / factor;
      placement.scale /= factor;
    }
    EXPECT_EQ(picture_of(other).pixels, picture_of(scene).pixels) << exponent;
  }
}

TEST(InstancedScenes, MayHaveNoOtherSpheres) {
  Scene scene = random_scene(1);
  scene.spheres.clear();
  EXPECT_LE(count_different(picture_of(scene), picture_of(without_instances(scene))), 2u);
}

TEST(InstancedScenes, MayHaveTheCameraOnASphere) {
  Scene scene = random_scene(2);
  scene.spheres.clear();
  scene.prototypes = {{.spheres = {{{3, 0, 0}, 1, 1}, {{4.5, 0, 0}, 0.25, 2}}, .shifts = {}}};
  scene.instances = {{.prototype = 0, .placement = {}, .shift = {}}};
  scene.camera.from = {3, 0, 1};
  scene.camera.at = {4.5, 0, 1};
  const Picture seen = picture_of(scene);
  EXPECT_EQ(count_different(seen, picture_of(without_instances(scene))), 0u);
  scene.camera.from = {3, 0, 1 - 1e-9};  // inside: below the horizon its inside is visible
  EXPECT_GT(count_different(seen, picture_of(scene)), seen.pixels.size() / 4);
}

TEST(InstancedScenes, AreMetBehindEachOther) {
  // Rows of instances along the view, each of which hides the next.
  Scene scene = beam_scene({0, 0, 5}, {0, 0, 0}, LinearRgb{1});
  scene.materials = {unlit({0.25, 0, 0}), unlit({0, 0.5, 0})};
  scene.prototypes = {{.spheres = {{{0, 0, 0}, 0.5, 0}}, .shifts = {}},
                      {.spheres = {{{0, 0, 0}, 0.5, 1}}, .shifts = {}}};
  for (int i = 0; i < 40; ++i) {
    Instance instance{.prototype = i == 17 ? 1u : 0u, .placement = {}, .shift = {}};
    instance.placement.translate = {0, 0, i == 17 ? 1.0 : -0.5 * i};
    scene.instances.push_back(instance);
  }
  const RenderSettings one_pixel{.width = 1, .height = 1, .samples = 1, .depth = 2};
  EXPECT_EQ(picture_of(scene, one_pixel).pixels[0], (LinearRgb{0, 0.5, 0}));
}

}  // namespace
}  // namespace sdlc::test
