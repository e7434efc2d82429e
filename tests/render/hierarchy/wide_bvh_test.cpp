#include "render/hierarchy/wide_bvh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "render/parallel/workers.hpp"
#include "render/session/render.hpp"
#include "tests/render/kernel/kernels.hpp"
#include "tests/support/reference/path_tracer.hpp"
#include "tests/support/statistics/random.hpp"
#include "tests/support/statistics/scenes.hpp"

// The BVH of the wide kernel: its structure, and that it finds the same hits as testing every
// sphere.
namespace sdlc::render {
namespace {

using test::Random;
using test::render_with;

struct NamedSpheres {
  std::string name;
  std::vector<Sphere> spheres;
  std::vector<Vec3> shifts = {};
};

/// Up to kMaxWideSpheres each, so that both searches support them.
std::vector<NamedSpheres> named_spheres() {
  Random random(3);
  std::vector<NamedSpheres> all;
  const auto add = [&](std::string name, int count, auto&& make) {
    NamedSpheres& added = all.emplace_back(NamedSpheres{.name = std::move(name), .spheres = {}});
    for (int i = 0; i < count; ++i) added.spheres.push_back(make(i));
  };
  add("one", 1, [](int) { return Sphere{{0.1, 0.2, 0.3}, 0.5}; });
  add("sixteen", 16, [&](int) { return Sphere{random.in_box(0.8), random.between(0.02, 0.2)}; });
  add("seventeen", 17, [&](int) { return Sphere{random.in_box(0.8), random.between(0.02, 0.2)}; });
  add("many", 250, [&](int) { return Sphere{random.in_box(0.8), random.between(0.002, 0.1)}; });
  add("nested", 60, [](int i) { return Sphere{{0, 0, 0}, 0.01 * (i + 1)}; });
  add("one centre", 200, [&](int) { return Sphere{{0.3, 0, 0}, random.between(0.01, 0.3)}; });
  add("equal", 100, [](int) { return Sphere{{0.25, 0.3, 0}, 0.25}; });
  add("on a line", 250, [](int i) { return Sphere{{i * 0.006 - 0.8, 0.1, 0}, 0.003}; });
  add("along an axis", 100, [](int i) { return Sphere{{0, 0, 0.5 - 0.01 * i}, 0.004}; });
  add("radii over twelve decades", 250, [&](int) {
    return Sphere{random.in_box(0.5), std::pow(10.0, random.between(-12, -0.5))};
  });
  add("some of no radius", 40, [&](int i) {
    return Sphere{random.in_box(0.5), i % 3 == 0 ? 0.0 : 0.05};
  });
  NamedSpheres moving{.name = "moving", .spheres = all[3].spheres};
  for (std::size_t i = 0; i < moving.spheres.size(); ++i) {
    moving.shifts.push_back(i % 3 == 0 ? random.in_box(0.3) : Vec3{});
  }
  all.push_back(std::move(moving));
  return all;
}

Scene scene_of(const NamedSpheres& named) {
  Scene scene = test::beam_scene({0.1, 0.2, 1.7}, {0, 0, 0}, LinearRgb{1});
  scene.background = {};
  scene.camera.plane_height = 1.3;
  for (const Sphere& sphere : named.spheres) {
    const double x = sphere.center.x, y = sphere.center.y;
    test::add_sphere(scene, sphere.center, sphere.radius,
                     scene.spheres.size() % 4 == 3
                         ? test::transmissive(LinearRgb{1}, 1.5)
                         : test::diffuse({0.5 + 0.4 * std::sin(9 * x), 0.5, 0.5 + 0.4 * y}));
  }
  scene.shifts = named.shifts;
  return scene;
}

template <typename T>
struct Walk {
  const WideBvh<T>& bvh;
  const Scene& scene;
  std::vector<int> seen;
  std::size_t deepest = 0;

