#include "lang/lower/group_repeats.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/eval/eval.hpp"
#include "lang/lower/scene_builder.hpp"
#include "lang/report/findings.hpp"
#include "render/scene/instances.hpp"
#include "tests/support/compilation/compilation.hpp"

// Repeated contents of a def are added from a record, or stored once: the scene equals the
// evaluation of every call.
namespace sdlc::test {
namespace {

using lang::Instancing;
using render::Scene;
using render::Sphere;
using render::Vec3;
using testing::ElementsAre;
using testing::IsEmpty;

/// A builder that accepts repetitions, and counts the objects that it was given one by one.
class Builder final : public lang::ObjectSink {
 public:
  Builder(lang::SceneBuilder& builder, bool tells_repetitions)
      : builder_(builder), tells_repetitions_(tells_repetitions) {}

  void add(const lang::Object& object) override {
    builder_.add(object);
    ++added;
  }
  void enter(const lang::Object& group) override { builder_.enter(group); }
  void leave() override { builder_.leave(); }
  bool wants_contents() const override { return tells_repetitions_; }
  void begin_contents(std::uint32_t contents) override { builder_.begin_contents(contents); }
  bool repeat(const lang::Object& group, std::uint32_t contents) override {
    return builder_.repeat(group, contents);
  }

  std::size_t added = 0;

