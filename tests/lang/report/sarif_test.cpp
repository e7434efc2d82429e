#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "lang/report/report.hpp"
#include "lang/report/rule_text.hpp"

namespace sdlc::lang {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kPage =
    "# E104: unknown property\n\nObjects have [no such](../language.md#objects)\n`property`.\n\n"
    "## Wrong\n\n```rust scene\nlet a = b[1](2)\n```\n\nSee [this](https://example.org/x).\n";

RenderDiagnosticsOptions sarif() {
  return {.format = MessageFormat::Sarif,
          .facts = {.version = "1.2.3", .root = "/home/tree", .page_of = [](std::string_view code) {
                      return code == "E104" ? std::optional(kPage) : std::nullopt;
                    }}};
}

Json render(const DiagnosticSink& sink) { return Json::parse(render_diagnostics(sink, sarif())); }

/// A misspelt property and a warning that has no page.
class Sarif : public testing::Test {
 protected:
  Sarif() {
    sink_.report(diag::unknown_property, {&file_, {3, 8}}, "radus", "sphere")
        .suggest("radius")
        .label({&file_, {9, 15}}, "like this")
        .help("look")
        .chain({{.where = {&library_, {0, 1}}, .message = "in `ring`"}});
    sink_.report(diag::zero_radius, {&library_, {0, 1}});
    log_ = render(sink_);
  }
  const Json& run() const { return log_["runs"][0]; }

  const SourceFile file_{"scenes/a b.scene", "é radus\nradius\n"};
  const SourceFile library_{"/elsewhere/l.scene", "x\n"};
  DiagnosticSink sink_;
  Json log_;
};

TEST_F(Sarif, IsOneRunOfOneTool) {
  EXPECT_EQ(log_["version"], "2.1.0");
  EXPECT_EQ(log_["runs"].size(), 1u);
  EXPECT_EQ(run()["columnKind"], "unicodeCodePoints");
  EXPECT_EQ(run()["tool"]["driver"]["name"], "sdlc");
  EXPECT_EQ(run()["tool"]["driver"]["version"], "1.2.3");
  EXPECT_EQ(run()["invocations"][0], Json({{"executionSuccessful", true}}));
}

TEST_F(Sarif, ListsTheRulesOfItsResults) {
  const Json& rules = run()["tool"]["driver"]["rules"];
  ASSERT_EQ(rules.size(), 2u);
  EXPECT_EQ(rules[0], Json::parse(R"({
    "id": "E104", "name": "UnknownProperty",
    "shortDescription": {"text": "Unknown property"},
    "fullDescription": {"text": "Objects have no such property."},
    "help": {"text": "Objects have no such property.\n\n`sdlc explain E104` shows the whole page.",
      "markdown": "Objects have no such\n`property`.\n\n## Wrong\n\n```rust scene\nlet a = b[1](2)\n```\n\nSee [this](https://example.org/x).\n"},
    "defaultConfiguration": {"level": "error"}})"));
  EXPECT_EQ(rules[1], Json::parse(R"({
    "id": "W402", "name": "ZeroRadius", "shortDescription": {"text": "Zero radius"},
    "defaultConfiguration": {"level": "warning"}})"));
}

TEST_F(Sarif, PlacesResultsInCodePointsAndRelativeUris) {
  const Json& result = run()["results"][0];
  EXPECT_EQ(result["ruleId"], "E104");
  EXPECT_EQ(result["ruleIndex"], 0);
  EXPECT_EQ(result["level"], "error");
  EXPECT_EQ(result["message"]["text"],
            "unknown property `radus` of sphere; did you mean radius?\nlook");
  EXPECT_EQ(result["locations"], Json::parse(R"([{"physicalLocation": {
    "artifactLocation": {"uri": "scenes/a%20b.scene", "uriBaseId": "%SRCROOT%"},
    "region": {"startLine": 1, "startColumn": 3, "endLine": 1, "endColumn": 8}}}])"));
  EXPECT_TRUE(run()["originalUriBaseIds"].contains("%SRCROOT%"));
  EXPECT_EQ(run()["results"][1]["locations"][0]["physicalLocation"]["artifactLocation"],
            Json({{"uri", "file:///elsewhere/l.scene"}}));
}

TEST_F(Sarif, RelatesLabelsAndTheWayThere) {
  const Json& related = run()["results"][0]["relatedLocations"];
  ASSERT_EQ(related.size(), 2u);
  EXPECT_EQ(related[0]["message"]["text"], "like this");
  EXPECT_EQ(related[0]["physicalLocation"]["region"]["startLine"], 2);
  EXPECT_EQ(related[1]["message"]["text"], "in `ring`");
  EXPECT_EQ(related[1]["id"], 2);
  EXPECT_FALSE(run()["results"][1].contains("relatedLocations"));
}

