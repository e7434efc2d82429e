#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

// --set, --limit and --sandbox: the options of every command that reads a scene.
namespace sdlc::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kRow = R"(scene 1
param count = 3
param name = "row.png"
param tint: color = red
camera main { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg }
for i in range(count) { sphere { center: (i, 0, 0), radius: 0.4, material: unlit(tint) } }
render { width: 16, samples: 1, output: name }
)";

class SceneFlags : public testing::Test {
 protected:
  SceneFlags() {
    std::filesystem::create_directory(folder_ / "scene");
    write("scene/row.scene", kRow);
  }

  void write(const std::string& name, const std::string& text) { write_text(folder_ / name, text); }
  /// Renders FILE with flags; the scene chooses the output.
  ProgramResult render(const std::string& arguments) {
    return run_shell(folder_.path(), "\"$SDLC\" render --format concise --quiet " + arguments);
  }
  /// Compiles FILE with flags, without a picture.
  ProgramResult compile(const std::string& arguments) {
    return run_shell(folder_.path(), "\"$SDLC\" inspect --format concise " + arguments);
  }
  int sphere_count(const std::string& arguments) {
    const ProgramResult result =
        run_shell(folder_.path(), "\"$SDLC\" inspect --format json " + arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments << "\n" << result.err;
    const bool is_good = result.exit_code == 0;
    return is_good ? nlohmann::json::parse(result.out)["spheres"]["count"].get<int>() : -1;
  }

  TemporaryFolder folder_;
};

TEST_F(SceneFlags, SetGivesAParamAnotherValue) {
  EXPECT_EQ(sphere_count("scene/row.scene"), 3);
  EXPECT_EQ(sphere_count("scene/row.scene --set count=5"), 5);
  EXPECT_EQ(sphere_count("scene/row.scene --set count=5 --set count=2"), 2) << "the last one";
  EXPECT_EQ(sphere_count("scene/row.scene --set 'count=sqrt(16)' --set=tint=#0f0"), 4);
  EXPECT_EQ(sphere_count("--set count=1 - <scene/row.scene"), 1);
}

TEST_F(SceneFlags, TheFileMayFollowFlagsThatMayBeRepeated) {
  for (const char* flag : {"--set count=1", "--limit steps=999", "-o a.ppm", "-o a.ppm -o b.ppm"}) {
    const ProgramResult result = render(std::string(flag) + " scene/row.scene --samples 1");
    EXPECT_EQ(result.exit_code, 0) << flag << "\n" << result.err;
  }
}

TEST_F(SceneFlags, SetTakesATextAsItIs) {
  EXPECT_EQ(render("scene/row.scene --set 'name=a=b \"c\".png'").exit_code, 0);
  EXPECT_THAT(names_in(folder_.path()), ElementsAre("a=b \"c\".png", "scene"));
}

TEST_F(SceneFlags, SetRefusesWhatIsNoPair) {
  for (const char* flag : {"--set count", "--set =5", "--set ''", "--set"}) {
    const ProgramResult result = compile("scene/row.scene " + std::string(flag));
    EXPECT_EQ(result.exit_code, 2) << flag;
    EXPECT_THAT(result.err, HasSubstr("--set")) << flag;
  }
}

TEST_F(SceneFlags, SetOfAnUnknownParamIsAnErrorThatNamesTheNearest) {
  const ProgramResult result = compile("scene/row.scene --set cuont=5");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("error[E122]: the scene has no param `cuont`"));
  const ProgramResult shown =
      run_shell(folder_.path(), "\"$SDLC\" render scene/row.scene --color never --set cuont=5");
  EXPECT_THAT(shown.err, HasSubstr("did you mean `count`?"));
  EXPECT_THAT(names_in(folder_.path()), ElementsAre("scene"));
}

TEST_F(SceneFlags, SetIsReportedAtItsInvalidValue) {
  const ProgramResult type = compile("scene/row.scene --set count=red");
  EXPECT_EQ(type.exit_code, 1);
  EXPECT_THAT(type.err, HasSubstr("--set count:1:1: error[E238]: "));
  const ProgramResult syntax = compile("scene/row.scene --set 'count=2 +'");
  EXPECT_EQ(syntax.exit_code, 1);
  EXPECT_THAT(syntax.err, HasSubstr("--set count:1:4: error[E001]: "));
}

