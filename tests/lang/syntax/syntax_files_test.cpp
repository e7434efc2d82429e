#include "lang/syntax/syntax.hpp"
#include "tests/support/file_test.hpp"

namespace sdlc::test {
namespace {

class SyntaxFiles : public testing::TestWithParam<FileCase> {};

TEST_P(SyntaxFiles, ReportWhatIsExpected) {
  run_case(GetParam(), "test.scene", [](const lang::SourceFile& file, lang::DiagnosticSink& sink) {
    lang::parse(file, sink);
  });
}

INSTANTIATE_TEST_SUITE_P(Syntax, SyntaxFiles, testing::ValuesIn(load_cases("syntax")), CaseName());

}  // namespace
}  // namespace sdlc::test
