#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// outer/box contains the scene; outputs have to stay there.
class SandboxedOutput : public testing::Test {
 protected:
  SandboxedOutput() { fs::create_directories(box_); }

  void write_scene(const std::string& output, const std::string& more = "") {
    write_text(box_ / "ball.scene",
               "scene 1\ncamera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
               "sphere ball { center: (0, 0, 0), radius: 1, material: unlit(red) }\n"
               "render { width: 8, samples: 1, output: \"" +
                   output + "\" }\n" + more);
  }
  void write_config(const std::string& path) {
    write_text(box_ / "ball.json",
               R"({"background": [0, 0, 0], "camera": {"look_from": [0, 0, 0],
"look_at": [0, 0, -1], "up": [0, 1, 0], "vfov": 90, "focal_length": 1, "aspect_ratio": 1.6,
"viewport_height": 2, "samples_per_pixel": 1}, "rendering": {"width": 8, "render_depth": 3},
"saving": {"path": ")" +
                   path + R"(", "gamma_correct": true}, "spheres": [{"origin": [0, 0, -3],
"radius": 1, "material": {"type": "no_texture", "color": [51, 102, 255]}}]})");
  }
  ProgramResult run(const std::string& arguments) {
    return run_shell(box_, "\"$SDLC\" " + arguments);
  }
  /// Everything below the temporary folder, to detect new files.
  std::vector<std::string> all_names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
      names.push_back(entry.path().string());
    }
    std::ranges::sort(names);
    return names;
  }

  TemporaryFolder folder_;
  const fs::path box_ = folder_ / "outer/box";
};

TEST_F(SandboxedOutput, StaysInTheScenesFolder) {
  fs::create_directory_symlink(folder_.path(), box_ / "link");
  fs::create_symlink(folder_ / "new.png", box_ / "picture.png");
  fs::create_symlink(folder_ / "new.png", box_ / "fine.partial.png");
  for (const std::string output :
       {std::string("../../esc.png"), (folder_ / "esc.png").string(), std::string("../new/x.png"),
        std::string("a/../../x.png"), std::string("link/x.png"), std::string("link/new/x.png"),
        std::string("picture.png"), std::string("fine.png")}) {
    write_scene(output);
    write_config(output);
    const auto before = all_names();
    for (const char* scene : {"ball.scene", "ball.json"}) {
      const ProgramResult result = run(std::string("render --sandbox ") + scene);
      EXPECT_THAT(result.exit_code, testing::AnyOf(1, 2)) << output;
      EXPECT_THAT(result.err, AllOf(HasSubstr("which --sandbox refuses"), HasSubstr("-o")))
          << output;
      EXPECT_EQ(all_names(), before) << output;
    }
  }
}

TEST_F(SandboxedOutput, IsPointedOutWhereItIsWritten) {
  write_scene("../esc.png");
  write_config("../esc.png");
  for (const char* command : {"render", "inspect", "lint"}) {
    for (const char* scene : {"ball.scene", "ball.json"}) {
      const ProgramResult result = run(std::string(command) + " --sandbox " + scene);
      EXPECT_EQ(result.exit_code, 1) << command << " " << scene;
      EXPECT_THAT(result.out + result.err, HasSubstr("E312")) << command << " " << scene;
    }
  }
}

TEST_F(SandboxedOutput, IsOfTheWorkingFolderUnlessTheSceneIsOnlyChecked) {
  write_scene("a.png");
  const auto above = [&](const std::string& command) {
    return run_shell(folder_.path(), "\"$SDLC\" " + command + " --sandbox outer/box/ball.scene");
  };
  EXPECT_EQ(above("render").exit_code, 1) << "a.png would be next to outer";
  EXPECT_FALSE(fs::exists(folder_ / "a.png"));
  EXPECT_EQ(above("lint").exit_code, 0);
  write_scene("../a.png");
  EXPECT_EQ(above("lint").exit_code, 1);
  write_scene("outer/box/a.png");
  EXPECT_EQ(above("render").exit_code, 0);
}

