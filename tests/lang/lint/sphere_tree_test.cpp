#include "lang/lint/sphere_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "lang/source/source.hpp"

// Compares the tree with all pairs, over spheres of many sizes that nest and overlap.
namespace sdlc::lang {
namespace {

/// Shows a test the spheres of a scene, some of them moving.
void with_spheres(const std::function<void(const LintContext&, SphereTree&)>& test) {
  const Document file("test.scene",
                      "scene 1\n"
                      "camera { from: (0, 0, 90), at: (0, 0, 0), fov: 40deg, shutter: 0s .. 1s }\n"
                      "for i in range(600) {\n"
                      "  let way = mod(i, 3) * time / 4s\n"
                      "  sphere {\n"
                      "    center: 7 * (random(i, 1) + way, random(i, 2), random(i, 3))\n"
                      "    radius: 0.05 + 4 * random(i, 4)^6\n"
                      "    material: transmissive(ior: 1.5 + mod(i, 2))\n"
                      "  }\n"
                      "}\n");
  DiagnosticSink sink;
  Compiler compiler(file, {}, sink);
  bool is_called = false;
  compiler.check([&](const LoweredScene& lowered) {
    is_called = true;
    const LintContext context(file, nullptr, compiler, lowered);
    std::vector<std::uint32_t> spheres(lowered.scene.spheres.size());
    std::iota(spheres.begin(), spheres.end(), 0);
    SphereTree tree(context, spheres);
    test(context, tree);
  });
  ASSERT_TRUE(is_called);
}

double distance(const LintContext& context, std::uint32_t a, std::uint32_t b) {
  return length(context.spheres()[a].center - context.spheres()[b].center);
}

TEST(SphereTree, FindsASphereAroundAnotherWhereThereIsOne) {
  with_spheres([](const LintContext& context, SphereTree& tree) {
    std::size_t inside = 0;
    for (std::uint32_t a = 0; a < context.spheres().size(); ++a) {
      bool is_there = false;
      for (std::uint32_t b = 0; b < context.spheres().size(); ++b) {
        is_there = is_there || (a != b && is_inside(context, a, b));
      }
      const auto found = tree.find_container(a);
      EXPECT_EQ(found.has_value(), is_there);
      EXPECT_TRUE(!found || is_inside(context, a, *found));
      if (is_there) ++inside;
    }
    EXPECT_GT(inside, 50u);
    EXPECT_LT(inside, context.spheres().size() - 50);
  });
}

TEST(SphereTree, FindsAnEarlierSphereThatCrossesWhereThereIsOne) {
  with_spheres([](const LintContext& context, SphereTree& tree) {
    std::size_t crossing = 0;
    for (std::uint32_t a = 0; a < context.spheres().size(); ++a) {
      const auto crosses = [&](std::uint32_t b) {
        const double of_a = context.spheres()[a].radius, of_b = context.spheres()[b].radius;
        const double apart = distance(context, a, b);
        const bool is_one_substance =
            context.material_of(a).parameter == context.material_of(b).parameter;
        return !is_one_substance && std::fabs(of_a - of_b) < apart && apart < of_a + of_b;
      };
      bool is_there = false;
      for (std::uint32_t b = 0; b < a; ++b) is_there = is_there || crosses(b);
      const auto found = tree.find_crossing(a);
      EXPECT_EQ(found.has_value(), is_there);
      EXPECT_TRUE(!found || (found->sphere < a && crosses(found->sphere)));
      if (is_there) ++crossing;
    }
    EXPECT_GT(crossing, 50u);
    EXPECT_LT(crossing, context.spheres().size() - 50);
  });
}

TEST(SphereTree, CountsTheSpheresAroundAPoint) {
  with_spheres([](const LintContext& context, SphereTree& tree) {
    std::size_t max_count = 0;
    for (const render::Sphere& point : context.spheres()) {
      std::size_t count = 0;
      for (const render::Sphere& other : context.spheres()) {
        if (length(other.center - point.center) < other.radius) ++count;
      }
      EXPECT_EQ(tree.count_containing(point.center), count);
      max_count = std::max(max_count, count);
    }
    EXPECT_GT(max_count, 5u);
  });
}

}  // namespace
}  // namespace sdlc::lang
