#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kPlain = R"({"image": {"width": 4, "height": 3, "color": [128, 64, 255]},
 "saving": {"path": "plain.png", "gamma_correct": true}}
)";
constexpr const char* kPlainScene = R"(scene 1

background { color: linear255(128, 64, 255) }

render { width: 4, height: 3, output: "plain.png", tone: sqrt }
)";
/// With a key that has no effect.
constexpr const char* kConfig = R"({"camera": {"look_from": [0, 0, 0], "look_at": [0, 0, -1],
 "up": [0, 1, 0], "vfov": 90, "focal_length": 1, "aspect_ratio": 2, "viewport_height": 2,
 "samples_per_pixel": 4}, "rendering": {"width": 16, "render_depth": 4}, "saving": {"path": "c.ppm"},
 "spheres": [{"origin": [0, 0, -2], "radius": 1,
              "material": {"type": "diffuse", "color": [255, 0, 0]}}]}
)";
constexpr const char* kSrgb = R"(scene 1
camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }
render { width: 16, samples: 4 }
)";

class ConvertCommand : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write_text(folder_ / name, text);
  }
  std::string read(const std::string& name) const { return content_of(folder_ / name); }
  ProgramResult run(const std::string& arguments) const {
    return run_shell(folder_.path(), "\"$SDLC\" convert " + arguments);
  }

  TemporaryFolder folder_;
};

TEST_F(ConvertCommand, WritesBesideTheInput) {
  write("plain.json", kPlain);
  const ProgramResult result = run("plain.json");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "plain.json -> plain.scene\n");
  EXPECT_EQ(read("plain.scene"), kPlainScene);
  EXPECT_EQ(run("plain.json --overwrite --quiet").err, "");
}

TEST_F(ConvertCommand, ReplacesExistingFilesOnlyOnRequest) {
  write("plain.json", kPlain);
  write("plain.scene", "mine");
  const ProgramResult result = run("plain.json");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err,
            "error: `plain.scene` exists already; use --overwrite to replace it, or -o for another "
            "name\n");
  EXPECT_EQ(read("plain.scene"), "mine");
  EXPECT_EQ(run("plain.json --overwrite").exit_code, 0);
  EXPECT_EQ(read("plain.scene"), kPlainScene);
  write("plain.scene", "mine");
  EXPECT_EQ(run("plain.json -o plain.scene").exit_code, 0);
  EXPECT_EQ(read("plain.scene"), kPlainScene);
}

TEST_F(ConvertCommand, ReadsAndWritesStandardStreams) {
  write("plain.json", kPlain);
  EXPECT_EQ(run("plain.json -o -").out, kPlainScene);
  EXPECT_EQ(run("- <plain.json").out, kPlainScene);
  EXPECT_EQ(run("- --to scene -o x/y.scene <plain.json").exit_code, 0);
  EXPECT_EQ(read("x/y.scene"), kPlainScene);
  EXPECT_THAT(run("x/y.scene -o -").out, HasSubstr("\"color\": [128, 64, 255]"));
  EXPECT_EQ(names_in(folder_.path()), (std::vector<std::string>{"plain.json", "x"}));
}

