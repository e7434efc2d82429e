#include "render/scene/coincident.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

TEST(FindCoincident, NamesTheFirstOfEqualSpheres) {
  const std::vector<Sphere> spheres{{{1, 2, 3}, 1, 0},
                                    {{0, 0, 0}, 1, 0},
                                    {{1, 2, 3}, 1, 1},
                                    {{1, 2, 3}, 2, 0},
                                    {{1, 2, 3}, 1, 2}};
  const auto found = find_coincident(spheres, {});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].sphere, 2u);
  EXPECT_EQ(found[0].earlier, 0u);
  EXPECT_TRUE(found[0].is_exact);
  EXPECT_EQ(found[1].sphere, 4u);
  EXPECT_EQ(found[1].earlier, 0u);
}

TEST(FindCoincident, ToleratesTwoToTheMinusFortyOfTheRadius) {
  for (const double scale : {1e-30, 1.0, 1e30}) {
    const double inside = scale * (1 + 0x1p-41), outside = scale * (1 + 0x1p-39);
    EXPECT_EQ(find_coincident({{{0, 0, 0}, scale}, {{0, 0, 0}, inside}}, {}).size(), 1u);
    EXPECT_EQ(find_coincident({{{0, 0, 0}, scale}, {{0, 0, 0}, outside}}, {}).size(), 0u);
    EXPECT_EQ(find_coincident({{{0, 0, 0}, scale}, {{0, scale * 0x1p-41, 0}, scale}}, {}).size(),
              1u);
    EXPECT_EQ(find_coincident({{{0, 0, 0}, scale}, {{0, scale * 0x1p-39, 0}, scale}}, {}).size(),
              0u);
  }
}

TEST(FindCoincident, ComparesMotionToo) {
  const std::vector<Sphere> spheres(3, Sphere{{1, 2, 3}, 1, 0});
  const auto found = find_coincident(spheres, {{0, 0, 0}, {0, 1, 0}, {0, 0, 0}});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].sphere, 2u);
}

TEST(FindCoincident, FindsPairsThatOnlyTheLastCoordinateTellsApart) {
  std::vector<Sphere> spheres;
  for (int copy = 0; copy < 2; ++copy) {
    for (int i = 0; i < 10000; ++i) spheres.push_back({{1, 2, i % 100 * 0.5}, 1.0 + i / 100, 0});
  }
  EXPECT_EQ(find_coincident(spheres, {}).size(), 10000u);
}

TEST(FindCoincident, AgreesWithComparingAllPairs) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < 400; ++i) {
    const double wobble = std::sin(i * 12.9898) * 0x1p-40;
    spheres.push_back({{(i % 5) * 1.0 + wobble, (i % 3) * 1.0, 0}, 1.0 + i % 2, 0});
  }
  std::vector<std::uint32_t> expected;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    const auto coincides = [&](std::uint32_t k) {
      const double tolerance = 0x1p-40 * spheres[k].radius;
      return std::fabs(spheres[k].center.x - spheres[i].center.x) <= tolerance &&
             spheres[k].center.y == spheres[i].center.y && spheres[k].radius == spheres[i].radius;
    };
    if (std::none_of(kept.begin(), kept.end(), coincides)) {
      kept.push_back(i);
    } else {
      expected.push_back(i);
    }
  }
  std::vector<std::uint32_t> found;
  for (const CoincidentSphere& pair : find_coincident(spheres, {})) found.push_back(pair.sphere);
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace sdlc::render