TEST_F(SceneFlags, SetNeverPrintsControlCharacters) {
  const ProgramResult result = compile(
      "scene/row.scene --set \"$(printf 'a\\033[31m')=5\" "
      "--set \"$(printf 'count=\\033[31m')\"");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, Not(HasSubstr("\x1b")));
}

TEST_F(SceneFlags, ALimitStopsTheSceneWithAnErrorOfItsOwn) {
  write("scene/all.scene",
        "scene 1\ninclude \"row.scene\"\nlet a = \"0123456789\"\n"
        "camera main { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg } render { width: 16, samples: 1 "
        "}");
  const auto error_with = [&](const std::string& limit) {
    const ProgramResult result = compile("scene/all.scene --limit " + limit);
    EXPECT_EQ(result.exit_code, 1) << limit;
    return result.err;
  };
  EXPECT_THAT(error_with("steps=2"), HasSubstr("E304"));
  EXPECT_THAT(error_with("memory=1000"), HasSubstr("E315"));
  EXPECT_THAT(error_with("objects=2"), HasSubstr("E305"));
  EXPECT_THAT(error_with("string=9"), HasSubstr("E306"));
  EXPECT_THAT(error_with("include-depth=0"), HasSubstr("E307"));
  EXPECT_THAT(error_with("file=20"), HasSubstr("E308"));
  EXPECT_THAT(error_with("steps=1000 --limit steps=2"), HasSubstr("E304")) << "the last one";
  EXPECT_EQ(sphere_count("scene/all.scene --limit steps=1000 --limit objects=3 --limit string=10 "
                         "--limit memory=10000 --limit include-depth=1 --limit file=1000"),
            3);
}

TEST_F(SceneFlags, LimitsAreNamesAndWholeNumbers) {
  for (const char* flag :
       {"--limit steps", "--limit steps=", "--limit steps=-1", "--limit steps=1e3",
        "--limit steps=0x10", "--limit steps=5k", "--limit =5", "--limit"}) {
    const ProgramResult result = compile("scene/row.scene " + std::string(flag));
    EXPECT_EQ(result.exit_code, 2) << flag;
    EXPECT_THAT(result.err, HasSubstr("--limit")) << flag;
  }
  EXPECT_EQ(compile("scene/row.scene --limit steps=99999999999999999999").exit_code, 2);
  const ProgramResult unknown = compile("scene/row.scene --limit step=5");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("unknown limit `step` (did you mean `steps`?)"));
}

TEST_F(SceneFlags, TheHelpNamesTheLimitsWithTheirDefaults) {
  const std::string help = run_shell(folder_.path(), "\"$SDLC\" render --help").out;
  for (const char* limit :
       {"steps (100000000", "objects (100000000", "string (1048576", "include-depth (32",
        "file (33554432", "config (268435456", "memory (1073741824"}) {
    // The help may break a line anywhere.
    std::string joined;
    for (const char c : help) {
      if (c != '\n' && (c != ' ' || !joined.ends_with(' '))) joined += c;
    }
    EXPECT_THAT(joined, HasSubstr(limit));
  }
}

/// Files inside and outside the folder of a scene.
class Sandbox : public SceneFlags {
 protected:
  Sandbox() {
    write("outside.scene", kPart);
    std::filesystem::create_directory(folder_ / "scene/lib");
    write("scene/lib/inside.scene", kPart);
  }

  /// The exit status and the output for a scene that includes this file.
  ProgramResult including(const std::string& file, const std::string& flags = "--sandbox") {
    write("scene/main.scene", std::string(kCamera) + "include \"" + file + "\"\n");
    return compile(flags + " scene/main.scene");
  }
  void expect_refused(const std::string& file) {
    const ProgramResult result = including(file);
    EXPECT_EQ(result.exit_code, 1) << file;
    EXPECT_THAT(result.err, HasSubstr("main.scene:4:9: error[E312]: ")) << file;
    EXPECT_EQ(including(file, "").exit_code, 0) << file << ": without the sandbox it is there";
  }
  void expect_allowed(const std::string& file) {
    const ProgramResult result = including(file);
    EXPECT_EQ(result.exit_code, 0) << file << "\n" << result.err;
  }

  static constexpr const char* kPart =
      "scene 1\nsphere { center: (0, 0, 0), radius: 1, material: unlit(red) }\n";
  static constexpr const char* kCamera =
      "scene 1\ncamera main { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg }\n"
      "render { width: 16, samples: 1 }\n";
};

