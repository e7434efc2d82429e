#include "lang/lint/lint.hpp"

#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/allowances/allowances.hpp"
#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
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
