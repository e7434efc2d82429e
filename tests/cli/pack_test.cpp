#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program_test.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kCamera = "camera { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n";

const std::string kBall =
    std::string("scene 1\n") + kCamera +
    "sphere { center: (0, 0, 0), radius: 1, material: emissive(#FFFFFF, 2) }\n";

constexpr const char* kConfig = R"({
  "camera": {"look_from": [0, 1, 5], "look_at": [0, 0, 0], "up": [0, 1, 0], "vfov": 40, "aspect_ratio": 1.5,
             "viewport_height": 2, "focal_length": 1, "samples_per_pixel": 4},
  "rendering": {"width": 24, "render_depth": 8},
  "saving": {"path": "old.png", "gamma_correct": true},
  "spheres": [{"origin": [2, 0, 0], "radius": 0.5, "material": {"type": "diffuse", "color": [255, 255, 0]}}]
})";

/// rooms/ball.scene, which reads files in the folders beside it, and those read others.
class PackCommand : public ProgramTest {
 protected:
  PackCommand() {
    write("rooms/ball.scene",
          std::string("scene 1\n"
                      "import \"../library/colors.scene\" as colors\n"
                      "include \"parts/floor.scene\"\n"
                      "include \"old.json\"\n") +
              kCamera + "sphere { center: (0, 0, 0), radius: 1, material: colors.red }\n");
    write("rooms/parts/floor.scene",
          "scene 1\nimport \"../../data/heights.csv\" as heights\n"
          "for row in heights { sphere { center: (row.x, -2, 0), radius: row.y, material: "
          "diffuse(#2222CC) } }\n");
    write("rooms/old.json", kConfig);
    write("library/colors.scene", "scene 1\nlet red = diffuse(#CC2222)\n");
    write("data/heights.csv", "x,y\n-1,0.5\n1,0.75\n");
  }

  /// Packs rooms/ball.scene, and removes everything that is in the pack.
  void pack_and_remove() const {
    succeed("pack rooms/ball.scene");
    for (const char* name : {"rooms", "library", "data"}) fs::remove_all(folder_ / name);
  }
};

constexpr const char* kSmall = " --width 24 --samples 4 --quiet ";

TEST_F(PackCommand, GivesThePictureOfTheScene) {
  succeed(std::string("render rooms/ball.scene -o scene.png -o scene.exr") + kSmall);
  pack_and_remove();
  succeed(std::string("render ball.sdlc.zip -o pack.png -o pack.exr") + kSmall);
  EXPECT_TRUE(content("scene.png") == content("pack.png"));
  EXPECT_TRUE(content("scene.exr") == content("pack.exr"));
}

TEST_F(PackCommand, NamesThePictureAfterTheScene) {
  pack_and_remove();
  succeed(std::string("render ball.sdlc.zip") + kSmall);
  EXPECT_TRUE(exists("ball.png"));
  fs::rename(folder_ / "ball.sdlc.zip", folder_ / "other.zip");
  succeed(std::string("render other.zip -o {name}-2.png") + kSmall);
  EXPECT_TRUE(content("ball.png") == content("ball-2.png"));
}

TEST_F(PackCommand, GivesThePicturesOfExamples) {
  for (const char* name : {"elements", "pool", "newtons-cradle"}) {
    const std::string scene = std::string("'" SDLC_SOURCE_DIR "/examples/") + name + ".scene'";
    const std::string pack = std::string(name) + ".sdlc.zip";
    succeed("pack " + scene + " --quiet");
    const std::string frame = name == std::string("newtons-cradle") ? " --frames 3-4 " : " ";
    const std::string of_frame = frame == " " ? "" : ".####";
    succeed("render " + scene + " -o scene" + of_frame + ".png" + frame + kSmall);
    succeed("render " + pack + " -o pack" + of_frame + ".png" + frame + kSmall);
    if (frame == " ") {
      EXPECT_TRUE(content("scene.png") == content("pack.png")) << name;
      continue;
    }
    EXPECT_TRUE(content("scene.0003.png") == content("pack.0003.png")) << name;
    EXPECT_TRUE(content("scene.0004.png") == content("pack.0004.png")) << name;
    EXPECT_FALSE(content("scene.0003.png") == content("scene.0004.png")) << name;
  }
}

