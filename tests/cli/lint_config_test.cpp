#include "lang/lint_config/lint_config.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

struct Parsed {
  lang::LintConfig config;
  std::vector<std::string> errors;
};

Parsed parse(const std::string& text) {
  Parsed parsed;
  parsed.config = lang::parse_lint_config(text, ".sdlc.toml", "/tree", parsed.errors);
  return parsed;
}

TEST(LintConfig, SelectsCodes) {
  const auto [config, errors] = parse("[lint]\nselect = ['E', \"w4\"]\nignore = ['W402']\n");
  EXPECT_THAT(errors, IsEmpty());
  EXPECT_TRUE(config.wants("E104", "/tree/a.scene"));
  EXPECT_TRUE(config.wants("W403", "/tree/a.scene"));
  EXPECT_FALSE(config.wants("W402", "/tree/a.scene"));
}

TEST(LintConfig, SelectsAllIfTheFileIsEmpty) {
  const auto [config, errors] = parse("");
  EXPECT_THAT(errors, IsEmpty());
  EXPECT_TRUE(config.wants("W402", "/tree/a.scene"));
  EXPECT_EQ(config.max_warnings, std::nullopt);
}

TEST(LintConfig, OverridesItselfForSomeFiles) {
  const auto [config, errors] = parse(R"(
[lint]
ignore = ["W401"]
max-warnings = 3
[[lint.overrides]]
files = ["library/**", "*.json"]
ignore = ["W402"]
[[lint.overrides]]
files = ["library/new/"]
select = ["W402"]
)");
  EXPECT_THAT(errors, IsEmpty());
  EXPECT_EQ(config.max_warnings, 3u);
  EXPECT_TRUE(config.wants("W402", "/tree/a.scene"));
  EXPECT_FALSE(config.wants("W402", "/tree/library/a.scene"));
  EXPECT_FALSE(config.wants("W402", "/tree/b/a.json"));
  EXPECT_FALSE(config.wants("W401", "/tree/library/a.scene"));
  EXPECT_TRUE(config.wants("W402", "/tree/library/new/a.scene"));
  EXPECT_FALSE(config.wants("E104", "/tree/library/new/a.scene"));
}

TEST(LintConfig, ReportsAllMistakesAtTheirPlaces) {
  const auto [config, errors] = parse(R"([lint]
slect = ["E"]
ignore = "W402"
max-warnings = -1
[[lint.overrides]]
files = ["[a", 1]
ignore = ["E1044"]
[[lint.overrides]]
file = ["a"]
[format]
)");
  EXPECT_THAT(
      errors,
      ElementsAre(
          ".sdlc.toml:2:1: unknown key `slect` in [lint] (did you mean `select`?)",
          ".sdlc.toml:3:10: `ignore` takes an array of codes, such as [\"E104\", \"W4\"], not a "
          "string",
          ".sdlc.toml:4:16: `max-warnings` cannot be negative",
          ".sdlc.toml:6:10: the pattern `[a` has a `[` that is not closed",
          ".sdlc.toml:6:16: `files` takes an array of patterns, such as [\"library/**\"], not a "
          "whole number",
          ".sdlc.toml:7:11: no diagnostic code begins with `E1044` (did you mean `E104`?)",
          ".sdlc.toml:8:1: [[lint.overrides]] has no `files`",
          ".sdlc.toml:9:1: unknown key `file` in [[lint.overrides]] (did you mean `files`?)",
          ".sdlc.toml:10:2: unknown key `format`"));
}

TEST(LintConfig, ReportsWhereItIsNotToml) {
  const auto [config, errors] = parse("[lint]\nselect = [\n");
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_THAT(errors[0], HasSubstr(".sdlc.toml:2:12: "));
  EXPECT_THAT(parse("lint = 3\n").errors,
              ElementsAre(".sdlc.toml:1:8: `lint` takes a table: [lint], not a whole number"));
}

TEST(LintConfig, OfTheDocumentationIsRead) {
  const std::string page =
      test::content_of(std::filesystem::path(SDLC_SOURCE_DIR) / "docs/lint.md");
  const std::string fence = "```toml lint\n";
  const std::size_t begin = page.find(fence);
  ASSERT_NE(begin, std::string::npos);
  const std::size_t first = begin + fence.size();
  const auto [config, errors] = parse(page.substr(first, page.find("```", first) - first));
  EXPECT_THAT(errors, IsEmpty());
  EXPECT_EQ(config.max_warnings, 5u);
  EXPECT_FALSE(config.wants("W403", "/tree/a.scene"));
  EXPECT_TRUE(config.wants("W402", "/tree/a.scene"));
  EXPECT_FALSE(config.wants("W402", "/tree/library/shapes/a.scene"));
  EXPECT_FALSE(config.wants("W402", "/tree/old/deep/a.json"));
  EXPECT_TRUE(config.wants("E104", "/tree/old/deep/a.json"));
}

