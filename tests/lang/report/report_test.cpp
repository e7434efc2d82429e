#include "lang/report/report.hpp"

#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sdlc::lang {
namespace {

TEST(RenderConcise, IsOneLineEach) {
  const SourceFile file("dir/a.scene", "scene 1\nsphère { radus: -1 }\n");
  DiagnosticSink sink;
  sink.report(diag::zero_radius, {&file, {24, 26}});
  sink.report(diag::unknown_property, {&file, {18, 23}}, "radus", "sphere").suggest("radius");
  sink.report(diag::zero_radius, {});
  EXPECT_EQ(
      render_diagnostics(sink, {.format = MessageFormat::Concise, .color = true}),
      "dir/a.scene:2:10: error[E104]: unknown property `radus` of sphere; did you mean radius?\n"
      "dir/a.scene:2:16: warning[W402]: a sphere of radius 0 is never visible\n"
      "warning[W402]: a sphere of radius 0 is never visible\n");
}

TEST(RenderConcise, KeepsMessagesOnTheirLine) {
  const SourceFile file("a", "x");
  DiagnosticSink sink;
  sink.report(diag::bad_string, {&file, {0, 1}}, "a\nb\x1b");
  EXPECT_EQ(render_diagnostics(sink, {.format = MessageFormat::Concise}),
            "a:1:1: error[E005]: a␊b␛ in a string\n");
}

TEST(RenderJson, HoldsEverything) {
  const SourceFile file("a.scene", "é radus\nradius\n");
  DiagnosticSink sink;
  sink.report(diag::unknown_property, {&file, {3, 8}}, "radus", "sphere")
      .suggest("radius")
      .label({&file, {9, 15}}, "here")
      .help("look")
      .chain({{.where = {&file, {9, 15}}, .message = "in `ring`"}});
  const auto json =
      nlohmann::json::parse(render_diagnostics(sink, {.format = MessageFormat::Json}));
  EXPECT_EQ(json, nlohmann::json::parse(R"({
    "diagnostics": [{
      "code": "E104", "severity": "error", "name": "unknown_property",
      "message": "unknown property `radus` of sphere", "suggestion": "radius", "help": ["look"],
      "location": {"file": "a.scene", "line": 1, "column": 3, "end_line": 1, "end_column": 8,
                   "offset": 3, "end_offset": 8},
      "labels": [{"message": "here", "location": {"file": "a.scene", "line": 2, "column": 1,
        "end_line": 2, "end_column": 7, "offset": 9, "end_offset": 15}}],
      "fixes": [{"replacement": "radius", "is_safe": false, "location": {"file": "a.scene", "line": 1, "column": 3,
        "end_line": 1, "end_column": 8, "offset": 3, "end_offset": 8}}],
      "chain": [{"message": "in `ring`", "location": {"file": "a.scene", "line": 2, "column": 1,
        "end_line": 2, "end_column": 7, "offset": 9, "end_offset": 15}}]
    }],
    "failures": [], "errors": 1, "warnings": 0, "omitted": 0
  })"));
}

TEST(RenderJson, ListsFilesThatCouldNotBeRead) {
  std::ostringstream out;
  const auto writer = make_diagnostic_writer({.format = MessageFormat::Json}, out);
  writer->fail("nope.scene", "cannot read `nope.scene`");
  writer->finish({});
  EXPECT_EQ(nlohmann::json::parse(out.str())["failures"], nlohmann::json::parse(R"([
    {"file": "nope.scene", "reason": "cannot read `nope.scene`"}
  ])"));
}

TEST(RenderJson, IsAsciiWhateverTheTextIs) {
  const SourceFile file("\xff", "x");
  DiagnosticSink sink;
  sink.report(diag::bad_string, {&file, {0, 1}}, "é\xff\x1b");
  for (const char c : render_diagnostics(sink, {.format = MessageFormat::Json})) {
    EXPECT_TRUE((c >= ' ' && c < 0x7F) || c == '\n');
  }
}

TEST(RenderJson, OfNothingIsAnEmptyList) {
  const auto json =
      nlohmann::json::parse(render_diagnostics(DiagnosticSink(), {.format = MessageFormat::Json}));
  EXPECT_EQ(json["diagnostics"], nlohmann::json::array());
}

}  // namespace
}  // namespace sdlc::lang
