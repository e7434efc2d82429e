#include "render/exactness/suspects.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

constexpr int kSide = 50;
constexpr std::size_t kCount = kSide * kSide * kSide;

/// A lattice of spheres.
std::vector<Sphere> lattice(Vec3 origin, double distance, double radius) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      for (int k = 0; k < kSide; ++k) {
        const Vec3 place{i * distance, j * distance, k * distance};
        spheres.push_back({origin + place, radius, 0});
      }
    }
  }
  return spheres;
}

std::vector<Sphere> random_spheres(double radius_decades) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double radius = std::pow(10, (uniform(engine) - 0.5) * radius_decades);
    spheres.push_back({{uniform(engine), uniform(engine), uniform(engine)}, radius, 0});
  }
  return spheres;
}

// The reason for the search's speed: few spheres need the costly comparison.
TEST(FindSuspects, LeavesFewOfSpheresThatDoNotCoincide) {
  const auto share = [](const std::vector<Sphere>& spheres) {
    EXPECT_EQ(spheres.size(), kCount);
    return static_cast<double>(find_suspects(spheres).size()) / kCount;
  };
  EXPECT_LT(share(random_spheres(0)), 0.01);
  EXPECT_LT(share(random_spheres(12)), 0.01);
  for (const double distance : {1.0, 0.5, 0.3, 0.1, 0.01, 1.0 / 3, 1.0 / 7, 1000.0}) {
    for (const double radius : {0.04, 0.5, 1.0, 10.0, 1e6}) {
      EXPECT_LT(share(lattice({0, 0, 0}, distance, radius)), 0.01) << distance << ", " << radius;
    }
  }
  EXPECT_LT(share(lattice({1e9, -1e9, 0}, 0x1p-10, 1e-6)), 0.01);
  EXPECT_LT(share(lattice({0, 0, 0}, 1e-300, 1e-300)), 0.01);
  EXPECT_LT(share(lattice({0, 0, 0}, 1e300, 1e300)), 0.01);
}

TEST(FindSuspects, TellsConcentricSpheresApart) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < 100000; ++i) spheres.push_back({{1, 2, 3}, 1 + i * 1e-5, 0});
  EXPECT_LT(find_suspects(spheres).size(), spheres.size() / 100);
}

TEST(FindSuspects, NamesEachSphereOnceInTheirOrder) {
  std::vector<Sphere> spheres;
  std::vector<std::uint32_t> expected;
  for (std::uint32_t i = 0; i < 1 << 15; ++i) {
    // Every position in a cell, including its boundaries, where a sphere belongs to several cells.
    const double place = i * (1 + 0x1p-28);
    expected.insert(expected.end(), {2 * i, 2 * i + 1});
    spheres.insert(spheres.end(), 2, {{place, place, place}, 4096, 0});
  }
  EXPECT_EQ(find_suspects(spheres), expected);
}

}  // namespace
}  // namespace sdlc::render
