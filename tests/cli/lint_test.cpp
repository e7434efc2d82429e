#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kClean = R"(scene 1
camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }
sphere ball { center: (0, 0, 0), radius: 1, material: diffuse(color: white) }
)";

/// A safe fix at `;`, a guess at `radus`, none at the division.
constexpr const char* kWrong = R"(scene 1
let size = 1 / 0
let tall = 2;
camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }
sphere ball { center: (0, 0, 0), radus: 1, material: diffuse(color: white) }
)";

constexpr const char* kWrongConcisely =
    "wrong.scene:2:14: error[E215]: division by zero\n"
    "wrong.scene:3:13: error[E012]: `;` is not part of the language here\n"
    "wrong.scene:5:34: error[E104]: unknown property `radus` of sphere; did you mean radius?\n";

class LintCommand : public testing::Test {
 protected:
  LintCommand() {
    write("clean.scene", kClean);
    write("wrong.scene", kWrong);
  }
  void write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write_text(folder_ / name, text);
  }
  std::string read(const std::string& name) const { return content_of(folder_ / name); }
  ProgramResult run(const std::string& arguments) const {
    return run_shell(folder_.path(), "\"$SDLC\" lint " + arguments);
  }

  TemporaryFolder folder_;
};

TEST_F(LintCommand, PrintsNothingOnStandardOutputForACleanFile) {
  const ProgramResult result = run("clean.scene");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "1 file checked, nothing found\n");
  EXPECT_EQ(run("clean.scene --quiet").err, "");
}

TEST_F(LintCommand, PrintsAllFindingsOnStandardOutput) {
  const ProgramResult result = run("wrong.scene --format concise");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, kWrongConcisely);
  EXPECT_EQ(result.err, "");
}

TEST_F(LintCommand, CountsTheFindingsOfAllFilesOnce) {
  write("also.scene", "scene 1\nimport \"wrong.scene\" as w\nlet x = w.heavy\n");
  const ProgramResult result = run("clean.scene also.scene wrong.scene");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("also.scene:3:9"));
  EXPECT_THAT(result.out, HasSubstr("\n4 errors\n"));
}

TEST_F(LintCommand, ShowsTheFindingsOfAFileThatReadsOneWithMoreThanAreShown) {
  std::string library = "scene 1\n";
  for (int i = 0; i < 60; ++i) library += "let x" + std::to_string(i) + " = 1 / 0\n";
  write("lib.scene", library);
  write("root.scene", std::string(kClean) + "import \"lib.scene\" as lib\nlet own = lib.x1 + y\n");
  const ProgramResult result = run("lib.scene root.scene --format concise");
  EXPECT_EQ(std::ranges::count(result.out, '\n'), 51);
  EXPECT_THAT(result.out, HasSubstr("\nroot.scene:5:20: error[E101]: unknown name `y`"));
}

TEST_F(LintCommand, MakesOneJsonDocumentOfAllFiles) {
  write("warns.scene",
        std::string(kClean) + "sphere { center: (3, 0, 0), radius: 0, material: unlit(red) }\n");
  const ProgramResult result = run("wrong.scene warns.scene --format json");
  EXPECT_EQ(result.exit_code, 1);
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["errors"], 3);
  EXPECT_EQ(json["warnings"], 1);
  EXPECT_EQ(json["diagnostics"].size(), 4u);
  EXPECT_EQ(json["diagnostics"][1]["fixes"][0]["is_safe"], true);
  EXPECT_EQ(json["diagnostics"][2]["fixes"][0]["is_safe"], false);
}

TEST_F(LintCommand, ReadsStandardInputUnderAnyName) {
  const ProgramResult result =
      run("- --stdin-filename other/wrong.scene --format concise <wrong.scene");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("other/wrong.scene:2:14: error[E215]"));
  EXPECT_THAT(run("- --format concise <wrong.scene").out, HasSubstr("<stdin>:2:14"));
}