TEST_F(PackCommand, WritesTheSameBytesFromEverywhere) {
  succeed("pack rooms/ball.scene -o a.sdlc.zip");
  EXPECT_EQ(run_shell(folder_ / "rooms", "\"$SDLC\" pack ball.scene -o ../b.zip").exit_code, 0);
  succeed("pack \"$PWD/rooms/../rooms/ball.scene\" -o c.sdlc.zip");
  fs::create_directories(folder_ / "elsewhere");
  for (const char* name : {"rooms", "library", "data"}) {
    fs::copy(folder_ / name, folder_ / "elsewhere" / name, fs::copy_options::recursive);
  }
  fs::permissions(folder_ / "elsewhere/data/heights.csv", fs::perms::owner_all);
  succeed("pack elsewhere/rooms/ball.scene -o d.sdlc.zip");
  for (const char* name : {"b.zip", "c.sdlc.zip", "d.sdlc.zip"}) {
    EXPECT_TRUE(content("a.sdlc.zip") == content(name)) << name;
  }
  EXPECT_THAT(content("a.sdlc.zip"), Not(HasSubstr(folder_.path().filename().string())));
}

TEST_F(PackCommand, IsAnArchiveForOtherPrograms) {
  if (!has_program("unzip")) GTEST_SKIP() << "there is no unzip";
  succeed("pack rooms/ball.scene");
  const ProgramResult listed =
      run_shell(folder_.path(), "unzip -tq ball.sdlc.zip && unzip -Z1 ball.sdlc.zip");
  EXPECT_EQ(listed.exit_code, 0) << listed.out << listed.err;
  EXPECT_THAT(listed.out, HasSubstr("sdlc-pack.json\ndata/heights.csv\nlibrary/colors.scene\n"
                                    "rooms/ball.scene\nrooms/old.json\nrooms/parts/floor.scene\n"));
}

TEST_F(PackCommand, ReadsWhatAnotherProgramPacks) {
  if (!has_program("unzip") || !has_program("zip")) GTEST_SKIP() << "there is no unzip or zip";
  succeed("pack rooms/ball.scene");
  const ProgramResult again = run_shell(
      folder_.path(),
      "mkdir new && cd new && unzip -q ../ball.sdlc.zip && zip -qrD ../new.sdlc.zip . && cd .. && "
      "\"$SDLC\" lint new.sdlc.zip");
  EXPECT_EQ(again.exit_code, 0) << again.out << again.err;
}

TEST_F(PackCommand, ReportsFindingsInThePack) {
  write("rooms/ball.scene", kBall + "let unused = 1\n");
  succeed("pack rooms/ball.scene --quiet");
  const ProgramResult result = sdlc("lint ball.sdlc.zip --format concise");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("ball.sdlc.zip/ball.scene:4:5: "));
}

TEST_F(PackCommand, IsInspectedAndMeasured) {
  pack_and_remove();
  const ProgramResult report = sdlc("inspect ball.sdlc.zip --format json");
  EXPECT_EQ(report.exit_code, 0) << report.err;
  const auto json = nlohmann::json::parse(report.out);
  EXPECT_EQ(json["scene"], "ball.sdlc.zip/rooms/ball.scene");
  // Make needs the file on disk.
  EXPECT_EQ(sdlc("inspect ball.sdlc.zip --deps").out, "ball.sdlc.zip\n");
  EXPECT_EQ(sdlc("inspect ball.sdlc.zip --deps --target a.png").out,
            "a.png: \\\n  ball.sdlc.zip\n");
  succeed("measure ball.sdlc.zip --budget 1s --width 16 --quiet");
}

TEST_F(PackCommand, IsConvertedToAConfigBesideIt) {
  succeed("convert rooms/ball.scene --tone sqrt -o expected.json --quiet");
  pack_and_remove();
  fs::create_directories(folder_ / "packs");
  fs::rename(folder_ / "ball.sdlc.zip", folder_ / "packs/ball.sdlc.zip");
  succeed("convert packs/ball.sdlc.zip --tone sqrt --quiet");
  EXPECT_EQ(content("packs/ball.json"), content("expected.json"));
  EXPECT_NE(content("expected.json"), "");
}

TEST_F(PackCommand, TakesParams) {
  write("rooms/ball.scene",
        std::string("scene 1\nparam r = 1\n") + kCamera +
            "sphere { center: (0, 0, 0), radius: r, material: diffuse(#2222CC) }\n");
  succeed("pack rooms/ball.scene");
  succeed(std::string("render rooms/ball.scene --set r=2 -o a.png") + kSmall);
  succeed(std::string("render ball.sdlc.zip --set r=2 -o b.png") + kSmall);
  succeed(std::string("render ball.sdlc.zip -o c.png") + kSmall);
  EXPECT_TRUE(content("a.png") == content("b.png"));
  EXPECT_FALSE(content("a.png") == content("c.png"));
}