/// A scene with one warning, W402, and one without.
class LintWithConfig : public testing::Test {
 protected:
  LintWithConfig() { write("scenes/ball.scene", kBall); }

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    test::write_text(folder_ / name, text);
  }
  test::ProgramResult run(const std::string& arguments) const {
    return test::run_shell(folder_.path(), "\"$SDLC\" lint --format concise " + arguments);
  }

  static constexpr const char* kBall =
      "scene 1\n"
      "camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n"
      "sphere { center: (0, 0, 0), radius: 1, material: unlit(red) }\n"
      "sphere { center: (3, 0, 0), radius: 0, material: unlit(red) }\n";
  test::TemporaryFolder folder_;
};

TEST_F(LintWithConfig, TakesTheNearestConfigUpwards) {
  write(".sdlc.toml", "[lint]\nignore = ['W402']\n");
  EXPECT_EQ(run("scenes/ball.scene").exit_code, 0);
  write("scenes/.sdlc.toml", "");
  EXPECT_EQ(run("scenes/ball.scene").exit_code, 1);
}

TEST_F(LintWithConfig, LooksNoFurtherThanAFolderWithGit) {
  write(".sdlc.toml", "[lint]\nignore = ['W402']\n");
  std::filesystem::create_directory(folder_ / "scenes/.git");
  EXPECT_EQ(run("scenes/ball.scene").exit_code, 1);
  write("scenes/.sdlc.toml", "[lint]\nignore = ['W402']\n");
  EXPECT_EQ(run("scenes/ball.scene").exit_code, 0);
}

TEST_F(LintWithConfig, UsesTheFolderOfTheNameOfStandardInput) {
  write("scenes/.sdlc.toml", "[lint]\nignore = ['W402']\n");
  EXPECT_EQ(run("- --stdin-filename scenes/new.scene <scenes/ball.scene").exit_code, 0);
  EXPECT_EQ(run("- <scenes/ball.scene").exit_code, 1);
}

TEST_F(LintWithConfig, LetsFlagsDecideBeforeConfigs) {
  write(".sdlc.toml", "[lint]\nignore = ['W402']\n");
  EXPECT_EQ(run("scenes --select W4").exit_code, 1);
  EXPECT_EQ(run("scenes --ignore E1").exit_code, 0);
  EXPECT_EQ(run("scenes --no-config").exit_code, 1);
}

TEST_F(LintWithConfig, UsesOneConfigForAllOnRequest) {
  write("scenes/.sdlc.toml", "[lint]\nslect = []\n");
  write("ci/lint.toml", "[[lint.overrides]]\nfiles = ['../scenes/**']\n");
  EXPECT_THAT(run("scenes --config ci/lint.toml").err,
              HasSubstr("error: ci/lint.toml:2:10: the pattern `../scenes/**` has `.` or `..`"));
  write("lint.toml", "[[lint.overrides]]\nfiles = ['scenes/**']\nignore = ['W']\n");
  EXPECT_EQ(run("scenes --config lint.toml").exit_code, 0);
  EXPECT_EQ(run("scenes --config missing.toml").exit_code, 2);
  EXPECT_EQ(run("scenes --config lint.toml --no-config").exit_code, 2);
}

TEST_F(LintWithConfig, CountsTheWarningsOfEachConfig) {
  write("scenes/.sdlc.toml", "[lint]\nmax-warnings = 1\n");
  EXPECT_EQ(run("scenes").exit_code, 0);
  write("scenes/other.scene", kBall);
  EXPECT_EQ(run("scenes").exit_code, 1);
  EXPECT_EQ(run("scenes --max-warnings 2").exit_code, 0);
  std::filesystem::remove(folder_ / "scenes/other.scene");
  EXPECT_EQ(run("scenes --max-warnings 0").exit_code, 1);
  write("other/other.scene", kBall);
  EXPECT_EQ(run("scenes other").exit_code, 1);
}

TEST_F(LintWithConfig, RefusesAWrongConfigBeforeAnythingIsChecked) {
  write(".sdlc.toml", "[lint]\nslect = []\nignore = ['X']\n");
  const test::ProgramResult result = run("scenes");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("error: .sdlc.toml:2:1: unknown key `slect` in [lint]"));
  EXPECT_THAT(result.err, HasSubstr("error: .sdlc.toml:3:11: no diagnostic code begins with"));
}

TEST_F(LintWithConfig, AsksTheConfigOfAnImportedFileToo) {
  write("library/.sdlc.toml", "[lint]\nignore = ['E104']\n");
  write("library/part.scene", "scene 1\nlet a = 1 / 0\nsphere { center: (0, 0, 0), radus: 1 }\n");
  write("use.scene",
        "scene 1\nimport \"library/part.scene\" as part\nlet b = part.a\nlet c = 1 / 0\n");
  const std::string out = run("use.scene").out;
  EXPECT_THAT(out, HasSubstr("library/part.scene:2:11: error[E215]"));
  EXPECT_THAT(out, Not(HasSubstr("E104")));
}

}  // namespace
}  // namespace sdlc::cli
