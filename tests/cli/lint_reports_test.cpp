#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

// The reports of `sdlc lint` for other programs, and the recipes of docs/ci.md.
namespace sdlc::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class LintReports : public testing::Test {
 protected:
  LintReports() {
    std::filesystem::create_directory(folder_ / "scenes");
    write_text(folder_ / "scenes/clean.scene", kClean);
    write_text(folder_ / "scenes/wrong.scene",
               std::string(kClean) +
                   "sphere { center: (3, 0, 0), radus: 1, material: unlit(red) }\n"
                   "sphere { center: (6, 0, 0), radius: 0, material: unlit(red) }\n");
  }
  std::string lint(const std::string& format) const {
    const ProgramResult result =
        run_shell(folder_.path(), "\"$SDLC\" lint scenes --format " + format);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.err, "");
    return result.out;
  }

  static constexpr const char* kClean =
      "scene 1\n"
      "camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n"
      "sphere { center: (0, 0, 0), radius: 1, material: unlit(red) }\n";
  TemporaryFolder folder_;
};

TEST_F(LintReports, ExplainRulesInSarif) {
  const json run = json::parse(lint("sarif"))["runs"][0];
  ASSERT_EQ(run["results"].size(), 2u);
  for (const json& result : run["results"]) {
    const json& rule = run["tool"]["driver"]["rules"][result["ruleIndex"].get<std::size_t>()];
    EXPECT_EQ(rule["id"], result["ruleId"]);
    EXPECT_THAT(rule["help"]["markdown"].get<std::string>(), HasSubstr("## Right"));
    EXPECT_FALSE(rule["fullDescription"]["text"].get<std::string>().empty());
  }
  EXPECT_NE(run["tool"]["driver"]["version"], "");
}

TEST_F(LintReports, CallFilesByTheirPathsFromTheWorkingFolder) {
  const ProgramResult result =
      run_shell(folder_.path(), "\"$SDLC\" lint \"$PWD/scenes\" --format sarif");
  for (const json& found : json::parse(result.out)["runs"][0]["results"]) {
    EXPECT_EQ(found["locations"][0]["physicalLocation"]["artifactLocation"]["uri"],
              "scenes/wrong.scene");
  }
}

TEST_F(LintReports, CallFilesElsewhereByTheirWholePaths) {
  std::filesystem::create_directory(folder_ / "below");
  const std::filesystem::path wrong = std::filesystem::canonical(folder_ / "scenes/wrong.scene");
  const ProgramResult sarif =
      run_shell(folder_ / "below", "\"$SDLC\" lint ../scenes/wrong.scene --format sarif");
  for (const json& found : json::parse(sarif.out)["runs"][0]["results"]) {
    const json& place = found["locations"][0]["physicalLocation"]["artifactLocation"];
    EXPECT_EQ(place["uri"], "file://" + wrong.string());
    EXPECT_FALSE(place.contains("uriBaseId"));
  }
  const ProgramResult github =
      run_shell(folder_ / "below", "\"$SDLC\" lint ../scenes/wrong.scene --format github");
  EXPECT_THAT(github.out, HasSubstr("::error file=" + wrong.string() + ",line=4,"));
}

TEST_F(LintReports, TellOfFilesThatCannotBeRead) {
  const auto report = [&](const std::string& format) {
    const ProgramResult result = run_shell(
        folder_.path(), "\"$SDLC\" lint nope.scene scenes/clean.scene --format " + format);
    EXPECT_EQ(result.exit_code, 2) << format;
    EXPECT_THAT(result.err, HasSubstr("cannot read `nope.scene`")) << format;
    return result.out;
  };
  EXPECT_THAT(report("junit"), HasSubstr("tests=\"2\" failures=\"0\" errors=\"1\""));
  EXPECT_EQ(json::parse(report("sarif"))["runs"][0]["invocations"][0]["executionSuccessful"],
            false);
  EXPECT_EQ(json::parse(report("gitlab"))[0]["location"]["path"], "nope.scene");
  EXPECT_THAT(report("github"), HasSubstr("::error file=nope.scene,"));
}

TEST_F(LintReports, AreDocumentsWhenNothingIsFoundToo) {
  for (const char* format : {"json", "sarif", "gitlab", "junit"}) {
    const ProgramResult result = run_shell(
        folder_.path(), std::string("\"$SDLC\" lint scenes/clean.scene --format ") + format);
    EXPECT_EQ(result.exit_code, 0) << format;
    EXPECT_NE(result.out, "") << format;
  }
}

