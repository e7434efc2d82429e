#include "render/exactness/coincident.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

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

/// The literal definition.
std::vector<CoincidentSphere> compare_all_pairs(const std::vector<Sphere>& spheres,
                                                const std::vector<Vec3>& shifts) {
  std::vector<CoincidentSphere> found;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    const auto difference = [&](std::uint32_t k) {
      const double most = std::fmax(max_abs(spheres[k].center - spheres[i].center),
                                    std::fabs(spheres[k].radius - spheres[i].radius));
      return shifts.empty() ? most : std::fmax(most, max_abs(shifts[k] - shifts[i]));
    };
    const auto earlier = std::find_if(kept.begin(), kept.end(), [&](std::uint32_t k) {
      return difference(k) <= 0x1p-40 * spheres[k].radius;
    });
    if (earlier == kept.end()) {
      kept.push_back(i);
    } else {
      found.push_back({.sphere = i, .earlier = *earlier, .is_exact = difference(*earlier) == 0});
    }
  }
  return found;
}

/// Spheres with neighbours at distances around the tolerance.
class NearlyCoincidentSpheres {
 public:
  explicit NearlyCoincidentSpheres(std::uint64_t seed) : engine_(seed) {}

  /// Around `places` spheres, each coordinate of which is one of a few, or unique.
  void make(int count, int places, double radius_decades, bool is_moving) {
    std::vector<Sphere> place;
    for (int i = 0; i < places; ++i) {
      const double radius = std::pow(10, (uniform() - 0.5) * radius_decades);
      place.push_back({{coordinate(radius), coordinate(radius), coordinate(radius)}, radius, 0});
    }
    for (int i = 0; i < count; ++i) {
      const Sphere& near = place[whole(places)];
      const auto moved = [&](double x) { return x + step() * near.radius; };
      spheres.push_back({{moved(near.center.x), moved(near.center.y), moved(near.center.z)},
                         moved(near.radius),
                         0});
      if (is_moving) shifts.push_back({step() * near.radius, whole(2) == 0 ? 1.0 : 1.5, 0});
    }
  }

  std::vector<Sphere> spheres;
  std::vector<Vec3> shifts;

 private:
  double uniform() { return std::uniform_real_distribution<double>(0, 1)(engine_); }
  std::size_t whole(int below) { return engine_() % static_cast<std::size_t>(below); }
  double coordinate(double radius) {
    const double scale = whole(2) == 0 ? 1 : radius * 100;
    return scale * (whole(2) == 0 ? static_cast<double>(whole(3)) - 1 : uniform());
  }
  /// Halves of the tolerance, or the last bit of 1.
  double step() { return whole(4) == 0 ? 0x1p-52 : (static_cast<double>(whole(7)) - 3) * 0x1p-41; }

  std::mt19937_64 engine_;
};

TEST(FindCoincident, AgreesWithComparingAllPairs) {
  std::uint64_t seed = 0;
  for (const int places : {1, 10, 300}) {
    for (const double radius_decades : {0.0, 1.0, 12.0, 500.0}) {
      for (const bool is_moving : {false, true}) {
        for (int repeat = 0; repeat < 10; ++repeat) {
          NearlyCoincidentSpheres scene(++seed);
          scene.make(400, places, radius_decades, is_moving);
          const auto expected = compare_all_pairs(scene.spheres, scene.shifts);
          EXPECT_FALSE(expected.empty());
          EXPECT_EQ(find_coincident(scene.spheres, scene.shifts), expected) << "seed " << seed;
        }
      }
    }
  }
}

/// Pairs at the tolerance from each other and far from all other pairs. Their positions advance
/// along `way` (in x, y, z and radius) in steps of the tolerance, because any grid has cell
/// boundaries somewhere. `apart` leads from the first sphere of a pair to the second.
std::vector<Sphere> pairs_along(std::array<int, 4> way, std::array<int, 4> apart, double radius) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < 1 << 15; ++i) {
    const auto at = [&](int axis, double begin, int second) {
      return begin + (way[axis] * i + second * apart[axis]) * 0x1p-40;
    };
    for (const int second : {0, 1}) {
      spheres.push_back({{at(0, 0, second), at(1, i * 0x1p-12, second), at(2, 0, second)},
                         at(3, radius, second)});
    }
  }
  return spheres;
}

TEST(FindCoincident, FindsPairsWhereverTheyAre) {
  const auto expect_all = [](const std::vector<Sphere>& spheres) {
    const auto found = find_coincident(spheres, {});
    ASSERT_EQ(found.size(), spheres.size() / 2);
    for (std::uint32_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i], (CoincidentSphere{2 * i + 1, 2 * i, false}));
    }
  };
  for (const int x : {-1, 0, 1}) {
    for (const int y : {-1, 0, 1}) {
      expect_all(pairs_along({1, 1, 1, 0}, {x, y, 1, 0}, 1));
      expect_all(pairs_along({1, 1, 1, 0}, {x, y, -1, 0}, 1));
    }
  }
  for (const double radius : {1.0, 2 - 0x1p-26}) {  // from, and beyond, a power of two
    expect_all(pairs_along({0, 0, 0, 1}, {0, 0, 0, 1}, radius));
    expect_all(pairs_along({0, 0, 0, 1}, {1, -1, 0, -1}, radius));
  }
}

}  // namespace
}  // namespace sdlc::render
