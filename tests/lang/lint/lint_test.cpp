#include "lang/lint/lint.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/allowances/allowances.hpp"
#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lint/context.hpp"
#include "lang/lint/rules.hpp"
#include "lang/report/report.hpp"
#include "lang/source/source.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::lang {
namespace {

namespace fs = std::filesystem;

/// The number of warnings for a text.
DiagnosticCounts lint_counts(const std::string& text) {
  const Document file("test.scene", text);
  DiagnosticSink sink;
  Compiler compiler(file, {}, sink);
  lint(compiler, file, sink);
  return select_unallowed(sink).counts;
}

constexpr const char* kHead =
    "scene 1\ncamera main { from: (0, 1, 50), at: (0, 0, 0), fov: 40deg }\n";

TEST(Lint, ReportsNothingInTheExamples) {
  const DiskFileSystem files;
  Workspace workspace(files);
  for (const auto& entry : fs::directory_iterator(fs::path(SDLC_SOURCE_DIR) / "examples")) {
    if (entry.path().extension() != ".scene") continue;
    const Document file(entry.path().string(), test::content_of(entry.path()));
    DiagnosticSink sink;
    ProgramOptions options;
    options.workspace = &workspace;
    Compiler compiler(file, options, sink);
    lint(compiler, file, sink);
    const Findings findings = select_unallowed(sink);
    EXPECT_TRUE(findings.shown.empty()) << render_findings(findings, {});
  }
}

TEST(Lint, ReportsAPlaceOnce) {
  const auto counts = lint_counts(std::string(kHead) +
                                  "sphere { center: (0, 0, 0), radius: 20, material: unlit(red) }\n"
                                  "for i in range(5000) { sphere { center: (i / 1000, 0, 0), "
                                  "radius: 0.1, material: unlit(red) } }\n");
  EXPECT_EQ(counts.warnings, 1u);
}

// Code that compares all pairs would not finish.
TEST(Lint, LooksIntoManyShellsOfGlass) {
  const auto counts = lint_counts(
      std::string(kHead) +
      "for i in range(200000) { sphere { center: (0, 0, 0), radius: 1 + i / 100000, material: "
      "transmissive(ior: 1.5) } }\n");
  EXPECT_EQ(counts.warnings, 1u);  // the depth
}

// Code that visits all names, or all comments, for each one would not finish in time.
TEST(Lint, KnowsManyLocalNamesAndAllowances) {
  constexpr int kMany = 40'000;
  std::string names = std::string(kHead) + "def many() {\n";
  for (int i = 0; i < kMany; ++i) names += fmt::format("  let a{} = {}\n", i + 1, i);
  names += "  sphere { center: (a1, 0, 0), radius: 1, material: unlit(red) }\n}\nmany {}\n";
  EXPECT_EQ(lint_counts(names).warnings, static_cast<std::size_t>(kMany - 1));

  std::string allowed = kHead;
  for (int i = 0; i < kMany; ++i) {
    allowed += fmt::format(
        "// sdlc: allow(W402)\nsphere {{ center: ({}, 0, 0), radius: 0, "
        "material: unlit(red) }}\n",
        i);
  }
  EXPECT_EQ(lint_counts(allowed).warnings, 0u);
}

/// What a rule about lenses reports if the text's only sphere, at the origin, is in an instance at
/// `place`.
std::vector<Finding> findings_of_instance(const DiagnosticInfo& rule, render::Vec3 place) {
  const Document file("test.scene",
                      "scene 1\n"
                      "camera { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg, aperture: 0.5 }\n"
                      "render { width: 640 }\n"
                      "sphere { center: (0, 0, 0), radius: 1, material: diffuse(tan) }\n");
  DiagnosticSink sink;
  Compiler compiler(file, {}, sink);
  std::vector<Finding> findings;
  compiler.check([&](const LoweredScene& plain) {
    LoweredScene lowered = plain;
    lowered.scene.prototypes.push_back({.spheres = lowered.scene.spheres, .shifts = {}});
    lowered.scene.spheres.clear();
    render::Instance instance;
    instance.placement.translate = place;
    lowered.scene.instances = {instance};
    LintContext context(file, nullptr, compiler, lowered);
    std::ranges::find(all_rules(), &rule, &Rule::info)->check(context);
    findings = context.take_findings();
  });
  return findings;
}

TEST(LintOfALens, KnowsTheSpheresOfInstances) {
  EXPECT_EQ(findings_of_instance(diag::nothing_in_focus, {0, 0, 0}).size(), 0u);
  EXPECT_EQ(findings_of_instance(diag::nothing_in_focus, {0, 0, -9}).size(), 1u);
  EXPECT_EQ(findings_of_instance(diag::lens_too_large, {0, 0, 0}).size(), 0u);
  const auto near = findings_of_instance(diag::lens_too_large, {0, 0, 3.9});
  ASSERT_EQ(near.size(), 1u);
  EXPECT_NE(near[0].message.find("is 0.1"), std::string::npos) << near[0].message;
  EXPECT_TRUE(near[0].labels.empty());
}

TEST(Allowances, StopOnRequest) {
  const Document file("test.scene", std::string(kHead) + "let a = 1  // sdlc: allow(W402)\n");
  StopRequest stop;
  Allowances allowances(&stop);
  EXPECT_FALSE(allowances.allow(diag::zero_radius, {&file, {0, 1}}));
  stop.make();
  EXPECT_THROW(Allowances(&stop).allow(diag::zero_radius, {&file, {0, 1}}), StopRequested);
}

}  // namespace
}  // namespace sdlc::lang