TEST_F(LintReports, HaveASuiteOfEachFileInJunit) {
  const std::string text = lint("junit");
  EXPECT_THAT(text, HasSubstr("<testsuite name=\"scenes/clean.scene\" tests=\"1\" failures=\"0\""));
  EXPECT_THAT(text, HasSubstr("<testsuite name=\"scenes/wrong.scene\" tests=\"2\" failures=\"2\""));
}

TEST_F(LintReports, AreMadeByOtherCommandsToo) {
  const ProgramResult render =
      run_shell(folder_.path(), "\"$SDLC\" inspect scenes/wrong.scene --format github");
  EXPECT_THAT(render.err, HasSubstr("::error file=scenes/wrong.scene,line=4,"));
}

TEST_F(LintReports, AreRefusedByCommandsThatReportNothing) {
  const ProgramResult result = run_shell(folder_.path(), "\"$SDLC\" explain E104 --format sarif");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("`sarif` is not one of human, concise, json"));
}

// The hooks of pre-commit and the recipes of docs/ci.md contain commands: in a folder of valid
// scenes each succeeds silently. The package sdlc-lint is as if installed.
TEST_F(LintReports, AreMadeByWhatHooksAndRecipesRun) {
  if (run_shell(folder_.path(), "python3 -c 'import yaml'").exit_code != 0) {
    GTEST_SKIP() << "no python3-yaml here";
  }
  const std::string root = SDLC_SOURCE_DIR;
  const ProgramResult recipes =
      run_shell(folder_.path(), "python3 '" + root + "/tests/cli/ci_recipes.py' '" + root +
                                    "/.pre-commit-hooks.yaml' '" + root + "/docs/ci.md'");
  ASSERT_EQ(recipes.exit_code, 0) << recipes.err;
  std::filesystem::remove(folder_ / "scenes/wrong.scene");
  write_text(folder_ / "scenes/ball.scene",
             std::string(kClean) + "render { width: 8, samples: 1 }\n");
  std::filesystem::create_symlink(SDLC_PROGRAM, folder_ / "sdlc");
  write_text(folder_ / "npm", "#!/bin/sh\n");
  write_text(folder_ / "npx", "#!/bin/sh\nshift 2\nexec sdlc lint \"$@\"\n");  // --yes NAME
  ASSERT_EQ(run_shell(folder_.path(), "chmod +x npm npx").exit_code, 0);
  std::istringstream lines(recipes.out);
  std::size_t run = 0;
  for (std::string line; std::getline(lines, line);) {
    const json recipe = json::parse(line);
    std::string command = recipe["command"];
    if (const std::size_t at = command.find(" FILE"); at != std::string::npos) {
      command.replace(at, 5, " scenes/clean.scene scenes/ball.scene");
    }
    const ProgramResult result = run_shell(folder_.path(), "PATH=\"$PWD:$PATH\"; " + command);
    EXPECT_EQ(result.exit_code, 0) << recipe << "\n" << result.err;
    EXPECT_EQ(result.err.find("error"), std::string::npos) << recipe << "\n" << result.err;
    ++run;
  }
  EXPECT_GT(run, 10u);
}

TEST_F(LintReports, AreReadByTheProblemMatcher) {
  const json pattern =
      json::parse(content_of(std::filesystem::path(SDLC_SOURCE_DIR) /
                             "docs/problem-matcher.json"))["problemMatcher"][0]["pattern"][0];
  const std::regex regex(pattern["regexp"].get<std::string>());
  const auto group = [&](const std::smatch& match, const char* name) {
    return match[pattern[name].get<std::size_t>()].str();
  };
  std::vector<std::string> found;
  std::istringstream lines(lint("concise"));
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    ASSERT_TRUE(std::regex_match(line, match, regex)) << line;
    found.push_back(group(match, "file") + "|" + group(match, "line") + "|" +
                    group(match, "column") + "|" + group(match, "severity") + "|" +
                    group(match, "code") + "|" + group(match, "message"));
  }
  EXPECT_THAT(found,
              testing::ElementsAre(
                  "scenes/wrong.scene|4|29|error|E104|unknown property `radus` of sphere; did you "
                  "mean radius?",
                  "scenes/wrong.scene|5|37|warning|W402|a sphere of radius 0 is never visible"));
}

}  // namespace
}  // namespace sdlc::test
