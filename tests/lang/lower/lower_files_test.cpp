#include "lang/compile/compile.hpp"
#include "tests/support/file_test.hpp"

namespace sdlc::test {
namespace {

class LowerFiles : public testing::TestWithParam<FileCase> {};

// A case of either format: the text says which.
TEST_P(LowerFiles, ReportWhatIsExpected) {
  run_case(GetParam(), "case", [](const lang::SourceFile& file, lang::DiagnosticSink& sink) {
    lang::compile(file, {}, sink);
  });
}

INSTANTIATE_TEST_SUITE_P(Lower, LowerFiles, testing::ValuesIn(load_cases("lower")), CaseName());

}  // namespace
}  // namespace sdlc::test