 private:
  lang::SceneBuilder& builder_;
  bool tells_repetitions_;
};

struct Built {
  Scene scene;
  std::size_t added;
  std::vector<std::string> codes;
  bool has_duplicates;
};

const std::string kCamera =
    "camera { from: (0, 0, 50), at: (0, 0, 0), fov: 40deg, shutter: 0 .. 1 }\n";

const std::string kRow =
    "def row(n) { for i in range(n) { sphere { center: (i, 0, 0), radius: 0.1,\n"
    "  material: unlit(red) } } }\n";

Built build(const std::string& text, bool tells_repetitions, Instancing instancing,
            const lang::Limits& limits = {}) {
  const lang::Document file("test.scene", "scene 1\n" + kCamera + text);
  lang::DiagnosticSink sink;
  lang::SceneBuilder builder(file, limits, sink, lang::Purpose::Picture, instancing);
  Builder objects(builder, tells_repetitions);
  lang::Program program(file, {.limits = limits}, sink);
  lang::Evaluation(program, {}, sink).run(objects);
  Built built{.scene = builder.finish({}).scene,
              .added = objects.added,
              .codes = {},
              .has_duplicates = !builder.dropped().empty()};
  for (const lang::Diagnostic* diagnostic : select_findings(sink).shown) {
    built.codes.emplace_back(diagnostic->info->code);
  }
  return built;
}

Built evaluated_fully(const std::string& text) { return build(text, false, Instancing::Never); }

void expect_same_scene(const std::string& text) {
  const Built full = evaluated_fully(text), repeated = build(text, true, Instancing::Never);
  EXPECT_EQ(repeated.codes, full.codes) << text;
  EXPECT_EQ(repeated.scene.spheres, full.scene.spheres) << text;
  EXPECT_EQ(repeated.scene.shifts, full.scene.shifts) << text;
  EXPECT_EQ(repeated.scene.materials, full.scene.materials) << text;
  EXPECT_THAT(repeated.scene.instances, IsEmpty());
}

/// Spheres in a canonical order, with the rounding errors of instances removed.
using Row = std::tuple<double, double, double, double, double, double, double, double, double>;
std::vector<Row> rows_of(const Scene& scene) {
  // No simple number is half-way between two steps.
  const auto rounded = [](double v) { return std::round(v * 0x1p24 + 0.3137); };
  std::vector<Row> rows;
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
    const Sphere& sphere = scene.spheres[i];
    const Vec3 shift = scene.shifts.empty() ? Vec3{} : scene.shifts[i];
    const render::Material& material = scene.materials[sphere.material];
    rows.emplace_back(rounded(sphere.center.x), rounded(sphere.center.y), rounded(sphere.center.z),
                      rounded(sphere.radius), rounded(shift.x), rounded(shift.y), rounded(shift.z),
                      material.color.r, material.parameter);
  }
  std::ranges::sort(rows);
  return rows;
}

/// The number of spheres in instances.
std::size_t expect_same_spheres(const std::string& text) {
  const Built full = evaluated_fully(text), held_once = build(text, true, Instancing::Always);
  EXPECT_EQ(held_once.codes, full.codes) << text;
  const std::vector<Row> rows = rows_of(without_instances(held_once.scene)),
                         expected = rows_of(full.scene);
  EXPECT_EQ(rows.size(), expected.size()) << text;
  const auto [row, wanted] = std::ranges::mismatch(rows, expected);
  if (row != rows.end() && wanted != expected.end()) {
    ADD_FAILURE() << testing::PrintToString(*row) << " is not " << testing::PrintToString(*wanted)
                  << '\n'
                  << text;
  }
  EXPECT_EQ(count_spheres(held_once.scene), full.scene.spheres.size()) << text;
  return held_once.scene.instances.size();
}

const std::vector<std::string> kTexts{
    // A call after an equal one, a call after another one.
    "def ball(r) { sphere { center: (r, 0, 0), radius: r, material: unlit(red) } }\n"
    "ball { r: 1 }\nball { r: 1, translate: (9, 0, 0) }\nball { r: 2, translate: (3, 9, 0) }\n"
    "ball { r: 1, translate: (0, 9, 3), rotate: (10deg, 20deg, 30deg), scale: 2 }\n",
    // Materials from outside, inside and both.
    "def pair() { sphere { center: (0, 0, 0), radius: 1 }\n"
    "  sphere { center: (3, 0, 0), radius: 1, material: unlit(blue) } }\n"
    "pair { material: unlit(red) }\npair { material: unlit(green), translate: (0, 5, 0) }\n"
    "group { material: unlit(white)\n  pair { translate: (0, 10, 0) } }\n"
    "pair { material: unlit(red), translate: (0, 15, 0) }\n",
    // Groups and defs nested in each other, before and after spheres.
    "def leaf(k) { sphere { center: (k, 0, 0), radius: 0.1 } }\n"
    "def twig(n) { group { translate: (0, 0, 1), rotate: (0deg, 45deg, 0deg)\n"
    "    for i in range(n) { leaf { k: 1, translate: (0, i, 0) } }\n"
    "    group { scale: 2\n leaf { k: 2 } } }\n"
    "  sphere { center: (0, 0, 0), radius: 0.3, material: unlit(blue) }\n"
    "  leaf { k: 2, translate: (0, 0, -3), material: unlit(green) } }\n"
    "for x in range(4) { twig { n: 2 + mod(x, 2), translate: (4 * x, 0, 0), material: unlit(red),\n"
    "  scale: 1 + x / 8 } }\n",
    // Motion of spheres in a def, of the def, of both; and rotation.
    "def drop() { sphere { center: (0, time * 1m / 1s, 0), radius: 0.5 }\n"
    "  sphere { center: (2, 0, 0), radius: 0.5 } }\n"
    "group { material: unlit(red)\n drop {}\n drop { translate: (5, 0, 0) }\n"
    "  drop { translate: (10m + time * 3m / 1s, 0, 0), rotate: (0deg, 30deg, 0deg) }\n"
    "  drop { translate: (0, 9, 0), rotate: (0deg, time * 90deg / 1s, 0deg) }\n"
    "  drop { translate: (5, 9, 0) } }\n",
    // Arguments that change while the shutter is open, defaults, and recursion.
    "def at(p, r = 0.1 * p.x / 1m) { sphere { center: p, radius: r, material: unlit(red) } }\n"
    "def flake(n) { sphere { center: (0, 0, 0), radius: 1, material: unlit(blue) }\n"
    "  if n > 0 { for i in range(3) { flake { n: n - 1, scale: 0.4, rotate: (0deg, 0deg, i * "
    "120deg),\n    translate: (1.5 * cos(i * 120deg), 1.5 * sin(i * 120deg), 0) } } } }\n"
    "at { p: (1, 0, 0) }\nat { p: (1, 0, 0), translate: (5, 0, 0) }\n"
    "at { p: (1m + time * 1m / 1s, 0, 0), r: 1, translate: (9, 0, 0) }\n"
    "at { p: (1m + time * 1m / 1s, 0, 0), r: 1, translate: (9, 5, 0) }\nflake { n: 4 }\n"
    "flake { n: 3, translate: (0, 20, 0) }\n",
    // With an individual motion.
    "def ball() { sphere { center: (0, 0, 0), radius: 1, material: unlit(red),\n"
    "  motion: line((0, 1, 0), over: 0 .. 1) } }\n"
    "ball {}\nball { translate: (5, 0, 0) }\nball { translate: (9, 0, 0), scale: 2 }\n",
    // One that holds nothing.
    "def nothing(n) { for i in range(n) { sphere { center: (i, 0, 0), radius: 1, material: "
    "unlit(red) } } }\nnothing { n: 0 }\nnothing { n: 0 }\nnothing { n: 1 }\n",
    // In blocks: contents that depend on locals around the def, themselves or through others, also
    // while the shutter is open.
    "def row(h) { def ball(r) { sphere { center: (0, h, 0), radius: r, material: unlit(red) } }\n"
    "  ball { r: 1 }\nball { r: 1, translate: (5, 0, 0) } }\n"
    "row { h: 0 }\nrow { h: 9m }\nrow { h: 20m + time * 3m / 1s }\n"
    "for i in range(3) {\n  fn high() = 5 * i\n"
    "  def dot() { sphere { center: (20, high(), 0), radius: 0.1, material: unlit(red) } }\n"
    "  def outer(n) { def inner() { if n > 0 { outer { n: n - 1, translate: (0, 0, 1) } } }\n"
    "    sphere { center: (30, i, 0), radius: 0.1, material: unlit(red) }\n    inner { } }\n"
    "  dot {}\ndot { translate: (0, 0, 3) }\nouter { n: 2 }\nouter { n: 2, translate: (5, 0, 0) }\n"
    "}\n",
};

TEST(GroupRepeats, AddTheSpheresThatEvaluationAdds) {
  for (const std::string& text : kTexts) {
    EXPECT_THAT(evaluated_fully(text).codes, IsEmpty()) << text;
    expect_same_scene(text);
  }
}

TEST(GroupRepeats, HeldOnceAreTheSameSpheres) {
  std::vector<std::size_t> instances;
  for (const std::string& text : kTexts) instances.push_back(expect_same_spheres(text));
  EXPECT_THAT(instances, ElementsAre(2, 3, 9, 3, 11, 0, 0, 6));
}

/// Defs that call earlier ones, with few different arguments.
std::string random_program(std::mt19937& random) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto place = [&] {
    return fmt::format("translate: ({}, {}, {}m{})", below(40), below(40), below(40),
                       below(6) == 0 ? " + time * 2m / 1s" : "");
  };
  const auto turn = [&] {
    return below(3) == 0 ? fmt::format(", rotate: ({}deg, {}deg, 0deg), scale: {}", below(90),
                                       below(90), 0.5 + 0.25 * below(4))
                         : std::string();
  };
  const auto material = [&] {
    static constexpr std::array kColors{"red", "green", "blue"};
    return below(3) == 0 ? fmt::format(", material: unlit({})", kColors[below(3)]) : std::string();
  };
  std::string text;
  const auto call = [&](int defs) {
    return fmt::format("d{} {{ n: {}, {}{}{} }}\n", below(defs), below(3), place(), turn(),
                       material());
  };
  constexpr int kDefs = 4;
  for (int def = 0; def < kDefs; ++def) {
    text += fmt::format("def d{}(n) {{\n", def);
    for (int i = 0; i <= below(3); ++i) {
      text += fmt::format("sphere {{ center: ({}, n, {}), radius: 0.{}{} }}\n", below(9), below(9),
                          1 + below(8), material());
      if (def > 0) text += call(def);
      if (def > 0 && below(2) == 0) {
        text += fmt::format("group {{ {}{}\n{}}}\n", place(), material(), call(def));
      }
      if (def > 0) {
        text += fmt::format(
            "group {{ translate: (0, 3 * n, 0)\nfor i in range(n) {{ group {{ "
            "translate: (i, 0, 0)\n{} }} }} }}\n",
            call(def));
      }
    }
    text += "}\n";
  }
  text += "group { material: unlit(white)\n";
  for (int i = 0; i < 12; ++i) text += call(kDefs);
  return text + "}\n";
}

