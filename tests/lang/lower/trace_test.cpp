#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/compilation/compilation.hpp"

// Traces spheres back to their source, although none stores it.
namespace sdlc::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::string kCamera = "camera { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n";

std::string ball(const std::string& name, const std::string& center,
                 const std::string& radius = "1") {
  return "sphere " + name + " { center: " + center + ", radius: " + radius +
         ", material: unlit(red) }\n";
}

std::vector<std::string> names_of(const std::vector<lang::Origin>& origins) {
  std::vector<std::string> names;
  for (const lang::Origin& origin : origins) names.push_back(origin.name);
  return names;
}

/// The names of the spheres of the scene lowered last, traced together.
std::vector<std::string> traced_names(Compilation& compilation, std::size_t count) {
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0u);
  return names_of(compilation.compiler().trace(all));
}

std::vector<std::string> chain_of(const lang::Origin& origin) {
  std::vector<std::string> chain;
  for (const lang::ChainLink& link : origin.chain) chain.push_back(link.message);
  return chain;
}

TEST(Trace, FindsSpheresByTheirIndices) {
  Compilation compilation({.root = kCamera + ball("a", "(0, 0, 0)") + ball("b", "(3, 0, 0)") +
                                   "group { " + ball("c", "(6, 0, 0)") + "}" +
                                   ball("d", "(9, 0, 0)")});
  ASSERT_TRUE(compilation.lower());
  EXPECT_THAT(traced_names(compilation, 4), ElementsAre("a", "b", "c", "d"));
  const std::vector<std::uint32_t> some{1, 3};
  const auto origins = compilation.compiler().trace(some);
  EXPECT_THAT(names_of(origins), ElementsAre("b", "d"));
  EXPECT_EQ(origins[0].where.file->position(origins[0].where.span.begin).line, 4u);
  EXPECT_EQ(origins[0].where.file->text(origins[0].where.span), "sphere");
  EXPECT_THAT(compilation.compiler().trace({}), IsEmpty());
}

TEST(Trace, CountsPastSpheresThatWereLeftOut) {
  Compilation compilation({.root = kCamera + ball("a", "(0, 0, 0)") + ball("a2", "(0, 0, 0)") +
                                   ball("a3", "(0, 0, 0)") + ball("b", "(3, 0, 0)") +
                                   ball("never", "(4, 0, 0)", "0") + ball("c", "(6, 0, 0)") +
                                   ball("b2", "(3, 0, 0)") + ball("d", "(9, 0, 0)") +
                                   ball("a4", "(0, 0, 0)")});
  const auto lowered = compilation.lower();
  ASSERT_TRUE(lowered);
  ASSERT_EQ(lowered->scene.spheres.size(), 4u);
  EXPECT_THAT(traced_names(compilation, 4), ElementsAre("a", "b", "c", "d"));
  for (const auto& [index, name] : {std::pair(0u, "a"), {1u, "b"}, {2u, "c"}, {3u, "d"}}) {
    const std::vector<std::uint32_t> one{index};
    EXPECT_THAT(names_of(compilation.compiler().trace(one)), ElementsAre(name));
  }
}

TEST(Trace, CountsPastDuplicatesAtTheBeginningAndInARow) {
  std::string text = kCamera;
  std::vector<std::string> kept;
  // Every third sphere is new; the others repeat the first.
  for (int i = 0; i < 60; ++i) {
    const bool is_new = i % 3 == 0;
    const std::string name = "s" + std::to_string(i);
    if (is_new) kept.push_back(name);
    text += ball(name, "(" + std::to_string(is_new ? 3 * i : 0) + ", 0, 0)");
  }
  Compilation compilation({.root = text});
  const auto lowered = compilation.lower();
  ASSERT_TRUE(lowered);
  ASSERT_EQ(lowered->scene.spheres.size(), kept.size());
  EXPECT_EQ(traced_names(compilation, kept.size()), kept);
}

