#include "render/kernel/kernel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/statistics/scenes.hpp"

namespace sdlc::render {
namespace {

using testing::ElementsAre;
using Subject = KernelRefusal::Subject;

constexpr RenderSettings kSettings{.width = 960, .height = 540};

/// Spheres of equal size on a straight line across the view, far enough from each other for float.
Scene line_of_spheres(int count, double radius) {
  Scene scene = test::beam_scene({0, 0, 4}, {0, 0, 0}, LinearRgb{1});
  for (int i = 0; i < count; ++i) {
    test::add_sphere(scene, {3 * radius * i, 0, 0}, radius, test::diffuse({0.5, 0.5, 0.5}));
  }
  return scene;
}

class KernelChoice : public testing::Test {
 protected:
  void SetUp() override {
    if (available_vectors().empty()) GTEST_SKIP() << "this machine has no wide kernel";
  }
};

TEST_F(KernelChoice, TakesSmallScenesToTheWideKernelInFloat) {
  const Kernel kernel = choose_kernel(line_of_spheres(9, 0.2), kSettings);
  EXPECT_EQ(kernel.search, Search::All);
  EXPECT_EQ(kernel.precision, Precision::Float);
  EXPECT_EQ(kernel.backend, available_vectors().back());
  EXPECT_FALSE(kernel.refusal);
}

TEST_F(KernelChoice, MeetsALargeGroundInDouble) {
  Scene scene = line_of_spheres(9, 0.2);
  test::add_sphere(scene, {0, -1000.5, 0}, 1000, test::diffuse({0.5, 0.5, 0.5}));
  const Kernel kernel = choose_kernel(scene, kSettings);
  EXPECT_EQ(kernel.precision, Precision::Mixed);
  EXPECT_THAT(kernel.exact_spheres, ElementsAre(9));
}

TEST_F(KernelChoice, TakesDoubleWhereFloatIsNotEnough) {
  Scene scene = line_of_spheres(9, 0.1);
  test::add_sphere(scene, {0, 1, 0}, 1e-6, test::diffuse({0.5, 0.5, 0.5}));
  EXPECT_EQ(choose_kernel(scene, kSettings).precision, Precision::Double);
}

TEST_F(KernelChoice, ComesWithTheBoundsOfItsPrecision) {
  const auto expect_bounds = [](const Kernel& kernel, const PrecisionBounds& expected) {
    for (std::size_t i = 0; i < kPrecisionClauses; ++i) {
      EXPECT_EQ(kernel.bounds.clauses[i].value, expected.clauses[i].value)
          << kernel.precision_reason;
      EXPECT_EQ(kernel.bounds.clauses[i].share, expected.clauses[i].share)
          << kernel.precision_reason;
    }
  };
  Scene scene = line_of_spheres(9, 0.2);
  const auto in_double = [&] {
    return judge_precision(scene, scene.camera, kSettings, Precision::Double);
  };
  expect_bounds(choose_kernel(scene, kSettings),
                judge_precision(scene, scene.camera, kSettings, Precision::Float));
  expect_bounds(choose_kernel(scene, kSettings, {.precision = Precision::Double}), in_double());
  expect_bounds(choose_kernel(scene, kSettings, {.backend = &portable_backend()}), in_double());
  // Double, which the scene does not request.
  const KernelRequest scalar{
      .precision = Precision::Float, .backend = &portable_backend(), .may_take_double = true};
  expect_bounds(choose_kernel(scene, kSettings, scalar), in_double());

  test::add_sphere(scene, {0, -1000.5, 0}, 1000, test::diffuse({0.5, 0.5, 0.5}));
  const Kernel mixed = choose_kernel(scene, kSettings);
  EXPECT_EQ(mixed.precision, Precision::Mixed);
  EXPECT_TRUE(mixed.bounds.is_accepted());
  expect_bounds(mixed, judge_float(scene, scene.camera, kSettings).bounds);

  test::add_sphere(scene, {0, 1, 0}, 1e-9, test::diffuse({0.5, 0.5, 0.5}));
  expect_bounds(choose_kernel(scene, kSettings), in_double());
  const Kernel forced = choose_kernel(scene, kSettings, {.precision = Precision::Float});
  EXPECT_FALSE(forced.bounds.is_accepted());
}

TEST_F(KernelChoice, LeavesManySpheresToTheHierarchy) {
  const RenderSettings fine{.width = 960, .height = 1 << 22};
  for (const Backend& backend : backends()) {
    if (!backend.is_available()) continue;
    for (const RenderSettings& settings : {kSettings, fine}) {
      const KernelRequest request{.backend = &backend};
      const Kernel of_few = choose_kernel(line_of_spheres(20, 0.2), settings, request);
      const Kernel of_many = choose_kernel(line_of_spheres(250, 0.2), settings, request);
      EXPECT_EQ(of_few.search, Search::All) << backend.name;
      EXPECT_LT(of_few.ray_times->all, of_few.ray_times->bvh) << backend.name;
      EXPECT_EQ(of_many.search, Search::Bvh) << backend.name;
      EXPECT_GT(of_many.ray_times->all, of_many.ray_times->bvh) << backend.name;
    }
  }
  EXPECT_EQ(choose_kernel(line_of_spheres(20, 0.2), fine).precision, Precision::Double);
}

TEST_F(KernelChoice, LeavesACameraOnSeveralSurfacesToTheScalarKernel) {
  Scene scene = test::beam_scene({0, 0, 0}, {1, 0, 0}, LinearRgb{1});
  test::add_sphere(scene, {0, -3, 0}, 3, test::diffuse({0.5, 0.5, 0.5}));
  EXPECT_EQ(choose_kernel(scene, kSettings).search, Search::All);
  test::add_sphere(scene, {0, 1, 0}, 1, test::diffuse({0.5, 0.5, 0.5}));
  EXPECT_TRUE(choose_kernel(scene, kSettings).is_portable());
  const Kernel forced = choose_kernel(scene, kSettings, {.search = Search::All});
  EXPECT_EQ(forced.refusal, (KernelRefusal{Subject::Search, KernelObstacle::SeveralSurfaces}));
}

TEST_F(KernelChoice, DoesAsItIsAsked) {
  const Scene small = line_of_spheres(9, 0.2), large = line_of_spheres(300, 0.2);
  EXPECT_TRUE(choose_kernel(small, kSettings, {.backend = &portable_backend()}).is_portable());
  EXPECT_EQ(choose_kernel(small, kSettings, {.precision = Precision::Double}).precision,
            Precision::Double);
  for (const Backend* backend : available_vectors()) {
    EXPECT_EQ(choose_kernel(small, kSettings, {.backend = backend}).backend, backend);
  }
  const RenderSettings fine{.width = 960, .height = 1 << 22};
  EXPECT_EQ(choose_kernel(small, fine, {.precision = Precision::Float}).precision,
            Precision::Float);

  EXPECT_EQ(choose_kernel(large, kSettings, {.search = Search::All}).refusal,
            (KernelRefusal{Subject::Search, KernelObstacle::TooManySpheres}));
  EXPECT_EQ(choose_kernel(large, kSettings, {.precision = Precision::Float}).precision,
            Precision::Float);
  const Backend* portable = &portable_backend();
  EXPECT_EQ(
      choose_kernel(small, kSettings, {.precision = Precision::Float, .backend = portable}).refusal,
      (KernelRefusal{Subject::Precision, KernelObstacle::PortableInDouble, portable}));
  EXPECT_EQ(choose_kernel(large, kSettings, {.search = Search::All, .backend = portable}).refusal,
            (KernelRefusal{Subject::Search, KernelObstacle::TooManySpheres, portable}));
  EXPECT_FALSE(choose_kernel(large, kSettings, {.precision = Precision::Double}).refusal);
}

TEST_F(KernelChoice, RefusesWhatCannotBeMet) {
  const Backend* backend = available_vectors().front();
  Scene scene = test::beam_scene({0, 0, 0}, {1, 0, 0}, LinearRgb{1});  // between two surfaces
  test::add_sphere(scene, {0, -3, 0}, 3, test::diffuse({0.5, 0.5, 0.5}));
  test::add_sphere(scene, {0, 1, 0}, 1, test::diffuse({0.5, 0.5, 0.5}));
  EXPECT_EQ(choose_kernel(scene, kSettings, {.backend = backend}).refusal,
            (KernelRefusal{Subject::Backend, KernelObstacle::SeveralSurfaces, backend}));
  EXPECT_EQ(choose_kernel(scene, kSettings, {.precision = Precision::Float}).refusal,
            (KernelRefusal{Subject::Precision, KernelObstacle::SeveralSurfaces}));
  // No real instruction set is missing on every test machine.
  const Backend missing{.name = "missing", .is_available = []() noexcept { return false; }};
  EXPECT_EQ(choose_kernel(line_of_spheres(9, 0.2), kSettings, {.backend = &missing}).refusal,
            (KernelRefusal{Subject::Backend, KernelObstacle::OtherMachine, &missing}));
}

TEST_F(KernelChoice, LeavesASkyToTheScalarKernel) {
  EXPECT_TRUE(choose_kernel(line_of_spheres(0, 1), kSettings).is_portable());
  EXPECT_EQ(choose_kernel(line_of_spheres(0, 1), kSettings, {.search = Search::All}).refusal,
            (KernelRefusal{Subject::Search, KernelObstacle::NoSpheres}));
}

TEST_F(KernelChoice, TakesInstancesThroughAHierarchyInDouble) {
  Scene scene = line_of_spheres(2, 0.2);
  scene.prototypes = {{.spheres = {{{0, 0, 0}, 0.1, 0}}, .shifts = {}}};
  scene.instances = {{.prototype = 0, .placement = {}, .shift = {}}};
  const Kernel kernel = choose_kernel(scene, kSettings);
  EXPECT_FALSE(kernel.refusal);
  EXPECT_EQ(kernel.search, Search::Bvh);
  EXPECT_EQ(kernel.precision, Precision::Double);
  EXPECT_FALSE(
      choose_kernel(scene, kSettings, {.precision = Precision::Float, .may_take_double = true})
          .refusal);
  EXPECT_TRUE(choose_kernel(scene, kSettings, {.backend = &portable_backend()}).is_portable());

  const auto refusal = [&](const KernelRequest& request) {
    return choose_kernel(scene, kSettings, request).refusal;
  };
  EXPECT_EQ(refusal({.search = Search::All}),
            (KernelRefusal{Subject::Search, KernelObstacle::InstancesByBvh}));
  EXPECT_EQ(refusal({.precision = Precision::Float}),
            (KernelRefusal{Subject::Precision, KernelObstacle::InstancesInDouble}));
  scene.camera.from = {0, 0, 0.1};  // on the instance, and
  test::add_sphere(scene, {0, 0, 0.2}, 0.1, test::diffuse({0.5, 0.5, 0.5}));
  EXPECT_EQ(refusal({}), (KernelRefusal{Subject::Instances, KernelObstacle::SeveralSurfaces}));
}

TEST_F(KernelChoice, JudgesInstancesWhereTheyAre) {
  Scene scene = line_of_spheres(2, 0.2);
  scene.prototypes = {{.spheres = {{{0, 0, 0}, 1, 0}, {{0, 5, 0}, 0.5, 0}}, .shifts = {}}};
  Instance instance{.prototype = 0, .placement = {}, .shift = {}};
  instance.placement = {.x = {1e-3, 0, 0},
                        .y = {0, 1e-3, 0},
                        .z = {0, 0, 1e-3},
                        .translate = {0, 0, -1000},
                        .scale = 1e-3};
  scene.instances = {instance};
  const PrecisionBound hit = choose_kernel(scene, kSettings).bounds[PrecisionClause::Hit];
  EXPECT_NEAR(hit.value / (25 * 0x1p-53 * 1004 / 0.5e-3), 1, 0.01);
  EXPECT_EQ(hit.sphere, std::nullopt);
  scene.instances[0].placement.translate = {0, 0, 1e-3 + 4 - 1e-9};  // almost on the camera
  const PrecisionBound across = choose_kernel(scene, kSettings).bounds[PrecisionClause::Across];
  EXPECT_GT(across.share, 1e-4);
  EXPECT_LT(across.share, 1e-1);
}

/// A ground under a dim sky and a light that covers a twentieth of the hemisphere: its noise is
/// below the square of all arriving light, and yet it is all the noise there is.
Scene sun_over_a_plain() {
  Scene scene = test::beam_scene({0, 2, 6}, {0, 0, 0}, LinearRgb{0.5});
  test::add_sphere(scene, {0, -100, 0}, 100, test::diffuse({0.5, 0.6, 0.3}));
  test::add_sphere(scene, {-20, 30, 10}, 12, test::emissive(LinearRgb{1}, 3));
  return scene;
}

TEST(LightsOfAKernel, AreSampledWhereTheirNoiseIsNearlyAll) {
  EXPECT_THAT(choose_kernel(sun_over_a_plain(), kSettings).lights, ElementsAre(1));
}

// Everything diffuse is coated: no connection gets through, which proves nothing.
TEST(LightsOfAKernel, AreThoseOfGeometryWhereThePilotFoundNone) {
  Scene scene = test::beam_scene({0, 0, 6}, {0, 0, 0}, LinearRgb{0.1});
  test::add_sphere(scene, {0, 0, 0}, 1, test::diffuse({0.5, 0.6, 0.3}));
  test::add_sphere(scene, {0, 0, 0}, 1.05, test::transmissive(LinearRgb{1}, 1.5));
  test::add_sphere(scene, {0, 4, 3}, 0.5, test::emissive(LinearRgb{1}, 30));
  EXPECT_THAT(choose_kernel(scene, kSettings).lights, ElementsAre(2));
}

TEST(LightsOfAKernel, DoNotDependOnUnitsOfLight) {
  for (const double factor : {0x1p-900, 1.0, 0x1p900}) {
    Scene scene = sun_over_a_plain();
    scene.background.bottom = scene.background.top = LinearRgb{0.5 * factor};
    scene.materials[1].parameter *= factor;
    EXPECT_THAT(choose_kernel(scene, kSettings).lights, ElementsAre(1)) << factor;
  }
}

}  // namespace
}  // namespace sdlc::render