TEST(GroupRepeats, OfRandomProgramsAreWhatEvaluationMakes) {
  std::size_t instances = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    const std::string text = random_program(random);
    expect_same_scene(text);
    // Duplicates are only removed among plain spheres.
    if (!evaluated_fully(text).has_duplicates) instances += expect_same_spheres(text);
  }
  EXPECT_GT(instances, 500u);
}

TEST(GroupRepeats, AreNotEvaluatedAgain) {
  const std::string cluster =
      "def cluster(s) { for i in range(10) { sphere { center: (random(i, s), i, 0), radius: 0.1,\n"
      "  material: unlit(red) } } }\n";
  EXPECT_EQ(
      build(cluster + "for x in range(100) { cluster { s: mod(x, 3), translate: (x, 0, 0) } }",
            true, Instancing::Never)
          .added,
      31u)
      << "three clusters and the camera";
  EXPECT_EQ(build(cluster + "for x in range(100) { cluster { s: x, translate: (x, 0, 0) } }", true,
                  Instancing::Never)
                .added,
            1001u);
}

TEST(GroupRepeats, TellWhatIsWrongOfEachCall) {
  // Errors of values, of positions and of missing parts.
  for (const char* text : {
           "def ball(r) { sphere { center: (0, 0, 0), radius: r, material: unlit(red) } }\n"
           "ball { r: -1 }\nball { r: -1 }\n",
           "def ball() { sphere { center: (0, 0, 0), radius: 1e200, material: unlit(red) } }\n"
           "ball {}\nball { scale: 1e200 }\nball { scale: 1e100, translate: (1, 0, 0) }\n",
           "def ball() { sphere { center: (0, 0, 0), radius: 1 } }\n"
           "ball { material: unlit(red) }\nball { translate: (5, 0, 0) }\n",
           "def ball() { sphere { center: (0, 0, 0), radius: 0, material: unlit(red) } }\n"
           "ball {}\nball { translate: (5, 0, 0) }\n",
       }) {
    const Built full = evaluated_fully(text);
    EXPECT_FALSE(full.codes.empty()) << text;
    EXPECT_EQ(build(text, true, Instancing::Never).codes, full.codes) << text;
    EXPECT_EQ(build(text, true, Instancing::Always).codes, full.codes) << text;
  }
}

