#include <memory>

#include "lang/convert/convert.hpp"
#include "tests/support/case_flags/case_flags.hpp"
#include "tests/support/file_test.hpp"

namespace sdlc::test {
namespace {

class ConvertFiles : public testing::TestWithParam<FileCase> {};

// A case in either format, detected from the text. The expectations are the diagnostics of its
// conversion.
TEST_P(ConvertFiles, ReportWhatIsExpected) {
  run_program_case(
      GetParam(), "case",
      [](const lang::Document& file, lang::Workspace& workspace, lang::DiagnosticSink& sink) {
        const auto conversion =
            std::make_shared<lang::Conversion>(file, program_options(GetParam(), workspace), sink);
        const bool is_converted = conversion->run({}).has_value();
        EXPECT_EQ(is_converted, !sink.has_errors());
        return conversion;
      });
}

INSTANTIATE_TEST_SUITE_P(Convert, ConvertFiles, testing::ValuesIn(load_cases("convert")),
                         CaseName());

}  // namespace
}  // namespace sdlc::test