  /// Every sphere has to be within all boxes above it.
  void visit(std::uint32_t child, const std::array<std::array<double, 2>, 3>& box,
             std::size_t depth) {
    deepest = std::max(deepest, depth);
    if ((child & WideBvh<T>::kLeaf) != 0) {
      const std::size_t first = (child & ~WideBvh<T>::kLeaf) * kBvhWidth;
      ASSERT_LE(first + kBvhWidth, bvh.slots.size());
      for (std::size_t slot = first; slot < first + kBvhWidth; ++slot) {
        if (bvh.slots[slot] == WideBvh<T>::kNoSphere) continue;
        ++seen[bvh.slots[slot]];
        EXPECT_TRUE(slot == first || bvh.slots[slot - 1] < bvh.slots[slot]);
        const Sphere& sphere = scene.spheres[bvh.slots[slot]];
        for (const double time : {0.0, 1.0}) {
          const Vec3 shift = scene.shifts.empty() ? Vec3{} : scene.shifts[bvh.slots[slot]];
          const Vec3 c = sphere.center + shift * time;
          const std::array<double, 3> center{c.x, c.y, c.z};
          for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_LT(box[axis][0], center[axis] - sphere.radius);
            EXPECT_GT(box[axis][1], center[axis] + sphere.radius);
          }
        }
      }
      return;
    }
    const auto& node = bvh.nodes[child];
    for (std::size_t i = 0; i < kBvhWidth; ++i) {
      if (node.bounds[0][0][i] > node.bounds[0][1][i]) continue;
      auto inner = box;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        inner[axis][0] = std::max<double>(inner[axis][0], node.bounds[axis][0][i]);
        inner[axis][1] = std::min<double>(inner[axis][1], node.bounds[axis][1][i]);
      }
      visit(node.children[i], inner, depth + 1);
    }
  }
};

template <typename T>
void expect_sound(const Scene& scene) {
  std::vector<std::uint32_t> members(scene.spheres.size());
  std::iota(members.begin(), members.end(), 0u);
  const WideBvh<T> bvh(scene, members);
  constexpr double kFar = 1e9;
  Walk<T> walk{.bvh = bvh, .scene = scene, .seen = std::vector<int>(members.size())};
  walk.visit(0, {{{-kFar, kFar}, {-kFar, kFar}, {-kFar, kFar}}}, 0);
  EXPECT_TRUE(std::ranges::all_of(walk.seen, [](int times) { return times == 1; }));
  EXPECT_LT(walk.deepest * (kBvhWidth - 1), WideBvh<T>::kMaxWaiting);
}

TEST(WideBvh, HoldsEachSphereOnceWithinAllBoxesAboveIt) {
  for (const NamedSpheres& named : named_spheres()) {
    SCOPED_TRACE(named.name);
    const Scene scene = scene_of(named);
    expect_sound<float>(scene);
    expect_sound<double>(scene);
  }
}

/// More than one thread handles at a time.
constexpr int kMany = 100'000;

std::vector<NamedSpheres> named_crowds() {
  Random random(5);
  std::vector<NamedSpheres> all;
  const auto add = [&](std::string name, auto&& make) {
    NamedSpheres& added = all.emplace_back(NamedSpheres{.name = std::move(name), .spheres = {}});
    for (int i = 0; i < kMany; ++i) added.spheres.push_back(make(i));
  };
  add("anywhere", [&](int) { return Sphere{random.in_box(0.8), random.between(0.001, 0.01)}; });
  add("one centre", [&](int) { return Sphere{{0.3, 0, 0}, random.between(0.01, 0.3)}; });
  add("equal", [](int) { return Sphere{{0.25, 0.3, 0}, 0.25}; });
  add("on a line", [](int i) { return Sphere{{i * 1.5e-5 - 0.8, 0.1, 0}, 3e-6}; });
  add("on a huge one", [&](int i) {
    if (i == kMany / 2) return Sphere{{0, -0.9, 0}, 0.9};
    const Vec3 place = random.in_box(0.5);
    return Sphere{{place.x * 1e-3, 1e-6, place.z * 1e-3}, 1e-6};
  });
  add("radii over twelve decades", [&](int) {
    return Sphere{random.in_box(0.5), std::pow(10.0, random.between(-12, -0.5))};
  });
  add("ever denser", [&](int) {
    return Sphere{random.in_box(1) * std::pow(10.0, random.between(-12, -0.5)), 1e-13};
  });
  NamedSpheres moving{.name = "moving", .spheres = all[0].spheres};
  for (int i = 0; i < kMany; ++i) {
    moving.shifts.push_back(i % 3 == 0 ? random.in_box(0.1) : Vec3{});
  }
  all.push_back(std::move(moving));
  return all;
}

Scene spheres_alone(const NamedSpheres& named) {
  Scene scene;
  scene.spheres = named.spheres;
  scene.shifts = named.shifts;
  return scene;
}

TEST(WideBvh, HoldsEachOfManySpheresOnceWithinAllBoxesAboveIt) {
  for (const NamedSpheres& named : named_crowds()) {
    SCOPED_TRACE(named.name);
    const Scene scene = spheres_alone(named);
    expect_sound<float>(scene);
    expect_sound<double>(scene);
  }
}

