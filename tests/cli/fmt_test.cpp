#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kNeat = "scene 1\nlet a = 1\n";
constexpr const char* kMessy = "scene 1\nlet   a=1\nlet   b=2\n";
constexpr const char* kWrong = "scene 1\nlet   a =\n";

class FmtCommand : public testing::Test {
 protected:
  FmtCommand() {
    write("neat.scene", kNeat);
    write("messy.scene", kMessy);
    write("wrong.scene", kWrong);
  }
  void write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write_text(folder_ / name, text);
  }
  std::string read(const std::string& name) const { return content_of(folder_ / name); }
  ProgramResult run(const std::string& arguments) const {
    return run_shell(folder_.path(), "\"$SDLC\" fmt " + arguments);
  }

  TemporaryFolder folder_;
};

TEST_F(FmtCommand, FormatsInPlaceAndListsChangedFiles) {
  const ProgramResult result = run("neat.scene messy.scene");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "formatted messy.scene\n");
  EXPECT_EQ(read("messy.scene"), "scene 1\nlet a = 1\nlet b = 2\n");
  EXPECT_EQ(run("messy.scene").err, "");
}

TEST_F(FmtCommand, LeavesFilesThatDoNotChangeUntouched) {
  const auto before = std::filesystem::last_write_time(folder_ / "neat.scene");
  std::filesystem::last_write_time(folder_ / "neat.scene", before - std::chrono::hours(1));
  run("neat.scene");
  EXPECT_EQ(std::filesystem::last_write_time(folder_ / "neat.scene"),
            before - std::chrono::hours(1));
}

TEST_F(FmtCommand, CanBeQuiet) {
  const ProgramResult result = run("messy.scene --quiet");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(read("messy.scene"), "scene 1\nlet a = 1\nlet b = 2\n");
}

TEST_F(FmtCommand, ListsWhatWouldChange) {
  const ProgramResult result = run("neat.scene messy.scene --check");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "messy.scene\n");
  EXPECT_EQ(result.err, "1 file would be formatted\n");
  EXPECT_EQ(read("messy.scene"), kMessy);
  EXPECT_EQ(run("neat.scene --check").exit_code, 0);
}

TEST_F(FmtCommand, ShowsWhatWouldChangeAsAPatch) {
  const ProgramResult result = run("neat.scene messy.scene --diff --quiet");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out,
            "--- messy.scene\n+++ messy.scene\n@@ -1,3 +1,3 @@\n scene 1\n"
            "-let   a=1\n-let   b=2\n+let a = 1\n+let b = 2\n");
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(read("messy.scene"), kMessy);
  EXPECT_EQ(run("neat.scene --diff").exit_code, 0);
  EXPECT_THAT(run("messy.scene --diff --color always").out, HasSubstr("\x1b[32m+let a = 1\x1b[0m"));
}

TEST_F(FmtCommand, ShowsAPatchWithCheckToo) {
  const ProgramResult result = run("neat.scene messy.scene --check --diff");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, run("messy.scene --diff").out);
  EXPECT_EQ(read("messy.scene"), kMessy);
  EXPECT_EQ(run("neat.scene --check --diff").exit_code, 0);
}

TEST_F(FmtCommand, LeavesFilesWithErrorsAlone) {
  const ProgramResult result = run("wrong.scene messy.scene --format concise");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "wrong.scene:2:10: error[E001]: expected a value after `=`, found the end of the "
            "line\nformatted messy.scene\nunchanged because of errors: wrong.scene\n");
  EXPECT_EQ(read("wrong.scene"), kWrong);
}

TEST_F(FmtCommand, ReportsTheErrorsOfAllFilesInOneDocument) {
  write("also.scene", kWrong);
  const ProgramResult result = run("wrong.scene also.scene --check --format json --quiet");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(nlohmann::json::parse(result.err)["errors"], 2);
}

TEST_F(FmtCommand, FormatsStandardInput) {
  const ProgramResult result = run("- <messy.scene");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "scene 1\nlet a = 1\nlet b = 2\n");
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(run("- <neat.scene").out, kNeat);
  EXPECT_EQ(run("- --check --stdin-filename x.scene <messy.scene").out, "x.scene\n");
  const ProgramResult wrong = run("- --stdin-filename x.scene --format concise <wrong.scene");
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_EQ(wrong.out, "");
  EXPECT_THAT(wrong.err, HasSubstr("x.scene:2:10: error[E001]"));
}

TEST_F(FmtCommand, LooksIntoFoldersForScenesAlone) {
  write("scenes/b/deep.scene", kMessy);
  write("scenes/.hidden/c.scene", kMessy);
  write("scenes/a.json", R"({"camera": {}, "rendering": {}})");
  const ProgramResult result = run("scenes");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "formatted scenes/b/deep.scene\n");
  EXPECT_EQ(read("scenes/.hidden/c.scene"), kMessy);
}

TEST_F(FmtCommand, RefusesConfigs) {
  write("old.json", "{}");
  const ProgramResult result = run("messy.scene old.json");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "error: `old.json` is a JSON config, and `fmt` is for .scene files\n");
  EXPECT_EQ(read("messy.scene"), kMessy);
}

TEST_F(FmtCommand, ContinuesAfterAMissingFile) {
  const ProgramResult result = run("missing.scene messy.scene");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("cannot read `missing.scene`"));
  EXPECT_THAT(result.err, HasSubstr("formatted messy.scene"));
}

TEST_F(FmtCommand, FormatsTheStatementsOfSomeLines) {
  EXPECT_EQ(run("messy.scene --range 3:3").exit_code, 0);
  EXPECT_EQ(read("messy.scene"), "scene 1\nlet   a=1\nlet b = 2\n");
  for (const char* wrong : {"--range 3", "--range 0:1", "--range 3:2", "--range a:b"}) {
    EXPECT_EQ(run(std::string("messy.scene ") + wrong).exit_code, 2) << wrong;
  }
  EXPECT_EQ(run("messy.scene neat.scene --range 1:1").exit_code, 2);
}

}  // namespace
}  // namespace sdlc::test
