#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "lang/allowances/allowances.hpp"
#include "lang/compile/compile.hpp"
#include "lang/diagnostics/fixes.hpp"
#include "lang/lint/lint.hpp"
#include "lang/lint/rules.hpp"
#include "tests/support/case_flags/case_flags.hpp"
#include "tests/support/file_test.hpp"

namespace sdlc::test {
namespace {

std::shared_ptr<lang::Compiler> lint_case(const FileCase& file_case, const lang::Document& file,
                                          lang::Workspace& workspace, lang::DiagnosticSink& sink) {
  auto compiler =
      std::make_shared<lang::Compiler>(file, program_options(file_case, workspace), sink);
  lang::lint(*compiler, file, sink);
  return compiler;
}

class LintFiles : public testing::TestWithParam<FileCase> {};

TEST_P(LintFiles, ReportWhatIsExpected) {
  run_program_case(
      GetParam(), "case",
      [](const lang::Document& file, lang::Workspace& workspace, lang::DiagnosticSink& sink) {
        return lint_case(GetParam(), file, workspace, sink);
      });
}

/// The fixes of a rule's findings match the table of rules.
void check_fixes(const lang::Diagnostic& diagnostic) {
  const auto rule = std::ranges::find(lang::all_rules(), diagnostic.info, &lang::Rule::info);
  if (rule == lang::all_rules().end()) return;
  for (const lang::Fix& fix : diagnostic.fixes) {
    EXPECT_EQ(fix.is_safe ? lang::RuleFix::Safe : lang::RuleFix::Unsafe, rule->fix)
        << diagnostic.info->code;
  }
}

/// The number of findings with fixes in a text; the text with all of them applied is stored in
/// `fixed`.
std::size_t count_mendable(const FileCase& file_case, const std::string& text, std::string* fixed) {
  const CaseFiles files(file_case);
  lang::Workspace workspace(files);
  const lang::Document file("case", text);
  lang::DiagnosticSink sink;
  const auto compiler = lint_case(file_case, file, workspace, sink);
  std::size_t count = 0;
  const lang::Findings findings = select_unallowed(sink);
  for (const lang::Diagnostic* diagnostic : findings.shown) {
    EXPECT_NE(diagnostic->info->severity, lang::Severity::Error) << diagnostic->message;
    check_fixes(*diagnostic);
    if (!diagnostic->fixes.empty()) ++count;
  }
  if (fixed != nullptr) *fixed = lang::apply_fixes(file, findings.shown, true).text;
  return count;
}

TEST_P(LintFiles, AreFixedByTheirFixes) {
  std::string text = GetParam().texts.front().text(), fixed;
  constexpr int kMostRounds = 3;  // overlapping fixes are applied in turns
  for (int round = 0; round < kMostRounds; ++round) {
    if (count_mendable(GetParam(), text, &fixed) == 0) break;
    text = fixed;
  }
  EXPECT_EQ(count_mendable(GetParam(), text, nullptr), 0u) << text;
}

INSTANTIATE_TEST_SUITE_P(Lint, LintFiles, testing::ValuesIn(load_cases("lint")), CaseName());

}  // namespace
}  // namespace sdlc::test