template <typename T>
WideBvh<T> built_with(int threads, const Scene& scene) {
  std::vector<std::uint32_t> members(scene.spheres.size());
  std::iota(members.begin(), members.end(), 0u);
  return Workers(threads).run([&] { return WideBvh<T>(scene, members); });
}

template <typename T>
void expect_equal(const WideBvh<T>& a, const WideBvh<T>& b) {
  EXPECT_TRUE(a.slots == b.slots);
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    different +=
        a.nodes[i].bounds != b.nodes[i].bounds || a.nodes[i].children != b.nodes[i].children;
  }
  EXPECT_EQ(different, 0u);
}

TEST(WideBvh, IsTheSameFromAnyNumberOfThreads) {
  for (const NamedSpheres& named : named_crowds()) {
    SCOPED_TRACE(named.name);
    const Scene scene = spheres_alone(named);
    const WideBvh<float> in_float = built_with<float>(1, scene);
    const WideBvh<double> in_double = built_with<double>(1, scene);
    for (const int threads : {2, 5}) {
      expect_equal(in_float, built_with<float>(threads, scene));
      expect_equal(in_double, built_with<double>(threads, scene));
    }
  }
}

// An almost empty box as large as the scene would be hit by every ray.
TEST(WideBvh, PutsAHugeSphereApart) {
  const NamedSpheres named = named_crowds()[4];
  const Scene scene = spheres_alone(named);
  const WideBvh<float> bvh = built_with<float>(2, scene);
  std::size_t large = 0;
  for (const auto& node : bvh.nodes) {
    for (std::size_t i = 0; i < kBvhWidth; ++i) {
      large += node.bounds[0][1][i] - node.bounds[0][0][i] > 1;
    }
  }
  EXPECT_EQ(large, 1u);
}

TEST(WideBvh, FillsLeavesWhereSpheresStandInRows) {
  Scene scene;
  for (int i = 0; i < 1024; ++i) {
    scene.spheres.push_back({{0.02 * (i % 32), 0.02 * (i / 32), 0}, 0.008});
  }
  std::vector<std::uint32_t> members(scene.spheres.size());
  std::iota(members.begin(), members.end(), 0u);
  EXPECT_LE(WideBvh<float>(scene, members).slots.size(), 1024 * 5 / 4);
}

TEST(WideBvh, IsEmptyWithoutSpheres) {
  const WideBvh<float> bvh(Scene{}, {});
  EXPECT_TRUE(bvh.nodes.empty());
  EXPECT_TRUE(bvh.slots.empty());
}

class BvhPaths : public testing::TestWithParam<test::WideForm> {};

// Both searches test spheres by the same operations: every bit has to be equal.
TEST_P(BvhPaths, AreThoseOfRaysHeldAgainstEverySphere) {
  constexpr RenderSettings kSettings{.width = 48, .height = 27, .samples = 40, .depth = 12};
  for (const NamedSpheres& named : named_spheres()) {
    const Scene scene = scene_of(named);
    KernelRequest request = GetParam().request();
    const RenderResult all = render_with(scene, kSettings, request);
    request.search = Search::Bvh;
    const RenderResult bvh = render_with(scene, kSettings, request);
    ASSERT_EQ(bvh.kernel.search, Search::Bvh);
    EXPECT_EQ(bvh.rays, all.rays) << named.name;
    std::size_t different = 0;
    for (std::size_t i = 0; i < all.picture.pixels.size(); ++i) {
      different += all.picture.pixels[i] != bvh.picture.pixels[i];
    }
    EXPECT_EQ(different, 0u) << named.name;
  }
}