TEST_F(PackCommand, PacksConfigsAndStandardInput) {
  succeed("pack rooms/old.json -o old.sdlc.zip");
  succeed("lint old.sdlc.zip --ignore W,S");
  succeed("pack - --stdin-filename rooms/ball.scene -o stdin.zip < rooms/ball.scene");
  succeed("pack rooms/ball.scene");
  EXPECT_TRUE(content("stdin.zip") == content("ball.sdlc.zip"));
  EXPECT_THAT(failure(2, "pack - < rooms/ball.scene"), HasSubstr("--stdin-filename"));
}

TEST_F(PackCommand, PacksAFileThatIsReadThroughTheFolderAbove) {
  write("rooms/ball.scene", std::string("scene 1\ninclude \"../rooms/more.scene\"\n") + kCamera);
  write("rooms/more.scene",
        "scene 1\nsphere { center: (0, 0, 0), radius: 1, material: emissive(#FFFFFF, 2) }\n");
  pack_and_remove();
  succeed("lint ball.sdlc.zip");
}

TEST_F(PackCommand, PacksAFileUnderEachOfItsNames) {
  fs::create_symlink("colors.scene", folder_ / "library/same.scene");
  write("rooms/parts/floor.scene",
        "scene 1\nimport \"../../library/same.scene\" as c\n"
        "sphere { center: (0, -2, 0), radius: 1, material: c.red }\n");
  pack_and_remove();
  succeed("lint ball.sdlc.zip");
}

TEST_F(PackCommand, RefusesScenesWithErrors) {
  write("rooms/old.json", "{\"objects\": [");
  EXPECT_THAT(failure(1, "pack rooms/ball.scene"), HasSubstr("rooms/old.json:1:"));
  write("rooms/ball.scene", "scene 1\ninclude \"missing.scene\"\n");
  EXPECT_THAT(failure(1, "pack rooms/ball.scene"), HasSubstr("missing.scene"));
  EXPECT_FALSE(exists("ball.sdlc.zip"));
  EXPECT_THAT(failure(2, "pack none.scene"), HasSubstr("cannot read `none.scene`"));
}

TEST_F(PackCommand, RefusesAbsolutePathsWithTheirPlace) {
  write("rooms/ball.scene", "scene 1\n  import \"" + (folder_ / "library/colors.scene").string() +
                                "\" as c\n" + kCamera);
  EXPECT_THAT(failure(1, "pack rooms/ball.scene --quiet"),
              HasSubstr("rooms/ball.scene:2:10: the path `/"));
  EXPECT_FALSE(exists("ball.sdlc.zip"));
}

TEST_F(PackCommand, ProtectsFiles) {
  write("a.zip", kBall);
  EXPECT_THAT(failure(2, "pack a.zip -o a.zip"), HasSubstr("is an input file"));
  EXPECT_EQ(content("a.zip"), kBall);
  EXPECT_THAT(failure(2, "pack rooms/ball.scene -o rooms/old.json"), HasSubstr("name of a pack"));
  succeed("pack rooms/ball.scene -o b.zip");
  const std::string before = content("b.zip");
  write("rooms/old.json", std::string(kConfig) + "\n");
  EXPECT_THAT(failure(2, "pack rooms/ball.scene -o b.zip --no-clobber"), HasSubstr("exists"));
  EXPECT_EQ(content("b.zip"), before);
  succeed("pack rooms/ball.scene -o b.zip");
  EXPECT_NE(content("b.zip"), before);
  EXPECT_THAT(failure(2, "render b.zip -o b.zip/c.png"), HasSubstr("b.zip/c.png"));
}

TEST_F(PackCommand, KeepsThePackThatARenderReads) {
  pack_and_remove();
  fs::create_hard_link(folder_ / "ball.sdlc.zip", folder_ / "ball.png");
  EXPECT_THAT(failure(2, "render ball.sdlc.zip"), HasSubstr("is an input file"));
  fs::create_hard_link(folder_ / "ball.sdlc.zip", folder_ / "report.html");
  EXPECT_THAT(failure(2, "measure ball.sdlc.zip -o report.html"),
              HasSubstr("would be overwritten"));
}