TEST(GroupRepeats, AreInstancesInLargeScenesThatSaveMemoryByThem) {
  const auto counts_of = [](const std::string& text) {
    const Built built = build(text, true, Instancing::Auto);
    EXPECT_THAT(built.codes, IsEmpty());
    return std::tuple(built.scene.spheres.size(), built.scene.prototypes.size(),
                      built.scene.instances.size());
  };
  const std::string defs =
      kRow + "def rows(n) { for i in range(n) { row { n: 1000, translate: (0, i, 0) } } }\n";
  EXPECT_EQ(counts_of(defs + "for x in range(1000) { row { n: 1000, translate: (0, x, 0) } }"),
            std::tuple(1'000'000u, 0u, 0u));
  EXPECT_EQ(counts_of(defs + "for x in range(3000) { row { n: 1000, translate: (0, x, 0) } }"),
            std::tuple(1'049'000u, 1u, 1951u));
  // An instance of two spheres takes no less memory.
  EXPECT_EQ(counts_of(defs + "for x in range(1000000) { row { n: 2, translate: (0, x, 0) } }"),
            std::tuple(2'000'000u, 0u, 0u));
  // Each of the rows is one prototype; all rows together are none, because they are not placed
  // often enough.
  EXPECT_EQ(counts_of(defs + "for x in range(4) { rows { n: 1500, translate: (0, 0, x) } }"),
            std::tuple(1'049'000u, 1u, 4951u));
}

TEST(GroupRepeats, AreNotWorthItBesideManyMorePlainSpheres) {
  const Built built = build(
      "def few() { for i in range(5) { sphere { center: (i, 9, 0), radius: 0.1, material: "
      "unlit(red) } } }\n"
      "for i in range(1100000) { sphere { center: (i, 0, 0), radius: 0.1, material: unlit(red) } "
      "}\n"
      "for x in range(1000) { few { translate: (0, 0, x) } }",
      true, Instancing::Auto);
  EXPECT_EQ(built.scene.spheres.size(), 1'105'000u);
  EXPECT_THAT(built.scene.instances, IsEmpty());
}

TEST(GroupRepeats, HaveAPrototypeForEachMaterialFromOutside) {
  const Built built = build(
      "def pair() { for i in range(4) { sphere { center: (i, 0, 0), radius: 0.1 } } }\n"
      "for x in range(30) { pair { translate: (0, x, 0), material: if mod(x, 3) == 0 then "
      "unlit(red) "
      "else unlit(blue) } }",
      true, Instancing::Always);
  EXPECT_THAT(built.codes, IsEmpty());
  EXPECT_EQ(built.scene.prototypes.size(), 2u);
  EXPECT_EQ(built.scene.instances.size(), 29u);
}

TEST(GroupRepeats, InOnePlaceAreOneTooMany) {
  const std::string row = kRow +
                          "for x in range(4) { row { n: 100, translate: (0, mod(x, 2), 0) } }\n"
                          "row { n: 100, translate: (0, 1, 0), rotate: (0deg, 90deg, 0deg) }\n"
                          "sphere last { center: (0, 50, 0), radius: 1, material: unlit(red) }\n";
  const Built held_once = build(row, true, Instancing::Always);
  EXPECT_THAT(held_once.codes, ElementsAre("W401"));
  EXPECT_EQ(held_once.scene.instances.size(), 2u);
  EXPECT_EQ(count_spheres(held_once.scene), 301u);
  const Built plain = build(row, true, Instancing::Never);
  EXPECT_EQ(plain.scene.spheres.size(), 300u) << "one is dropped as a duplicate";
  Compilation compilation({.root = kCamera + row});
  ASSERT_TRUE(compilation.lower({.instancing = Instancing::Always}));
  const std::vector<std::uint32_t> wanted{100};
  EXPECT_EQ(compilation.compiler().trace(wanted)[0].name, "last");
}

