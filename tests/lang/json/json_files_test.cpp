#include "lang/json/json.hpp"
#include "tests/support/file_test.hpp"

namespace sdlc::test {
namespace {

class IgnoredObjects final : public lang::ObjectSink {
 public:
  void add(const lang::Object& /*object*/) override {}
};

class JsonFiles : public testing::TestWithParam<FileCase> {};

TEST_P(JsonFiles, ReportWhatIsExpected) {
  run_case(GetParam(), "config.json", [](const lang::SourceFile& file, lang::DiagnosticSink& sink) {
    IgnoredObjects objects;
    lang::read_config(file, objects, sink);
  });
}

INSTANTIATE_TEST_SUITE_P(Json, JsonFiles, testing::ValuesIn(load_cases("json")), CaseName());

}  // namespace
}  // namespace sdlc::test
