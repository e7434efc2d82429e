#include "render/shading/optics.hpp"

#include <gtest/gtest.h>

#include "tests/support/statistics/scenes.hpp"

namespace sdlc::render {
namespace {

TEST(OpticsTable, HoldsOpticsOnceWhateverTheColor) {
  OpticsTable table;
  EXPECT_EQ(table.row_of(optics_of(test::specular({1, 0, 0}, 0.5))), 0u);
  EXPECT_EQ(table.row_of(optics_of(test::specular({0, 1, 0}, 0.25))), 1u);
  EXPECT_EQ(table.row_of(optics_of(test::specular({0, 0, 1}, 0.5))), 0u);
  EXPECT_EQ(table.row_of(optics_of(test::transmissive({1, 1, 1}, 0.5))), 2u);
  EXPECT_EQ(table.row_of(optics_of(test::transmissive({1, 1, 1}, 0.5, Fresnel::Exact))), 3u);
  EXPECT_EQ(table.rows().size(), 4u);
}

TEST(OpticsTable, TakesTheIntensityOfALightForPartOfItsColor) {
  EXPECT_EQ(optics_of(test::emissive({1, 1, 1}, 3)).parameter, 0);
  EXPECT_EQ(optics_of(test::emissive({1, 1, 1}, 3)).surface,
            optics_of(test::unlit({1, 1, 1})).surface);
}

TEST(OpticsTable, FindsEachOfManyAgain) {
  OpticsTable table;
  for (int pass = 0; pass < 2; ++pass) {
    for (std::uint32_t i = 0; i < 10'000; ++i) {
      ASSERT_EQ(table.row_of({.surface = kMirrors, .parameter = i * 1e-4}), i);
    }
  }
}

}  // namespace
}  // namespace sdlc::render