TEST(Trace, ShowsTheChainThroughInstancesLoopsAndFiles) {
  Compilation compilation(
      {.root = kCamera + "def pair(x) { for i in range(2) { " + ball("in", "(x, 3 * i, 0)") +
               "} }\nfor x in [0, 5] { pair { x: x } }\ngroup g { include \"a.scene\" }",
       .files = {{"a.scene", ball("out", "(50, 0, 0)")}}});
  ASSERT_TRUE(compilation.lower());
  const std::vector<std::uint32_t> wanted{3, 4};
  const auto origins = compilation.compiler().trace(wanted);
  ASSERT_EQ(origins.size(), 2u);
  EXPECT_THAT(chain_of(origins[0]), ElementsAre("with i = 1", "in `pair`", "with x = 5"));
  EXPECT_EQ(origins[1].name, "out");
  EXPECT_EQ(origins[1].where.file->name(), "a.scene");
  EXPECT_THAT(chain_of(origins[1]), ElementsAre("included", "in group `g`"));
}

TEST(Trace, IsOfTheFrameAndCameraLoweredLast) {
  const std::string text =
      "camera still { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
      "camera later { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg, shutter: 9s .. 10s }\n"
      "animation { frames: 0 .. 9, fps: 1 } let t = time / 1s\n"
      "if floor(t) == 3 { " +
      ball("three", "(0, 0, 0)") + "} else if t >= 9 { " + ball("nine", "(0, 0, 0)") + "} else { " +
      ball("other", "(0, 0, 0)") + "}";
  Compilation compilation({.root = text});
  const std::vector<std::uint32_t> first{0};
  ASSERT_TRUE(compilation.lower({.render = {{lang::render_property::kCamera, "still"}}}, 3));
  EXPECT_THAT(names_of(compilation.compiler().trace(first)), ElementsAre("three"));
  ASSERT_TRUE(compilation.lower({.render = {{lang::render_property::kCamera, "still"}}}, 4));
  EXPECT_THAT(names_of(compilation.compiler().trace(first)), ElementsAre("other"));
  ASSERT_TRUE(compilation.lower({.render = {{lang::render_property::kCamera, "later"}}}, 4));
  EXPECT_THAT(names_of(compilation.compiler().trace(first)), ElementsAre("nine"));
}

TEST(Trace, ReportsNothingAgain) {
  Compilation compilation({.root = kCamera + ball("a", "(0, 0, 0)") + ball("b", "(0, 0, 0)") +
                                   ball("c", "(5, 0, 0)", "0")});
  ASSERT_TRUE(compilation.lower());
  EXPECT_THAT(compilation.codes(), ElementsAre("W401", "W402"));
  traced_names(compilation, 1);
  EXPECT_THAT(compilation.codes(), ElementsAre("W401", "W402"));
}

TEST(Duplicates, AreReportedWithTheirChainThroughInstances) {
  const auto told =
      told_about({.root = kCamera + "def dot(x) { " + ball("", "(x, 0, 0)") +
                          "}\nfor i in [0, 7] { dot { x: 0, translate: (i, 0, 0) } }\n"
                          "group { translate: (5, 0, 0) dot { x: 2 } }"});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].code, "W401");
  EXPECT_EQ(told[0].at, "sphere");
  EXPECT_THAT(told[0].chain, ElementsAre("in `dot`: dot", "in a group: group"));
  EXPECT_THAT(told[0].labels, ElementsAre("the earlier one, which is kept: sphere"));
}

TEST(Duplicates, OfOneStatementAreOneWarning) {
  // The 10^4 pairs have a single source location; reporting each would hide the rest.
  const auto told = told_about({.root = kCamera + "for i in range(100) { for j in range(100) { " +
                                        ball("", "(floor(i / 50), 0, 0)", "0.1") + "} }"});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].code, "W401");
  EXPECT_THAT(told[0].chain, ElementsAre("with j = 1: j", "with i = 0: i"));
}

TEST(Duplicates, OfOneStatementDoNotHideThoseOfAnother) {
  const auto told =
      told_about({.root = kCamera + "for i in range(200) { " + ball("many", "(0, 0, 0)") + "}\n" +
                          ball("other", "(5, 0, 0)") + ball("other", "(5, 0, 0)")});
  EXPECT_EQ(told.size(), 2u);
}

TEST(Duplicates, OfManyStatementsAreReportedUpToTheLimit) {
  std::string text = kCamera;
  for (int i = 0; i < 80; ++i) text += ball("", "(0, 0, 0)");
  Compilation compilation({.root = text});
  const auto lowered = compilation.lower();
  ASSERT_TRUE(lowered);
  EXPECT_EQ(lowered->scene.spheres.size(), 1u);
  EXPECT_EQ(compilation.codes().size(), 50u);
}

}  // namespace
}  // namespace sdlc::test