TEST_F(Sarif, ProposesFixes) {
  EXPECT_EQ(run()["results"][0]["fixes"], Json::parse(R"([{
    "description": {"text": "A guess: check the result."},
    "artifactChanges": [{
      "artifactLocation": {"uri": "scenes/a%20b.scene", "uriBaseId": "%SRCROOT%"},
      "replacements": [{
        "deletedRegion": {"startLine": 1, "startColumn": 3, "endLine": 1, "endColumn": 8},
        "insertedContent": {"text": "radius"}}]}]}])"));
  EXPECT_FALSE(run()["results"][1].contains("fixes"));
}

TEST(SarifFix, HoldsAllReplacementsOfADiagnostic) {
  const SourceFile file("a.scene", "(x)\n");
  DiagnosticSink sink;
  sink.report(diag::zero_radius, {&file, {0, 3}})
      .fix({&file, {0, 1}}, "[")
      .fix({&file, {2, 3}}, "]");
  const Json fix = render(sink)["runs"][0]["results"][0]["fixes"];
  ASSERT_EQ(fix.size(), 1u);
  EXPECT_EQ(fix[0]["description"]["text"], "A safe fix.");
  ASSERT_EQ(fix[0]["artifactChanges"].size(), 1u);
  EXPECT_EQ(fix[0]["artifactChanges"][0]["replacements"].size(), 2u);
}

TEST_F(Sarif, NamesLinesSoThatTheyAreFoundAgain) {
  DiagnosticSink later;
  const SourceFile moved("scenes/a b.scene", "\n\né radus\nradius\n");
  later.report(diag::unknown_property, {&moved, {5, 10}}, "radus", "sphere");
  EXPECT_EQ(render(later)["runs"][0]["results"][0]["partialFingerprints"],
            run()["results"][0]["partialFingerprints"]);
}

TEST(SarifMessage, HasNoAccidentalLinks) {
  const SourceFile file("a.scene", "x");
  DiagnosticSink sink;
  sink.report(diag::bad_string, {&file, {0, 1}}, "a[0](b)");
  EXPECT_EQ(render(sink)["runs"][0]["results"][0]["message"]["text"], "a\\[0\\](b) in a string");
}

TEST(SarifReport, OfNothingHasNoResults) {
  const Json run = render(DiagnosticSink())["runs"][0];
  EXPECT_EQ(run["results"], Json::array());
  EXPECT_EQ(run["tool"]["driver"]["rules"], Json::array());
}

TEST(SarifReport, ReportsHowManyAreNotListed) {
  const SourceFile file("a.scene", std::string(60, 'x'));
  DiagnosticSink sink;
  for (std::uint32_t i = 0; i < 52; ++i) sink.report(diag::zero_radius, {&file, {i, i + 1}});
  const Json run = render(sink)["runs"][0];
  EXPECT_EQ(run["results"].size(), 50u);
  EXPECT_EQ(run["invocations"][0]["toolExecutionNotifications"][0]["message"]["text"],
            "2 more findings are not listed: the limit is 50 errors and 50 warnings per file");
}

TEST(SarifReport, ReportsThatAFileCouldNotBeRead) {
  std::ostringstream out;
  const auto writer = make_diagnostic_writer(sarif(), out);
  writer->fail("nope.scene", "cannot read `nope.scene`");
  writer->finish({});
  const Json invocation = Json::parse(out.str())["runs"][0]["invocations"][0];
  EXPECT_EQ(invocation["executionSuccessful"], false);
  const Json notification = invocation["toolExecutionNotifications"][0];
  EXPECT_EQ(notification["level"], "error");
  EXPECT_EQ(notification["message"]["text"], "cannot read `nope.scene`");
  EXPECT_EQ(notification["locations"][0]["physicalLocation"]["artifactLocation"]["uri"],
            "nope.scene");
}

TEST(SarifReport, PlacesWhatHasNoTextInTheFileThatIsLookedAt) {
  const SourceFile file("a.scene", "x");
  std::ostringstream out;
  const auto writer = make_diagnostic_writer(sarif(), out);
  DiagnosticSink sink;
  sink.report(diag::zero_radius, {});
  writer->enter("a.scene");
  writer->write(sink.diagnostics().front());
  writer->finish(select_findings(sink).counts);
  EXPECT_EQ(Json::parse(out.str())["runs"][0]["results"][0]["locations"][0]["physicalLocation"]
                                  ["artifactLocation"]["uri"],
            "a.scene");
}

TEST(SarifReport, IsAsciiWhateverTheTextIs) {
  const SourceFile file("\xff", "x");
  DiagnosticSink sink;
  sink.report(diag::bad_string, {&file, {0, 1}}, "é\xff\x1b");
  for (const char c : render_diagnostics(sink, sarif())) {
    EXPECT_TRUE((c >= ' ' && c < 0x7F) || c == '\n');
  }
}

TEST(RuleNames, AreAllDifferentAndOfLetters) {
  std::set<std::string> names;
  for (const DiagnosticInfo* info : all_diagnostics()) {
    const std::string name = pascal_name(*info);
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_EQ(name.find('_'), std::string::npos) << name;
    EXPECT_TRUE(name[0] >= 'A' && name[0] <= 'Z') << name;
  }
}

}  // namespace
}  // namespace sdlc::lang