TEST_F(LintCommand, LooksIntoFolders) {
  write("scenes/b/deep.scene", kWrong);
  write("scenes/.hidden/c.scene", kWrong);
  write("scenes/package.json", R"({"name": "no config", "camera": "no"})");
  write("scenes/a.json", R"({"camera": {}, "rendering": {}, "saving": {}, "radus": 1})");
  const ProgramResult result = run("scenes --format concise");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("scenes/a.json:1:"));
  EXPECT_THAT(result.out, HasSubstr("scenes/b/deep.scene:2:14"));
  EXPECT_THAT(result.out, Not(HasSubstr("hidden")));
  EXPECT_THAT(result.out, Not(HasSubstr("package")));
}

TEST_F(LintCommand, ReportsBrokenLinksOfAFolderAndChecksTheRest) {
  write("scenes/clean.scene", std::string(kClean));
  std::filesystem::create_symlink("b.scene", folder_ / "scenes/a.scene");
  std::filesystem::create_symlink("a.scene", folder_ / "scenes/b.scene");
  std::filesystem::create_symlink("nowhere", folder_ / "scenes/c.scene");
  std::filesystem::create_symlink("nowhere", folder_ / "scenes/note.txt");
  write("scenes/wrong.scene", "scene 1\nlet a =\n");
  const ProgramResult result = run("scenes --format concise");
  EXPECT_EQ(result.exit_code, 2);
  for (const char* name : {"a", "b", "c"}) {
    EXPECT_THAT(result.err, HasSubstr(std::string("cannot read `scenes/") + name + ".scene`"));
  }
  EXPECT_THAT(result.err, Not(HasSubstr("note")));
  EXPECT_THAT(result.out, HasSubstr("scenes/wrong.scene:2:8"));
}

TEST_F(LintCommand, RefusesAFolderWithoutScenes) {
  std::filesystem::create_directory(folder_ / "empty");
  const ProgramResult result = run("empty");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "error: no scenes in `empty`\n");
}

TEST_F(LintCommand, ContinuesAfterAMissingFile) {
  const ProgramResult result = run("missing.scene wrong.scene --format concise");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("cannot read `missing.scene`"));
  EXPECT_EQ(result.out, kWrongConcisely);
}

TEST_F(LintCommand, TakesAFileWithoutCameraAsAPartOfOthers) {
  write("part.scene", "scene 1\nsphere { center: (0, 0, 0), radius: 1 }\n");
  EXPECT_EQ(run("part.scene").exit_code, 0);
  write("library.scene", "scene 1\nlet gold = specular(color: #ffd700)\n");
  EXPECT_EQ(run("library.scene").exit_code, 0);
  write("picture.scene",
        "scene 1\nrender { width: 9 }\nsphere { center: (0, 0, 0), radius: 1, material: unlit(red) "
        "}\n");
  EXPECT_THAT(run("picture.scene --format concise").out, HasSubstr("E213"));
}

TEST_F(LintCommand, LooksAtEveryCamera) {
  write("two.scene",
        std::string(kClean) + "camera side { from: (1, 1, 1), at: (1, 1, 1), fov: 40deg }\n");
  const ProgramResult result = run("two.scene --format concise");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("two.scene:4:36: error[E207]"));
  EXPECT_THAT(result.out, Not(HasSubstr("E111")));
}

TEST_F(LintCommand, LooksAtTheLastFrameToo) {
  write("film.scene",
        std::string(kClean) +
            "animation { frames: 0 .. 9, step: 2, fps: 1 }\n"
            "let sizes = [1, 1, 1, 1, 1, 1, 1, 1]\n"
            "sphere { center: (2, 0, 0), radius: sizes[time / 1s], material: unlit(red) }\n");
  EXPECT_THAT(run("film.scene --format concise").out,
              HasSubstr("index 8 is out of range: the list has length 8"));
}