TEST_F(SandboxedOutput, IsWrittenInsideAndWithinNewFolders) {
  for (const std::string output : {"a.png", "new/deep/a.png", "../box/b.png"}) {
    write_scene(output);
    EXPECT_EQ(run("render --sandbox --quiet ball.scene").err, "") << output;
    EXPECT_TRUE(fs::exists(box_ / output)) << output;
  }
  write_scene((box_ / "c.png").string());
  EXPECT_EQ(run("render --sandbox ball.scene").exit_code, 0);
}

TEST_F(SandboxedOutput, GoesAnywhereOnTheCommandLine) {
  write_scene("../esc.png");
  EXPECT_EQ(run("render --sandbox ball.scene -o ../../asked.png").exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "asked.png"));
  EXPECT_FALSE(fs::exists(folder_ / "outer/esc.png"));
  EXPECT_EQ(run("measure --sandbox --budget 1s --quiet ball.scene -o ../../a.json").exit_code, 0);
}

TEST_F(SandboxedOutput, OfEveryFrameIsLookedAtBeforeTheFirst) {
  write_scene("f####.png", "animation { frames: 1..3, fps: 24 }\n");
  fs::create_symlink(folder_ / "new.png", box_ / "f0003.png");
  EXPECT_EQ(run("render --sandbox ball.scene").exit_code, 2);
  EXPECT_FALSE(fs::exists(box_ / "f0001.png"));
  EXPECT_FALSE(fs::exists(folder_ / "new.png"));
}

TEST_F(SandboxedOutput, OfADefaultNameIsNoLinkOutOfTheFolder) {
  write_text(box_ / "ball.scene",
             "scene 1\ncamera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
             "sphere ball { center: (0, 0, 0), radius: 1, material: unlit(red) }\n"
             "render { width: 8, samples: 1 }\n");
  EXPECT_EQ(run("render --sandbox ball.scene").exit_code, 0);
  fs::remove(box_ / "ball.png");
  fs::create_symlink(folder_ / "new.png", box_ / "ball.png");
  EXPECT_EQ(run("render --sandbox ball.scene").exit_code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "new.png"));
  EXPECT_EQ(run_shell(folder_.path(), "\"$SDLC\" render --sandbox outer/box/ball.scene").exit_code,
            0);
}

TEST_F(SandboxedOutput, OfAConversionFollowsNoLinkOutOfTheFolder) {
  write_scene("a.png");
  fs::create_symlink(folder_ / "new.json", box_ / "ball.json");
  EXPECT_EQ(run("convert --sandbox ball.scene").exit_code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "new.json"));
}

TEST_F(SandboxedOutput, SettingsAboveTheFolderAreNotRead) {
  write_scene("a.png");
  write_text(folder_ / "outer/.sdlc.toml", "nonsense = 1\n");
  EXPECT_EQ(run("lint ball.scene").exit_code, 2);
  EXPECT_EQ(run("lint --sandbox ball.scene").exit_code, 0);
  // Settings next to the scene apply, unless they are a link out of the folder.
  write_text(folder_ / "secret.toml", "secret = 1\n");
  fs::create_symlink(folder_ / "secret.toml", box_ / ".sdlc.toml");
  const ProgramResult link = run("lint --sandbox ball.scene");
  EXPECT_EQ(link.exit_code, 2);
  EXPECT_THAT(link.err, AllOf(HasSubstr("--sandbox"), Not(HasSubstr("unknown key"))));
  fs::remove(box_ / ".sdlc.toml");
  write_text(box_ / ".sdlc.toml", "nonsense = 1\n");
  EXPECT_EQ(run("lint --sandbox ball.scene").exit_code, 2);
}

TEST_F(SandboxedOutput, ScenesInAFolderAreNoLinksOutOfIt) {
  write_scene("a.png");
  write_text(folder_ / "secret.scene", "scene 1\nsecret\n");
  fs::create_symlink(folder_ / "secret.scene", box_ / "link.scene");
  EXPECT_EQ(run("lint .").exit_code, 1);
  EXPECT_EQ(run("lint --sandbox .").exit_code, 0);
}

}  // namespace
}  // namespace sdlc::test