TEST_F(PackCommand, ReadsNoFileOutsideOfThePack) {
  if (!has_program("zip")) GTEST_SKIP() << "there is no zip";
  write("secret.scene", "scene 1\nlet red = diffuse(#CC2222)\n");
  for (const std::string& path : {std::string("../secret.scene"), std::string("../../secret.scene"),
                                  (folder_ / "secret.scene").string()}) {
    write("new/sdlc-pack.json", R"({"format": 1, "scene": "a/b.scene"})");
    write("new/a/b.scene", "scene 1\nimport \"" + path + "\" as c\n" + kCamera);
    fs::remove(folder_ / "evil.sdlc.zip");
    const ProgramResult result = run_shell(folder_.path(),
                                           "cd new && zip -qrD ../evil.sdlc.zip . && cd .. && "
                                           "\"$SDLC\" render evil.sdlc.zip -o a.png");
    EXPECT_EQ(result.exit_code, 1) << path << result.err;
    EXPECT_THAT(result.err, HasSubstr("it is not in the pack")) << path;
    EXPECT_THAT(result.err, HasSubstr("evil.sdlc.zip/a/b.scene:2:8")) << path;
  }
}

TEST_F(PackCommand, RefusesDamagedPacks) {
  pack_and_remove();
  std::string bytes = content("ball.sdlc.zip");
  write("short.sdlc.zip", bytes.substr(0, bytes.size() / 2));
  write("text.sdlc.zip", std::string("scene 1\n") + kCamera);
  const std::size_t in_index = bytes.find("sdlc-pack.json") + 20;
  bytes[in_index] = static_cast<char>(bytes[in_index] ^ 1);
  write("damaged.zip", bytes);
  for (const char* command : {"render", "inspect", "lint", "measure"}) {
    const auto failing = [&](const char* name) {
      return failure(2, std::string(command) + " " + name);
    };
    EXPECT_THAT(failing("short.sdlc.zip"),
                HasSubstr("cannot read `short.sdlc.zip`: it is cut off"));
    EXPECT_THAT(failing("text.sdlc.zip"), HasSubstr("it is not a ZIP archive"));
    EXPECT_THAT(failing("damaged.zip"), HasSubstr("`sdlc-pack.json`: it is damaged"));
    EXPECT_THAT(failing("none.sdlc.zip"), HasSubstr("No such file"));
  }
  EXPECT_THAT(names_in(folder_.path()),
              ElementsAre("ball.sdlc.zip", "damaged.zip", "short.sdlc.zip", "text.sdlc.zip"));
}

TEST_F(PackCommand, CountsLimits) {
  pack_and_remove();
  EXPECT_THAT(failure(2, "lint ball.sdlc.zip --limit memory=100"), HasSubstr("--limit memory=N"));
  const std::string small = " --limit data=300 --limit file=300 --limit config=300";
  EXPECT_THAT(failure(2, "lint ball.sdlc.zip" + small), HasSubstr("--limit data=N"));
}

TEST_F(PackCommand, OtherCommandsSayWhatReadsPacks) {
  pack_and_remove();
  for (const char* arguments :
       {"fmt ball.sdlc.zip", "pack ball.sdlc.zip -o b.zip", "render - -o a.png < ball.sdlc.zip"}) {
    EXPECT_THAT(failure(2, arguments), HasSubstr("it is a ZIP archive")) << arguments;
  }
  EXPECT_THAT(failure(2, "lint --fix ball.sdlc.zip"), HasSubstr("it is a pack"));
}

TEST_F(PackCommand, KeepsPicturesOfASandboxBesideThePack) {
  write("rooms/ball.scene",
        std::string("scene 1\nrender { output: \"out.png\", width: 24, samples: 4 }\n") + kCamera +
            "include \"../data/c.scene\"\n");
  write("data/c.scene",
        "scene 1\nsphere { center: (0, 0, 0), radius: 1, material: emissive(#FFFFFF, 2) }\n");
  pack_and_remove();
  succeed("render ball.sdlc.zip --sandbox --quiet");
  EXPECT_TRUE(exists("out.png"));
  fs::create_directories(folder_ / "below");
  const ProgramResult outside =
      run_shell(folder_ / "below", "\"$SDLC\" render ../ball.sdlc.zip --sandbox");
  EXPECT_EQ(outside.exit_code, 0) << outside.err << "the folder of the pack has this folder";
  fs::rename(folder_ / "ball.sdlc.zip", folder_ / "below/ball.sdlc.zip");
  EXPECT_THAT(failure(2, "render below/ball.sdlc.zip --sandbox"), HasSubstr("--sandbox refuses"));
}

}  // namespace
}  // namespace sdlc::test