TEST(GroupRepeats, AreAsDeepAsCallsMayBe) {
  const std::string deep =
      "def deep(n) { if n > 0 { deep { n: n - 1, translate: (0, 1, 0) } }\n"
      "  if n == 0 { sphere { center: (0, 0, 0), radius: 0.1, material: unlit(red) } } }\n";
  for (const char* calls : {"[9998, 9999]", "[9999, 10000]", "[5000, 10000]", "[10000, 50]"}) {
    const std::string text = deep + "for i in " + calls + " { deep { n: i } }";
    EXPECT_EQ(build(text, true, Instancing::Never).codes, evaluated_fully(text).codes) << calls;
  }
}

TEST(GroupRepeats, OfNothingTakeNoTime) {
  // 2^60 nested groups.
  const Built built = build(
      "def tree(n) { if n > 0 { tree { n: n - 1 }\n tree { n: n - 1, scale: 2 } } }\ntree { n: 60 "
      "}",
      true, Instancing::Never);
  EXPECT_THAT(built.codes, IsEmpty());
  EXPECT_THAT(built.scene.spheres, IsEmpty());
}

TEST(GroupRepeats, AreRecordedAgainWhereTheFirstRecordsWereInVain) {
  // 200 MB of records that are never repeated, followed by some that are repeated often.
  const Built built = build(
      "def once(s) { for i in range(1000) { sphere { center: (i, s, 0), radius: 0.1,\n"
      "  material: unlit(red) } } }\n"
      "def often() { for i in range(100) { sphere { center: (i, 0, 5), radius: 0.1,\n"
      "  material: unlit(red) } } }\n"
      "for s in range(2500) { once { s: s } }\nfor x in range(1000) { often { translate: (0, x, 0) "
      "} }",
      true, Instancing::Never);
  EXPECT_EQ(built.scene.spheres.size(), 2'600'000u);
  EXPECT_EQ(built.added, 2'500'000u + 100 + 1);
}

TEST(GroupRepeats, CountAsObjects) {
  const std::string text = kRow + "for x in range(50) { row { n: 100, translate: (0, x, 0) } }";
  const auto codes_within = [&](Instancing instancing, std::uint64_t objects) {
    return build(text, true, instancing, {.objects = objects}).codes;
  };
  EXPECT_THAT(codes_within(Instancing::Never, 5000), IsEmpty());
  EXPECT_THAT(codes_within(Instancing::Never, 4999), ElementsAre("E305"));
  EXPECT_THAT(codes_within(Instancing::Always, 100 + 100 + 3 * 49), IsEmpty())
      << "the first, its prototype, and instances";
  EXPECT_THAT(codes_within(Instancing::Always, 100 + 100 + 3 * 49 - 1), ElementsAre("E305"));
}

TEST(GroupRepeats, LeaveSpheresTraceable) {
  const std::string text =
      "def pair() { sphere a { center: (0, 0, 0), radius: 1, material: unlit(red) }\n"
      "  sphere b { center: (3, 0, 0), radius: 1, material: unlit(red) } }\n"
      "pair {}\nsphere first { center: (0, 5, 0), radius: 1, material: unlit(blue) }\n"
      "for i in range(3) { pair { translate: (0, 10 + 5 * i, 0) } }\n"
      "sphere second { center: (9, 5, 0), radius: 1, material: unlit(blue) }\n"
      "pair { translate: (0, 0, 9) }\n"
      "sphere third { center: (9, 9, 0), radius: 1, material: unlit(blue) }\n";
  const auto names = [&](Instancing instancing, std::vector<std::uint32_t> spheres) {
    Compilation compilation({.root = kCamera + text});
    EXPECT_TRUE(compilation.lower({.instancing = instancing}));
    std::vector<std::string> all;
    for (const lang::Origin& origin : compilation.compiler().trace(spheres)) {
      all.push_back(origin.name);
    }
    return all;
  };
  EXPECT_THAT(names(Instancing::Never, {0, 2, 4, 8, 9, 10, 11}),
              ElementsAre("a", "first", "b", "b", "second", "a", "b"));
  EXPECT_THAT(names(Instancing::Always, {0, 1, 2, 3, 4}),
              ElementsAre("a", "b", "first", "second", "third"));
}

}  // namespace
}  // namespace sdlc::test