TEST_F(LintCommand, SelectsAndIgnoresByCodeAndBeginning) {
  EXPECT_EQ(run("wrong.scene --format concise --select e1").out,
            "wrong.scene:5:34: error[E104]: unknown property `radus` of sphere; did you mean "
            "radius?\n");
  EXPECT_EQ(run("wrong.scene --format concise --ignore E1 --ignore E215").out,
            "wrong.scene:3:13: error[E012]: `;` is not part of the language here\n");
  EXPECT_EQ(run("wrong.scene --ignore E").exit_code, 0);
  EXPECT_THAT(run("wrong.scene --format concise --ignore E1 --select E104,E2").out,
              HasSubstr("E104"));
  const ProgramResult unknown = run("wrong.scene --select E999");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("no diagnostic code begins with `E999`"));
}

TEST_F(LintCommand, AllowsSoManyWarnings) {
  write("warns.scene",
        std::string(kClean) + "sphere { center: (3, 0, 0), radius: 0, material: unlit(red) }\n");
  EXPECT_EQ(run("warns.scene").exit_code, 1);
  EXPECT_EQ(run("warns.scene --max-warnings 1").exit_code, 0);
  EXPECT_EQ(run("wrong.scene --max-warnings 9").exit_code, 1);
}

TEST_F(LintCommand, AppliesSafeFixes) {
  const ProgramResult result = run("wrong.scene clean.scene --fix --format concise");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "fixed 1 finding in 1 file\n");
  EXPECT_THAT(read("wrong.scene"), HasSubstr("let tall = 2\n"));
  EXPECT_THAT(read("wrong.scene"), HasSubstr("radus"));
  EXPECT_EQ(read("clean.scene"), kClean);
}

TEST_F(LintCommand, AppliesGuessesOnlyOnRequest) {
  EXPECT_THAT(run("wrong.scene").err, HasSubstr("1 finding can be fixed with --unsafe-fixes"));
  run("wrong.scene --unsafe-fixes");
  EXPECT_THAT(read("wrong.scene"), HasSubstr("radius: 1"));
  EXPECT_EQ(run("wrong.scene --format concise").out,
            "wrong.scene:2:14: error[E215]: division by zero\n");
}

TEST_F(LintCommand, PrintsEachGuessThatItApplies) {
  EXPECT_EQ(run("wrong.scene --unsafe-fixes --format concise").err,
            "guess: wrong.scene:5:34: E104: `radus` to `radius`\nfixed 2 findings in 1 file\n");
  write("wrong.scene", kWrong);
  EXPECT_THAT(run("wrong.scene --unsafe-fixes --diff").err, HasSubstr("guess: wrong.scene:5:34"));
  EXPECT_EQ(run("wrong.scene --unsafe-fixes --quiet").err, "");
}

TEST_F(LintCommand, AppliesNoFixThatLeavesMoreErrors) {
  // `gold` is a colour: a guess that causes another error.
  const std::string lamp = std::string(kClean) +
                           "def lamp(bulb = unlit(red)) {\n"
                           "  sphere { center: (0, 2, 0), radius: 1, material: bulb }\n"
                           "}\n"
                           "lamp { bulb: cold }\n";
  write("lamp.scene", lamp);
  const ProgramResult result = run("lamp.scene --unsafe-fixes");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("1 fix not applied: "));
  EXPECT_EQ(read("lamp.scene"), lamp);
}

TEST_F(LintCommand, AppliesNoFixInsideAString) {
  const std::string config = R"({"spheres": [{"origin"x [0, 0, 0]}]})";
  write("broken.json", config);
  for (int i = 0; i < 2; ++i) run("broken.json --fix");
  EXPECT_EQ(read("broken.json"), config);
}

TEST_F(LintCommand, FixesWhatAFixUncovers) {
  write("hidden.scene", std::string(kClean) + "let a = 2 m && 'x'\n");
  run("hidden.scene --fix");
  EXPECT_THAT(read("hidden.scene"), HasSubstr("let a = 2m and \"x\"\n"));
}

