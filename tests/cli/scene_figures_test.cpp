#include "cli/scene_figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/kernel/wide_scene.hpp"

namespace sdlc::cli {
namespace {

using render::MaterialType;
using render::Vec3;
using testing::ElementsAre;

/// A glass ball at the origin and two lights, seen from (0, 0, 10); the first material is unused.
render::Scene three_spheres() {
  render::Scene scene;
  scene.camera.from = {0, 0, 10};
  for (const MaterialType type : {MaterialType::Diffuse, MaterialType::Transmissive,
                                  MaterialType::Emissive, MaterialType::Emissive}) {
    scene.materials.push_back({.color = {}, .type = type});
  }
  scene.spheres = {{.center = {0, 0, 0}, .radius = 0.5, .material = 1},
                   {.center = {3, 0, -2}, .radius = 2, .material = 2},
                   {.center = {0, 4, 0}, .radius = 0.5, .material = 3}};
  return scene;
}

TEST(CountMaterials, CountsTheMaterialsThatSpheresHave) {
  const MaterialCounts counts = count_materials(three_spheres());
  std::vector<std::string> rows;
  for (const MaterialFigures& row : counts) {
    rows.push_back(std::string(material_name(row.type)) + " " + std::to_string(row.materials) +
                   " " + std::to_string(row.spheres));
  }
  EXPECT_THAT(rows, ElementsAre("diffuse 0 0", "specular 0 0", "transmissive 1 1", "emissive 2 2",
                                "unlit 0 0"));
}

TEST(RequiredFeatures, NamesWhatIsInUse) {
  render::Scene scene = three_spheres();
  EXPECT_THAT(required_features(scene, count_materials(scene)),
              ElementsAre("gradient", "transmissive", "emissive"));
  scene.shifts.resize(3);
  scene.background.top = scene.background.bottom;
  EXPECT_THAT(required_features(scene, count_materials(scene)),
              ElementsAre("motion", "transmissive", "emissive"));
}

TEST(MeasureSpheres, FindsTheBoxAroundAllOfThem) {
  const auto figures = measure_spheres(three_spheres());
  ASSERT_TRUE(figures);
  EXPECT_EQ(figures->low, (Vec3{-0.5, -2, -4}));
  EXPECT_EQ(figures->high, (Vec3{5, 4.5, 0.5}));
  EXPECT_EQ(figures->moving, 0u);
}

TEST(MeasureSpheres, FollowsThemWhileTheShutterIsOpen) {
  render::Scene scene = three_spheres();
  scene.shifts = {{0, 0, 0}, {0, 0, 0}, {-7, 1, -20}};
  const auto figures = measure_spheres(scene);
  EXPECT_EQ(figures->low, (Vec3{-7.5, -2, -20.5}));
  EXPECT_EQ(figures->high, (Vec3{5, 5.5, 0.5}));
  EXPECT_EQ(figures->moving, 1u);
}

TEST(MeasureSpheres, ComparesTheScales) {
  const auto figures = measure_spheres(three_spheres());
  EXPECT_EQ(figures->smallest.radius, 0.5);
  EXPECT_EQ(figures->smallest.sphere, 0u) << "the first of two";
  EXPECT_EQ(figures->largest.radius, 2);
  EXPECT_EQ(figures->largest.sphere, 1u);
  EXPECT_EQ(figures->radius_ratio(), 4);
  EXPECT_DOUBLE_EQ(figures->extent, std::sqrt(9.0 + 144.0) + 2);
  EXPECT_DOUBLE_EQ(figures->scale_ratio(), 2 * figures->extent);
}

TEST(MeasureSpheres, DoesNotOverflowWhereSquaresDo) {
  render::Scene scene = three_spheres();
  scene.spheres = {{.center = {3e200, 0, 4e200}, .radius = 1e200}};
  EXPECT_DOUBLE_EQ(measure_spheres(scene)->extent, 6e200);
}

TEST(MeasureSpheres, HasNothingToSayOfNone) { EXPECT_FALSE(measure_spheres(render::Scene{})); }

TEST(EstimateMemory, AddsUpWhatGrowsWithTheSpheres) {
  render::Scene scene = three_spheres();
  scene.spheres.resize(3000);
  scene.shifts.resize(3000);
  const MemoryFigures memory = estimate_memory(scene, {.width = 100, .height = 50}, {});
  EXPECT_EQ(memory.spheres, 3000 * sizeof(render::Sphere));
  EXPECT_EQ(memory.motion, 3000 * sizeof(Vec3));
  EXPECT_EQ(memory.materials, 4 * sizeof(render::Material));
  EXPECT_EQ(memory.bvh, render::WideScene<double>::estimated_bytes(scene, render::Search::Bvh));
  EXPECT_EQ(memory.picture, 5000 * sizeof(render::LinearRgb));
  EXPECT_EQ(memory.total(), memory.spheres + memory.motion + memory.materials + memory.bvh +
                                5000 * sizeof(render::LinearRgb));
  EXPECT_DOUBLE_EQ(memory.per_sphere(3000),
                   static_cast<double>(memory.spheres + memory.motion + memory.bvh) / 3000);
}

}  // namespace
}  // namespace sdlc::cli