TEST_F(ConvertCommand, GivesBackAPictureOfTheSameBytes) {
  write("config.json", kConfig);
  EXPECT_EQ(run("config.json").exit_code, 0);
  EXPECT_EQ(run("config.scene -o again.json").exit_code, 0);
  const ProgramResult result =
      run_shell(folder_.path(),
                "for f in config.json config.scene again.json; do \"$SDLC\" render $f -o $f.ppm "
                "--quiet; done;"
                "cmp config.json.ppm config.scene.ppm && cmp config.json.ppm again.json.ppm");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST_F(ConvertCommand, MirrorsTheTreeOfAFolder) {
  write("in/a.json", kPlain);
  write("in/deep/b.json", kConfig);
  write("in/deep/package.json", "{\"name\": \"no config\"}");
  const ProgramResult result = run("./in/ -o out --format concise");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(read("out/a.scene"), kPlainScene);
  EXPECT_THAT(read("out/deep/b.scene"), StartsWith("scene 1\n\ncamera main {"));
  EXPECT_THAT(names_in(folder_ / "out"), ElementsAre("a.scene", "deep"));
  EXPECT_THAT(names_in(folder_ / "out/deep"), ElementsAre("b.scene"));
}

TEST_F(ConvertCommand, ContinuesAfterAFileThatCannotBeConverted) {
  write("in/a.json", kPlain);
  write("in/broken.json", R"({"camera": {}, "rendering": {}, "saving": {}})");
  write("in/srgb.scene", kSrgb);
  const ProgramResult result = run("in -o out");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("error[E107]: the camera lacks `look_from`"));
  EXPECT_THAT(result.err, HasSubstr("error[E313]: `tone: srgb`"));
  EXPECT_THAT(result.err, HasSubstr("1 of 3 converted\n"));
  EXPECT_THAT(names_in(folder_ / "out"), ElementsAre("a.scene"));
}

TEST_F(ConvertCommand, LeavesNoFilesIfNothingIsConverted) {
  write("srgb.scene", kSrgb);
  EXPECT_EQ(run("srgb.scene -o deep/er/out.json").exit_code, 1);
  EXPECT_THAT(names_in(folder_.path()), ElementsAre("srgb.scene"));
  EXPECT_EQ(run("srgb.scene -o deep/er/out.json --tone sqrt").exit_code, 0);
  EXPECT_THAT(names_in(folder_ / "deep/er"), ElementsAre("out.json"));
}

TEST_F(ConvertCommand, TakesWarningsForErrorsIfItIsStrict) {
  std::string moving = kConfig;
  moving.replace(moving.find("\"material\""), 0, "\"movement\": [[1, 0, 0], 0, 1], ");
  write("config.json", moving);
  const ProgramResult result = run("config.json --strict --format concise");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "config.json:2:32: warning[W403]: `focal_length` has no effect\nconfig.json:5:16: "
            "warning[W403]: `movement` has no effect\nerror: config.json has warnings, which "
            "--strict treats as errors\n");
  EXPECT_THAT(names_in(folder_.path()), ElementsAre("config.json"));
}

TEST_F(ConvertCommand, IsNotStrictAboutAKeyThatConfigsMustHave) {
  write("config.json", kConfig);
  const ProgramResult result = run("config.json --strict --format concise");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(names_in(folder_.path()), ElementsAre("config.json", "config.scene"));
}

TEST_F(ConvertCommand, SetsParamsAndChoosesCameras) {
  write("two.scene", R"(scene 1
param high = 1
camera low { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }
camera up { from: (0, high, 5), at: (0, 0, 0), fov: 40deg }
render { width: 16, tone: sqrt }
)");
  EXPECT_THAT(run("two.scene -o - --camera up --set high=7").out,
              HasSubstr("\"look_from\": [0, 7, 5]"));
  EXPECT_THAT(run("two.scene -o - --camera down").err, HasSubstr("there is no camera `down`"));
}

TEST_F(ConvertCommand, RefusesWhatMakesNoSense) {
  write("a.json", kPlain);
  write("b/a.json", kPlain);
  EXPECT_THAT(run("a.json --to json").err,
              HasSubstr("`a.json` already has the format of --to json"));
  EXPECT_THAT(run("a.json -o b.json").err, HasSubstr("extension of the input format"));
  EXPECT_THAT(run("a.json b/a.json -o out").err, HasSubstr("`out/a.scene` would be written twice"));
  EXPECT_THAT(run("a.json b -o -").err, HasSubstr("several texts"));
  EXPECT_EQ(run("absent.json").exit_code, 2);
  EXPECT_THAT(run("a.json --to povray").err, HasSubstr("scene, json"));
}

}  // namespace
}  // namespace sdlc::test
