#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/report/report.hpp"

namespace sdlc::lang {
namespace {

using testing::HasSubstr;

RenderDiagnosticsOptions junit() { return {.format = MessageFormat::Junit}; }

TEST(Junit, IsASuiteAFileAndAFailedCaseAFinding) {
  const SourceFile file("a.scene", "é radus\n");
  DiagnosticSink sink;
  sink.report(diag::unknown_property, {&file, {3, 8}}, "radus", "sphere")
      .suggest("radius")
      .help("look");
  std::ostringstream out;
  const auto writer = make_diagnostic_writer(junit(), out);
  writer->enter("clean.scene");
  writer->enter("a.scene");
  writer->write(sink.diagnostics().front());
  writer->finish(select_findings(sink).counts);
  EXPECT_EQ(out.str(), R"(<?xml version="1.0" encoding="UTF-8"?>
<testsuites name="sdlc" tests="2" failures="1" errors="0">
  <testsuite name="clean.scene" tests="1" failures="0" errors="0">
    <testcase name="no findings" classname="clean.scene" file="clean.scene"/>
  </testsuite>
  <testsuite name="a.scene" tests="1" failures="1" errors="0">
    <testcase name="E104 unknown_property 1:3" classname="a.scene" file="a.scene" line="1">
      <failure type="error" message="unknown property `radus` of sphere; did you mean radius?">a.scene:1:3: error[E104]: unknown property `radus` of sphere; did you mean radius?
help: look</failure>
    </testcase>
  </testsuite>
</testsuites>
)");
}

TEST(Junit, IsXmlWhateverTheTextIs) {
  const SourceFile file("<a&\"b\">.scene", "x");
  DiagnosticSink sink;
  sink.report(diag::bad_string, {&file, {0, 1}}, "]]>\x01\x1b\xff\xef\xbf\xbe");
  const std::string text = render_diagnostics(sink, junit());
  EXPECT_THAT(text, HasSubstr("<testsuite name=\"&lt;a&amp;&quot;b&quot;&gt;.scene\""));
  EXPECT_THAT(text, HasSubstr("]]&gt;␁␛\xef\xbf\xbd\xef\xbf\xbd in a string"));
}

TEST(Junit, ReportsHowManyAreNotListed) {
  const SourceFile file("a.scene", std::string(60, 'x'));
  DiagnosticSink sink;
  for (std::uint32_t i = 0; i < 51; ++i) sink.report(diag::zero_radius, {&file, {i, i + 1}});
  const std::string text = render_diagnostics(sink, junit());
  EXPECT_THAT(text, HasSubstr("tests=\"51\" failures=\"51\""));
  EXPECT_THAT(text, HasSubstr("1 more finding is not listed"));
}

TEST(Junit, HasAnErrorWhereAFileCannotBeRead) {
  std::ostringstream out;
  const auto writer = make_diagnostic_writer(junit(), out);
  writer->fail("nope.scene", "cannot read `nope.scene`");
  writer->finish({});
  EXPECT_EQ(out.str(), R"(<?xml version="1.0" encoding="UTF-8"?>
<testsuites name="sdlc" tests="1" failures="0" errors="1">
  <testsuite name="nope.scene" tests="1" failures="0" errors="1">
    <testcase name="cannot be read or written" classname="nope.scene" file="nope.scene">
      <error type="error" message="cannot read `nope.scene`"/>
    </testcase>
  </testsuite>
</testsuites>
)");
}

TEST(Junit, OfNothingHasNoSuites) {
  EXPECT_THAT(render_diagnostics(DiagnosticSink(), junit()),
              HasSubstr("<testsuites name=\"sdlc\" tests=\"0\" failures=\"0\" errors=\"0\">\n"
                        "</testsuites>\n"));
}

}  // namespace
}  // namespace sdlc::lang