/// Up to kMaxWideSpheres of a random kind, moving or not, on a large ground or not, seen from
/// outside or from among them.
Scene random_scene(unsigned seed) {
  Random random(seed);
  const auto choice = [&](int count) { return static_cast<int>(random.between(0, count)); };
  const int family = choice(6), count = 1 + choice(250);
  const Vec3 center = random.in_box(0.5), along = random.direction();
  const double decades = random.between(1, 12);
  NamedSpheres named{.name = "random", .spheres = {}};
  for (int i = 0; i < count; ++i) {
    const double radius = 0.3 * std::pow(10.0, -random.between(0, decades));
    switch (family) {
      case 0: named.spheres.push_back({random.in_box(0.7), random.between(0.01, 0.15)}); break;
      case 1: named.spheres.push_back({random.in_box(0.5), radius}); break;
      case 2: named.spheres.push_back({center, random.between(0.01, 0.3)}); break;  // nested
      case 3: named.spheres.push_back({center, i % 5 == 0 ? 0.2 : 0.1}); break;     // equal
      case 4: named.spheres.push_back({center + along * random.between(-1, 1), 0.02}); break;
      default:  // in pairs that touch
        named.spheres.push_back(
            i % 2 == 0 ? Sphere{random.in_box(0.7), 0.1}
                       : Sphere{named.spheres.back().center + random.direction() * 0.15, 0.05});
    }
  }
  if (choice(3) == 0) {
    for (int i = 0; i < count; ++i) named.shifts.push_back(choice(2) * random.in_box(0.3));
  }
  Scene scene = scene_of(named);
  scene.camera.from = choice(4) == 0 ? random.in_box(0.4) : random.direction() * 1.9;
  scene.camera.at = random.in_box(0.2) + Vec3{0, 0.01, 0};
  scene.camera.up = random.direction();
  if (choice(2) == 0 && count < 250) {
    test::add_sphere(scene, {0, -1001, 0}, 1000, test::diffuse({0.5, 0.5, 0.5}));
    if (!scene.shifts.empty()) scene.shifts.emplace_back();
  }
  return scene;
}

TEST_P(BvhPaths, AreThoseOfRaysHeldAgainstEverySphereOfRandomScenes) {
  constexpr RenderSettings kSettings{.width = 16, .height = 16, .samples = 6, .depth = 12};
  std::size_t mixed = 0, refused = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    const Scene scene = random_scene(seed);
    KernelRequest request = GetParam().request();
    const RenderResult all = render_with(scene, kSettings, request);
    mixed += all.kernel.precision == Precision::Mixed ? 1 : 0;
    refused += all.kernel.refusal ? 1 : 0;
    request.search = Search::Bvh;
    const RenderResult bvh = render_with(scene, kSettings, request);
    EXPECT_EQ(bvh.rays, all.rays) << seed;
    EXPECT_TRUE(bvh.picture.pixels == all.picture.pixels) << seed;
  }
  EXPECT_EQ(mixed > 50, GetParam().precision == Precision::Float) << mixed;
  EXPECT_EQ(refused, 0u);
}

// With the BVH, optics are looked up in tables that materials share.
TEST_P(BvhPaths, AreThoseOfRaysHeldAgainstEverySphereWhateverTheMaterials) {
  constexpr RenderSettings kSettings{.width = 48, .height = 27, .samples = 40, .depth = 12};
  Scene scene = scene_of(named_spheres()[3]);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(scene.materials.size());
    const LinearRgb color{0.9, 1 - share, 0.5};
    switch (i % 6) {
      case 0: scene.materials[i] = test::specular(color, 2 * share); break;
      case 1: scene.materials[i] = test::specular(color, 0); break;
      case 2: scene.materials[i] = test::transmissive(color, 1 + share); break;
      case 3: scene.materials[i] = test::transmissive(color, 1.5, Fresnel::Exact); break;
      case 4: scene.materials[i] = test::emissive(color, share); break;
      default: scene.materials[i] = test::diffuse(color);
    }
  }
  KernelRequest request = GetParam().request();
  const RenderResult all = render_with(scene, kSettings, request);
  request.search = Search::Bvh;
  const RenderResult bvh = render_with(scene, kSettings, request);
  EXPECT_EQ(bvh.rays, all.rays);
  EXPECT_TRUE(bvh.picture.pixels == all.picture.pixels);
}

INSTANTIATE_TEST_SUITE_P(Forms, BvhPaths, testing::ValuesIn(test::wide_forms()), test::form_name);

// Where surfaces touch, distances computed in float and in double are often equal.
TEST_P(BvhPaths, AreTheSameWhereASphereTouchesAGroundMetInDouble) {
  Scene scene = test::beam_scene({0, 10, 0}, {0, 0, 0}, LinearRgb{1});
  scene.camera.up = {0, 0, 1};
  scene.camera.plane_height = 0.00017;
  test::add_sphere(scene, {0, -100, 0}, 100, test::diffuse({1, 1, 1}));
  test::add_sphere(scene, {0, 1, 0}, 1, test::transmissive(LinearRgb{1}, 1.5));
  constexpr RenderSettings kSettings{.width = 16, .height = 16, .samples = 64, .depth = 20};
  KernelRequest request = GetParam().request();
  const RenderResult all = render_with(scene, kSettings, request);
  EXPECT_EQ(all.kernel.precision == Precision::Mixed, GetParam().precision == Precision::Float);
  request.search = Search::Bvh;
  const RenderResult bvh = render_with(scene, kSettings, request);
  EXPECT_EQ(bvh.rays, all.rays);
  EXPECT_TRUE(bvh.picture.pixels == all.picture.pixels);
}