TEST_F(LintCommand, FixesAllOfManyFindings) {
  std::string text = std::string(kClean) + "let x = 1\n";
  for (int i = 0; i < 1200; ++i) {
    text += "sphere { center: (x -" + std::to_string(i) +
            ", 5, 0), radius: 0.1, material: unlit(red) }\n";
  }
  write("many.scene", text);
  const ProgramResult result = run("many.scene --fix");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("fixed 1200 findings in 1 file\n"));
}

TEST_F(LintCommand, FixesMoreFindingsThanAreShown) {
  std::string text = kClean;
  for (int i = 0; i < 60; ++i) text += "let a" + std::to_string(i) + " = 1 / 0\n";
  write("many.scene", text + "let last = 2;\n");
  const ProgramResult result = run("many.scene --fix --format concise");
  EXPECT_THAT(result.err, HasSubstr("fixed 1 finding in 1 file\n"));
  EXPECT_THAT(read("many.scene"), testing::EndsWith("let last = 2\n"));
  EXPECT_EQ(std::ranges::count(result.out, '\n'), 50) << "of the remaining ones";
}

TEST_F(LintCommand, ReportsAPictureThatCannotBeWritten) {
  const auto lint = [&](const std::string& output) {
    write("out.scene", kClean + ("render { output: " + output + " }\n"));
    return run("out.scene --format concise").out;
  };
  EXPECT_EQ(lint("\"a.jpgg\""),
            "out.scene:4:21: error[E239]: no picture can be written to `a.jpgg`: unknown extension "
            "`.jpgg`; known are png exr hdr tiff tif jpg jpeg webp ppm gif; did you mean jpg?\n");
  EXPECT_THAT(lint("\"a.bmp\""), HasSubstr(":18: error[E239]"));
  EXPECT_THAT(lint("\"a\""), HasSubstr("the name has no extension; known are png"));
  EXPECT_THAT(lint("\"\""), HasSubstr("the name is empty"));
  EXPECT_THAT(lint("\"pictures/\""), HasSubstr("it names a folder"));
  EXPECT_THAT(lint("\"..\""), HasSubstr("it names a folder"));
  EXPECT_THAT(lint("\"a\\u0000.png\""), HasSubstr("a name cannot contain U+0000"));
  EXPECT_THAT(lint("\"" + std::string(252, 'a') + ".png\""), HasSubstr("longer than 255 bytes"));
  EXPECT_THAT(lint("\"a.webp\", width: 20000, height: 10"), HasSubstr("too many for WebP"));
  for (const char* good : {"\"a.JPG\"", "\"new/folder/a.b.exr\"", "\"-.png\"", "\" .gif.png\""}) {
    EXPECT_EQ(lint(good), "");
  }
  lint("\"a.pgn\"");
  run("out.scene --unsafe-fixes");
  EXPECT_THAT(read("out.scene"), HasSubstr("output: \"a.png\""));
  write("wrong-name.scene", kClean + std::string("render { output: \"a.bmp\" }\n"));
  EXPECT_THAT(run_shell(folder_.path(), "\"$SDLC\" inspect wrong-name.scene").err,
              HasSubstr("error[E239]"));
  EXPECT_EQ(
      run_shell(folder_.path(), "\"$SDLC\" render wrong-name.scene -o a.png --width 4 --quiet")
          .exit_code,
      0)
      << "its own name is not used";
}