TEST_F(Sandbox, RefusesWhatIsOutsideOfTheScenesFolder) {
  expect_refused("../outside.scene");
  expect_refused("lib/../../outside.scene");
  expect_refused((folder_ / "outside.scene").string());
}

TEST_F(Sandbox, AllowsWhatIsInside) {
  expect_allowed("lib/inside.scene");
  expect_allowed("./lib/../lib/inside.scene");
  expect_allowed("../scene/lib/inside.scene");
  expect_allowed((folder_ / "scene/lib/inside.scene").string());
}

TEST_F(Sandbox, SeesWhereLinksLead) {
  namespace fs = std::filesystem;
  fs::create_symlink("../outside.scene", folder_ / "scene/link.scene");
  fs::create_directory_symlink("..", folder_ / "scene/up");
  fs::create_symlink("link.scene", folder_ / "scene/twice.scene");
  expect_refused("link.scene");
  expect_refused("up/outside.scene");
  expect_refused("twice.scene");
  fs::create_symlink("lib/inside.scene", folder_ / "scene/good.scene");
  fs::create_directory_symlink("scene", folder_ / "other");
  expect_allowed("good.scene");
  // No link outside is resolved.
  expect_refused("../other/lib/inside.scene");
}

TEST_F(Sandbox, HoldsForTheFilesOfFiles) {
  write("scene/lib/more.scene", "scene 1\ninclude \"../../outside.scene\"\n");
  const ProgramResult result = including("lib/more.scene");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("lib/more.scene:2:9: error[E312]"));
  write("scene/lib/more.scene", "scene 1\ninclude \"../row.scene\"\n");
  expect_allowed("lib/more.scene");
}

TEST_F(Sandbox, DoesNotTellWhetherAFileOutsideIsThere) {
  const ProgramResult there = including("../outside.scene");
  const ProgramResult missing = including("../missing.scene");
  EXPECT_THAT(missing.err, HasSubstr("E312"));
  EXPECT_THAT(there.err, HasSubstr("E312"));
}

TEST_F(Sandbox, IsTheWorkingFolderForAFileInIt) {
  write("here.scene", std::string(kCamera) + "include \"outside.scene\"\n");
  EXPECT_EQ(compile("--sandbox here.scene").exit_code, 0);
  EXPECT_EQ(compile("--sandbox ./here.scene").exit_code, 0);
  EXPECT_EQ(compile("--sandbox - <here.scene").exit_code, 0);
  EXPECT_EQ(run_shell(folder_ / "scene", "\"$SDLC\" inspect --sandbox ../here.scene").exit_code, 0);
  const ProgramResult inside = compile("--sandbox --stdin-filename scene/here.scene - <here.scene");
  EXPECT_THAT(inside.err, HasSubstr("E309")) << "scene/outside.scene is not there";
}

TEST_F(Sandbox, MayBeNamedWithDotDot) {
  namespace fs = std::filesystem;
  fs::create_directory(folder_ / "other");
  const fs::path absolute = folder_ / "other/../scene/main.scene";
  for (const std::string& scene :
       {std::string("../scene/main.scene"), std::string("../other/../scene/main.scene"),
        absolute.string()}) {
    const auto inspect = [&](const std::string& file) {
      write("scene/main.scene", std::string(kCamera) + "include \"" + file + "\"\n");
      return run_shell(folder_ / "other", "\"$SDLC\" inspect --sandbox '" + scene + "'");
    };
    const ProgramResult inside = inspect("lib/inside.scene");
    EXPECT_EQ(inside.exit_code, 0) << scene << "\n" << inside.err;
    EXPECT_THAT(inspect("../outside.scene").err, HasSubstr("E312")) << scene;
  }
}

TEST_F(Sandbox, NeverReadsStandardInputForAFileOfThatName) {
  write("here.scene", std::string(kCamera) + "include \"-\"\n");
  for (const std::string flags : {"", "--sandbox "}) {
    const ProgramResult result = compile(flags + "here.scene <outside.scene");
    EXPECT_EQ(result.exit_code, 1) << flags;
    EXPECT_THAT(result.err, testing::ContainsRegex("E309|E312")) << flags;
  }
  write("-", kPart);
  EXPECT_EQ(compile("here.scene </dev/null").exit_code, 0);
}

}  // namespace
}  // namespace sdlc::test
