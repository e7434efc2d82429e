#include <algorithm>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/program/program.hpp"
#include "tests/support/file_test.hpp"

// Whole scenes and configs as people write them, with independent mistakes: each is reported once,
// on its line, and nothing else is.
namespace sdlc::test {
namespace {

bool is_config(const FileCase& file_case) { return file_case.file.extension() == ".txt"; }

class Mistakes : public testing::TestWithParam<FileCase> {};

TEST_P(Mistakes, AreEachReportedOnceAndInTheirPlaces) {
  run_program_case(
      GetParam(), is_config(GetParam()) ? "case.json" : "case.scene",
      [](const lang::Document& file, lang::Workspace& workspace, lang::DiagnosticSink& sink) {
        const lang::ProgramOptions options{.workspace = &workspace, .limits = {}, .sets = {}};
        const auto compiler = std::make_shared<lang::Compiler>(file, options, sink);
        compiler->check();
        return compiler;
      });
}

INSTANTIATE_TEST_SUITE_P(Files, Mistakes, testing::ValuesIn(load_cases("mistakes")), CaseName());

TEST(MistakesCorpus, IsLarge) {
  const std::vector<FileCase> cases = load_cases("mistakes");
  const auto configs = std::count_if(cases.begin(), cases.end(), is_config);
  EXPECT_GE(cases.size(), 80u);
  EXPECT_GE(configs, 20);
  EXPECT_TRUE(std::all_of(cases.begin(), cases.end(),
                          [](const FileCase& file_case) { return !file_case.expected.empty(); }));
}

}  // namespace
}  // namespace sdlc::test