TEST_F(LintCommand, AllowsTheSameBeforeAndAfterFmt) {
  write("allowed.scene", R"(scene 1
camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }
sphere { center: (0, 0, 1), radius: 0, material: unlit(red) } sphere { center: (0, 0, 2), radius: 0, material: unlit(red) } // sdlc: allow(W402)
group { sphere { center: (0, 0, 3), radius: 0 } sphere { center: (0, 0, 4), radius: 0 } // sdlc: allow(W402)
  material: unlit(red) }
sphere { center: (0, 0, 5), radius: 0, // sdlc: allow(W402)
  material: unlit(red) }
sphere { // sdlc: allow(W402)
  center: (0, 0, 6), radius: 0, material: unlit(red) }
sphere a_ball_with_a_name_as_long_as_a_line { center: (0, 0, 7), radius: 0, material: unlit(red) } // sdlc: allow(W402)
for i in range(8, 9) { sphere { center: (0, 0, i), radius: 0, material: unlit(red) } } // sdlc: allow(W402)
if true { sphere { center: (0, 0, 9), radius: 0, material: unlit(red) }
} // sdlc: allow(W402)
else { let a = 1, sphere { center: (a, 0, 10), radius: 0, material: unlit(red) } }
)");
  const ProgramResult before = run("allowed.scene --format json");
  EXPECT_EQ(run_shell(folder_.path(), "\"$SDLC\" fmt allowed.scene").exit_code, 0);
  const ProgramResult behind = run("allowed.scene --format json");
  const auto found = [](const ProgramResult& result) {
    std::vector<std::string> lines;
    const auto report = nlohmann::json::parse(result.out);
    for (const auto& each : report["diagnostics"]) {
      lines.push_back(each["code"]);
    }
    return lines;
  };
  EXPECT_EQ(found(before), found(behind)) << before.out << behind.out;
  EXPECT_THAT(found(before), testing::ElementsAre("W402", "W402"));
}

TEST_F(LintCommand, FixesStandardInputToStandardOutput) {
  const ProgramResult result = run("- --fix --format concise <wrong.scene");
  EXPECT_THAT(result.out, HasSubstr("let tall = 2\n"));
  EXPECT_THAT(result.err, HasSubstr("<stdin>:2:14: error[E215]"));
}

TEST_F(LintCommand, FixesConfigsToo) {
  write("old.json", "{\n  'camera': {}, // the one\n}\n");
  run("old.json --fix");
  EXPECT_EQ(read("old.json"), "{\n  \"camera\": {} // the one\n}\n");
  run("old.json --unsafe-fixes");
  EXPECT_EQ(read("old.json"), "{\n  \"camera\": {} \n}\n");
}

TEST_F(LintCommand, ShowsWhatWouldBeFixed) {
  const ProgramResult result = run("wrong.scene clean.scene --diff");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("-let tall = 2;\n+let tall = 2\n"));
  EXPECT_THAT(result.out, Not(HasSubstr("E215")));
  EXPECT_EQ(result.err, "would fix 1 finding in 1 file\n");
  EXPECT_EQ(read("wrong.scene"), kWrong);
  EXPECT_THAT(run("wrong.scene --unsafe-fixes --diff").out, HasSubstr("radius: 1"));
}

TEST_F(LintCommand, ShowsAPatchThatFixes) {
  if (!has_program("patch")) GTEST_SKIP() << "no patch here";
  EXPECT_EQ(run("wrong.scene --diff >it.patch").exit_code, 1);
  EXPECT_EQ(run_shell(folder_.path(), "patch -p0 <it.patch").exit_code, 0);
  EXPECT_THAT(read("wrong.scene"), HasSubstr("let tall = 2\n"));
  EXPECT_EQ(run("wrong.scene --diff").exit_code, 0);
}

TEST_F(LintCommand, ShowsNoPatchIfNothingCanBeFixed) {
  const ProgramResult result = run("clean.scene --diff");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out + result.err, "");
}

TEST_F(LintCommand, ShowsAPatchOfStandardInput) {
  const ProgramResult result = run("- --stdin-filename new.scene --diff <wrong.scene");
  EXPECT_THAT(result.out, HasSubstr("+let tall = 2\n"));
  EXPECT_TRUE(result.out.starts_with("--- new.scene")) << result.out;
}

TEST_F(LintCommand, LeavesAFileThatCannotBeWrittenAsItWas) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everything";
  std::filesystem::permissions(
      folder_.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const ProgramResult result = run("wrong.scene --fix");
  std::filesystem::permissions(folder_.path(), std::filesystem::perms::owner_all);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(read("wrong.scene"), kWrong);
}

}  // namespace
}  // namespace sdlc::test