// The middle column of the picture is in the plane of mirror symmetry: mirror images are hit at the
// same distance, and as they are far apart they are mostly in different leaves.
TEST_P(BvhPaths, TakeTheFirstOfSpheresAtOneDistance) {
  Random random(17);
  Scene scene = test::beam_scene({0, 0, 3}, {0, 0, 0}, LinearRgb{0});
  constexpr int kPairs = 120;
  for (int i = 0; i < kPairs; ++i) {
    const double y = 0.9 * (2.0 * i / kPairs - 1), z = random.between(-0.3, 0.3);
    const double apart = random.between(0.2, 0.5), side = random.between(-1, 1) > 0 ? 1 : -1;
    for (const double x : {side * apart, -side * apart}) {
      test::add_sphere(scene, {x, y, z}, apart + 0.03, test::unlit({x > 0 ? 1.0 : 0.0, 0.5, 0}));
    }
  }
  constexpr int kSide = 63;
  scene.camera.plane_height = kSide / 64.0;  // the middle of the column is 0 without rounding
  constexpr RenderSettings kSettings{.width = kSide, .height = kSide, .samples = 1, .depth = 2};
  KernelRequest request = GetParam().request();
  const RenderResult all = render_with(scene, kSettings, request);
  request.search = Search::Bvh;
  const RenderResult bvh = render_with(scene, kSettings, request);
  EXPECT_TRUE(bvh.picture.pixels == all.picture.pixels);
  int left = 0, right = 0;
  for (int row = 0; row < kSide; ++row) {
    const LinearRgb pixel = bvh.picture.at(kSide / 2, row);
    if (pixel.g > 0) ++(pixel.r > 0 ? right : left);
  }
  EXPECT_GT(std::min(left, right), 10) << "either is first now and then";
}

double largest_difference(const Picture& a, const Picture& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const LinearRgb d = a.pixels[i] - b.pixels[i];
    largest = std::max({largest, std::fabs(d.r), std::fabs(d.g), std::fabs(d.b)});
  }
  return largest;
}

/// With every sphere moved by up to 2 u E along each axis: the error of a point on it in double,
/// with the E of the farthest.
Scene moved_by_rounding(Scene scene, Random& random) {
  double extent = 0;
  for (const Sphere& sphere : scene.spheres) {
    extent = std::max(extent, length(sphere.center - scene.camera.from) + sphere.radius);
  }
  const double error = 2 * unit_of_rounding(Precision::Double) * extent;
  for (Sphere& sphere : scene.spheres) sphere.center += random.in_box(error);
  return scene;
}

// Beyond the limit for testing every sphere, compare with the reference.
TEST(BvhPaths, OfThousandsOfSpheresAreThoseOfTheReference) {
  Random random(11);
  NamedSpheres named{.name = "thousands", .spheres = {}};
  for (int i = 0; i < 5000; ++i) {
    named.spheres.push_back({random.in_box(0.8), random.between(0.002, 0.02)});
    named.shifts.push_back(i % 2 == 0 ? random.in_box(0.05) : Vec3{});
  }
  const Scene scene = scene_of(named);
  // A seed with which no path diverges because of it.
  constexpr RenderSettings kSettings{
      .width = 48, .height = 27, .samples = 16, .depth = 12, .seed = 2};
  const RenderResult reference = test::render_by_reference(scene, kSettings);
  // Reflections from such small spheres amplify the rounding error of the first point. The
  // reference shows by how much: in scenes whose spheres are moved by the error of points on them.
  // That is about 1e-6 here, five times the observed difference.
  double by_rounding = 0;
  for (int i = 0; i < 8; ++i) {
    const RenderResult moved =
        test::render_by_reference(moved_by_rounding(scene, random), kSettings);
    by_rounding = std::max(by_rounding, largest_difference(moved.picture, reference.picture));
  }
  ASSERT_LT(by_rounding, 1e-5);
  for (const Backend* backend : available_vectors()) {
    const RenderResult bvh =
        render_with(scene, kSettings,
                    {.search = Search::Bvh, .precision = Precision::Double, .backend = backend});
    EXPECT_LE(largest_difference(bvh.picture, reference.picture), by_rounding) << backend->name;
    EXPECT_EQ(bvh.rays, reference.rays);
  }
}

}  // namespace
}  // namespace sdlc::render
