#include <memory>

#include "lang/eval/eval.hpp"
#include "lang/program/program.hpp"
#include "tests/support/case_flags/case_flags.hpp"
#include "tests/support/file_test.hpp"

namespace sdlc::test {
namespace {

class IgnoredObjects final : public lang::ObjectSink {
 public:
  void add(const lang::Object& /*object*/) override {}
};

class EvalFiles : public testing::TestWithParam<FileCase> {};

TEST_P(EvalFiles, ReportWhatIsExpected) {
  run_program_case(
      GetParam(), "test.scene",
      [](const lang::Document& file, lang::Workspace& workspace, lang::DiagnosticSink& sink) {
        const auto program =
            std::make_shared<lang::Program>(file, program_options(GetParam(), workspace), sink);
        IgnoredObjects objects;
        lang::Evaluation(*program, {}, sink).run(objects);
        return program;
      });
}

INSTANTIATE_TEST_SUITE_P(Eval, EvalFiles, testing::ValuesIn(load_cases("eval")), CaseName());

}  // namespace
}  // namespace sdlc::test
