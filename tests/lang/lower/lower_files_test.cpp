#include <memory>

#include "lang/compile/compile.hpp"
#include "tests/support/case_flags/case_flags.hpp"
#include "tests/support/file_test.hpp"

namespace sdlc::test {
namespace {

class LowerFiles : public testing::TestWithParam<FileCase> {};

// A case in either format, detected from the text.
TEST_P(LowerFiles, ReportWhatIsExpected) {
  run_program_case(
      GetParam(), "case",
      [](const lang::Document& file, lang::Workspace& workspace, lang::DiagnosticSink& sink) {
        const auto compiler =
            std::make_shared<lang::Compiler>(file, program_options(GetParam(), workspace), sink);
        compiler->lower({});
        return compiler;
      });
}

INSTANTIATE_TEST_SUITE_P(Lower, LowerFiles, testing::ValuesIn(load_cases("lower")), CaseName());

}  // namespace
}  // namespace sdlc::test
