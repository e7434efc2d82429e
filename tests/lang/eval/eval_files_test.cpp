#include "lang/eval/eval.hpp"
#include "tests/support/file_test.hpp"

namespace sdlc::test {
namespace {

class IgnoredObjects final : public lang::ObjectSink {
 public:
  void add(const lang::Object& /*object*/) override {}
};

class EvalFiles : public testing::TestWithParam<FileCase> {};

TEST_P(EvalFiles, ReportWhatIsExpected) {
  run_case(GetParam(), "test.scene", [](const lang::SourceFile& file, lang::DiagnosticSink& sink) {
    IgnoredObjects objects;
    lang::evaluate(file, objects, sink);
  });
}

INSTANTIATE_TEST_SUITE_P(Eval, EvalFiles, testing::ValuesIn(load_cases("eval")), CaseName());

}  // namespace
}  // namespace sdlc::test
