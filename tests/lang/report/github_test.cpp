#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "lang/report/report.hpp"

namespace sdlc::lang {
namespace {

std::string github(const DiagnosticSink& sink) {
  return render_diagnostics(sink,
                            {.format = MessageFormat::Github, .facts = {.root = "/home/tree"}});
}

TEST(Github, IsAWorkflowCommandEach) {
  const SourceFile file("/home/tree/a.scene", "é radus\n");
  DiagnosticSink sink;
  sink.report(diag::unknown_property, {&file, {3, 8}}, "radus", "sphere").suggest("radius");
  sink.report(diag::zero_radius, {});
  EXPECT_EQ(github(sink),
            "::error file=a.scene,line=1,endLine=1,col=3,endColumn=8,title=sdlc E104 "
            "unknown_property::/home/tree/a.scene:1:3: unknown property `radus` of sphere; did you "
            "mean radius?\n"
            "::warning title=sdlc W402 zero_radius::a sphere of radius 0 is never visible\n");
}

TEST(Github, EscapesWhatWouldEndAProperty) {
  const SourceFile file("100%, a:b.scene", "x");
  DiagnosticSink sink;
  sink.report(diag::zero_radius, {&file, {0, 1}});
  EXPECT_EQ(github(sink).substr(0, 42), "::warning file=100%25%2C a%3Ab.scene,line=");
}

TEST(Github, KeepsAMessageInOneLine) {
  const SourceFile file("a.scene", "x");
  DiagnosticSink sink;
  sink.report(diag::bad_string, {&file, {0, 1}}, "50%\r\n::error::x").help("one").help("two");
  const std::string text = github(sink);
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  EXPECT_NE(text.find("a.scene:1:1: 50%25␍␊::error::x in a string%0Ahelp: one%0Ahelp: two\n"),
            std::string::npos)
      << text;
}

TEST(Github, LeavesColumnsOutWhereThereAreSeveralLines) {
  const SourceFile file("a.scene", "x\ny\n");
  DiagnosticSink sink;
  sink.report(diag::zero_radius, {&file, {0, 3}});
  EXPECT_EQ(github(sink).substr(0, 51), "::warning file=a.scene,line=1,endLine=2,title=sdlc ");
}

TEST(Github, OfNothingIsNothing) { EXPECT_EQ(github(DiagnosticSink()), ""); }

TEST(Gitlab, IsACodeQualityReport) {
  const SourceFile file("a.scene", "é radus\n");
  DiagnosticSink sink;
  sink.report(diag::unknown_property, {&file, {3, 8}}, "radus", "sphere");
  sink.report(diag::zero_radius, {&file, {0, 2}});
  const auto issues =
      nlohmann::json::parse(render_diagnostics(sink, {.format = MessageFormat::Gitlab}));
  ASSERT_EQ(issues.size(), 2u);
  EXPECT_EQ(issues[0]["check_name"], "W402 zero_radius");
  EXPECT_EQ(issues[0]["severity"], "minor");
  EXPECT_EQ(issues[1]["severity"], "major");
  EXPECT_EQ(issues[1]["description"], "unknown property `radus` of sphere");
  EXPECT_EQ(issues[1]["location"], nlohmann::json::parse(R"({"path": "a.scene", "positions": {
    "begin": {"line": 1, "column": 3}, "end": {"line": 1, "column": 8}}})"));
}

TEST(Gitlab, NamesEachFindingDifferently) {
  const SourceFile file("a.scene", "xy\n");
  DiagnosticSink sink;
  sink.report(diag::zero_radius, {&file, {0, 1}});
  sink.report(diag::zero_radius, {&file, {1, 2}});
  const auto issues =
      nlohmann::json::parse(render_diagnostics(sink, {.format = MessageFormat::Gitlab}));
  EXPECT_NE(issues[0]["fingerprint"], issues[1]["fingerprint"]);
}

}  // namespace
}  // namespace sdlc::lang
