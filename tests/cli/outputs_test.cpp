#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/xattr.h>
#include <unistd.h>

#include "render/image/atomic_file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

int attribute_error = 0;     // error of setting an attribute; 0: it succeeds
int refused_attributes = 0;  // number of times it failed

}  // namespace

/// Replaces the C library's function, in this process only.
extern "C" int fsetxattr(int fd, const char* name, const void* value, std::size_t size,
                         int flags) noexcept {
  if (attribute_error == 0) {
    return static_cast<int>(::syscall(SYS_fsetxattr, fd, name, value, size, flags));
  }
  ++refused_attributes;
  errno = attribute_error;
  return -1;
}

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kScene = R"(scene 1
import "paint.scene" as paint
include "part.json"
camera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }
sphere ball { center: (0, 0, 0), radius: 1, material: diffuse(color: paint.shade) }
render { width: 8, samples: 1 }
)";
constexpr const char* kConfig = R"({"background": [0, 0, 0], "camera": {"look_from": [0, 0, 0],
"look_at": [0, 0, -1], "up": [0, 1, 0], "vfov": 90, "focal_length": 1, "aspect_ratio": 1.6,
"viewport_height": 2, "samples_per_pixel": 1}, "rendering": {"width": 8, "render_depth": 3},
"saving": {"path": "c.png", "gamma_correct": true}, "spheres": [{"origin": [0, 0, -3],
"radius": 1, "material": {"type": "no_texture", "color": [51, 102, 255]}}]})";

/// Input files are never overwritten, and nothing is written twice.
class Outputs : public testing::Test {
 protected:
  Outputs() {
    write_text(folder_ / "ball.scene", kScene);
    write_text(folder_ / "paint.scene", "scene 1\nlet shade = gray\n");
    write_text(folder_ / "part.json", kConfig);
    write_text(folder_ / "c.json", kConfig);
  }

  ProgramResult run(const std::string& arguments) {
    return run_shell(folder_.path(), "\"$SDLC\" " + arguments);
  }
  /// Checks that nothing changes.
  void expect_refused(const std::string& arguments, const std::string& words) {
    std::map<std::string, std::string> before, after;
    for (const std::string& name : names()) before[name] = content_of(folder_ / name);
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments << "\n" << result.err;
    EXPECT_THAT(result.err, HasSubstr(words)) << arguments;
    for (const std::string& name : names()) after[name] = content_of(folder_ / name);
    EXPECT_EQ(after, before) << arguments;
  }
  /// Only regular files.
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const std::string& name : names_in(folder_.path())) {
      if (fs::is_regular_file(folder_ / name)) names.push_back(name);
    }
    return names;
  }
  void link(const std::string& target, const std::string& name) {
    fs::create_symlink(target, folder_ / name);
  }

  const TemporaryFolder folder_;
  static constexpr const char* kRead = "is an input file and would be overwritten";
};

TEST_F(Outputs, OfARenderAreNotWhatItReads) {
  link("ball.scene", "link.png");
  link("paint.scene", "import.png");
  link("part.json", "include.png");
  link(".", "here");
  link("here/link.png", "chain.png");
  fs::create_hard_link(folder_ / "ball.scene", folder_ / "hard.png");
  link("part.json", "new.partial.png");
  for (const char* flags :
       {"--stats ball.scene", "--stats ./ball.scene", "--stats here/part.json",
        "--stats paint.scene", "-o link.png", "-o import.png", "-o include.png", "-o chain.png",
        "-o hard.png", "-o new.png", "-o fine.png -o here/include.png"}) {
    expect_refused(std::string("render ball.scene ") + flags, kRead);
  }
  expect_refused("render c.json --stats c.json", kRead);
  expect_refused("render - --stats ball.scene <ball.scene --stdin-filename x.scene", kRead);
  expect_refused("render c.json -o - >>c.json", kRead);
}

TEST_F(Outputs, OfLaterFramesAreNotWhatIsRead) {
  write_text(folder_ / "ball.scene", std::string(kScene) + "animation { frames: 1..3, fps: 24 }\n");
  link("paint.scene", "f0003.png");
  expect_refused("render ball.scene -o f####.png", kRead);
}

TEST_F(Outputs, OfAConversionAreNotWhatItReads) {
  link("ball.scene", "link.json");
  link("c.json", "link.scene");
  fs::create_hard_link(folder_ / "c.json", folder_ / "hard.scene");
  expect_refused("convert ball.scene --tone sqrt -o link.json", kRead);
  expect_refused("convert c.json -o link.scene", kRead);
  expect_refused("convert c.json -o hard.scene", kRead);
  expect_refused("convert - -o link.scene --stdin-filename x.json <c.json", kRead);
  expect_refused("convert c.json -o - >>c.json", kRead);
  write_text(folder_ / "ball.scene",
             "scene 1\ninclude \"part.json\"\n"
             "camera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
             "render { width: 8, samples: 1 }\n");
  expect_refused("convert ball.scene --tone sqrt -o part.json", kRead);
}

TEST_F(Outputs, OfAConversionOfAFolderAreNotItsScenes) {
  fs::create_directory(folder_ / "both");
  write_text(folder_ / "both/c.json", kConfig);
  ASSERT_EQ(run("convert both").exit_code, 0);
  const std::string scene = content_of(folder_ / "both/c.scene");
  EXPECT_EQ(run("convert both --overwrite").exit_code, 2);
  EXPECT_EQ(content_of(folder_ / "both/c.json"), kConfig);
  EXPECT_EQ(content_of(folder_ / "both/c.scene"), scene);
  // Files that are not converted may be replaced.
  EXPECT_EQ(run("convert both --overwrite --to scene").exit_code, 0);
}

TEST_F(Outputs, OfAComparisonAreNotItsPictures) {
  ASSERT_EQ(run("render c.json --quiet -o a.png -o b.png").exit_code, 0);
  link("a.png", "link.png");
  fs::create_hard_link(folder_ / "b.png", folder_ / "hard.png");
  for (const char* name : {"a.png", "./b.png", "link.png", "hard.png"}) {
    expect_refused(std::string("compare a.png b.png -o ") + name,
                   "it is one of the pictures to compare");
  }
}

TEST_F(Outputs, OfAMeasurementAreNotWhatItReads) {
  fs::create_hard_link(folder_ / "paint.scene", folder_ / "hard.csv");
  link("c.json", "link.json");
  const std::string measure = "measure --quiet --budget 1s ";
  expect_refused(measure + "ball.scene -o hard.csv", "is a part of the scene");
  expect_refused(measure + "c.json -o link.json", "is the scene that is measured");
  fs::create_directory(folder_ / "work");
  expect_refused(measure + "c.json --work work -o work/study.json", "kept by --work");
}

TEST_F(Outputs, GoToOnePlaceEach) {
  link("new.png", "missing.png");
  link("missing.png", "chain.png");
  fs::create_directory(folder_ / "sub");
  link("sub", "folder");
  write_text(folder_ / "one.png", "");
  fs::create_hard_link(folder_ / "one.png", folder_ / "two.png");
  for (const char* flags :
       {"-o new.png -o missing.png", "-o missing.png -o chain.png", "-o sub/a.png -o folder/a.png",
        "-o sub/../a.png -o a.png", "-o one.png -o two.png", "-o new.png --stats chain.png",
        "-o - --stats /dev/stdout"}) {
    expect_refused(std::string("render ball.scene ") + flags, "two outputs go to");
  }
  write_text(folder_ / "out.json", "");
  expect_refused("render ball.scene -o - --stats out.json >out.json", "two outputs go to");
  EXPECT_EQ(run("render ball.scene -o - --stats /dev/null >/dev/null").exit_code, 0);
}

TEST_F(Outputs, OfSeveralFramesGoToOnePlaceEach) {
  write_text(folder_ / "ball.scene",
             std::string(kScene) + "animation { frames: 0..10000, step: 10000 }\n");
  expect_refused("render ball.scene -o a####.png -o a1####.png", "two outputs go to `a10000.png`");
}

TEST_F(Outputs, OfAnInterruptionGoToOnePlaceEach) {
  link("a.partial.png", "link.json");
  for (const char* flags :
       {"-o a.png --stats a.partial.png", "-o a.png --stats ./a.partial.png",
        "-o a.png --stats link.json", "-o a.png -o a.partial.png", "-o a.partial.png -o a.png"}) {
    expect_refused(std::string("render ball.scene ") + flags, "two outputs go to");
  }
  // Names that are shortened to make room for `.partial`.
  const std::string longest(245, 'x');
  expect_refused("render ball.scene -o " + longest + "1.png -o " + longest + "2.png",
                 "two outputs go to");
  const ProgramResult fine = run("render ball.scene -o a.png -o a.ppm --stats a.partial.json");
  EXPECT_EQ(fine.exit_code, 0) << fine.err;
}

TEST_F(Outputs, OfAnInterruptionAreThoseOfOneFrame) {
  write_text(folder_ / "ball.scene", std::string(kScene) + "animation { frames: 1..2, fps: 24 }\n");
  expect_refused("render ball.scene -o f####.png --stats f0002.partial.png", "two outputs go to");
  // After shortening, all frames have the same name.
  const ProgramResult fine = run("render ball.scene -o " + std::string(245, 'x') + "####.png");
  EXPECT_EQ(fine.exit_code, 0) << fine.err;
}

TEST_F(Outputs, OutsideOfTheSandboxAreRefusedBeforeTheyAreLookedAt) {
  fs::create_directory(folder_ / "box");
  write_text(folder_ / "box/ball.scene",
             "scene 1\ncamera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
             "sphere { center: (0, 0, 0), radius: 1, material: unlit(red) }\n"
             "render { width: 8, samples: 1 }\n");
  // Detected as the scene itself.
  fs::create_hard_link(folder_ / "box/ball.scene", folder_ / "hard.png");
  for (const std::string name : {"box/ball.png", "box/ball.partial.png"}) {
    link("../hard.png", name);
    const ProgramResult result =
        run_shell(folder_ / "box", "\"$SDLC\" render --sandbox ball.scene");
    EXPECT_EQ(result.exit_code, 2) << name;
    EXPECT_THAT(result.err, HasSubstr("is outside the scene's folder")) << name;
    fs::remove(folder_ / name);
  }
}

TEST_F(Outputs, AreWrittenWhereAttributesCannotBeSet) {
  const fs::path file = folder_ / "a.txt";
  write_text(file, "old");
  if (::setxattr(file.c_str(), "user.note", "mine", 4, 0) != 0) {
    GTEST_SKIP() << "this file system has no extended attributes";
  }
  for (const int error : {EINVAL, ENOSPC, E2BIG, ERANGE, ENOTSUP, EPERM, EACCES, EDQUOT, EIO}) {
    write_text(file, "old");
    ::setxattr(file.c_str(), "user.note", "mine", 4, 0);
    refused_attributes = 0;
    attribute_error = error;
    const std::string bytes = "new";
    EXPECT_NO_THROW(render::write_file_atomically(file, std::as_bytes(std::span(bytes)))) << error;
    attribute_error = 0;
    EXPECT_GT(refused_attributes, 0);
    EXPECT_EQ(content_of(file), "new") << error;
  }
}

TEST_F(Outputs, AreAllTriedWhenOneFails) {
  link("/dev/full", "full.png");
  const ProgramResult result = run("render ball.scene -o full.png -o ok.png --stats s.json");
  EXPECT_EQ(result.exit_code, 75) << "the disk was full: later there may be room";
  EXPECT_THAT(result.err, HasSubstr("cannot write `full.png`: "));
  EXPECT_THAT(result.err, HasSubstr("ok.png: 8 x "));
  EXPECT_TRUE(fs::exists(folder_ / "ok.png"));
  EXPECT_TRUE(fs::exists(folder_ / "s.json"));
  const ProgramResult both = run("render ball.scene -o - -o full.png -o ok.png >&-");
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.err, HasSubstr("cannot write `standard output`"));
  EXPECT_THAT(both.err, HasSubstr("cannot write `full.png`"));
}

TEST_F(Outputs, OfAMeasurementAreAllTriedWhenOneFails) {
  link("/dev/full", "full.json");
  const ProgramResult result = run("measure c.json --quiet --budget 1s -o full.json -o ok.csv");
  EXPECT_EQ(result.exit_code, 75) << result.err;
  EXPECT_TRUE(fs::exists(folder_ / "ok.csv"));
}

TEST_F(Outputs, DoNotTakeTheNumbersOfClosedStreams) {
  for (const char* closed : {"0<&- 2>&-", "1>&- 2>&-", "2>&-", "0<&- 1>&- 2>&-"}) {
    const ProgramResult result =
        run(std::string("measure c.json --budget 1s --work wk -o a.json ") + closed);
    EXPECT_EQ(content_of(folder_ / "wk/lock"), "") << closed;
    fs::remove_all(folder_ / "wk");
  }
  EXPECT_EQ(run("render c.json -o a.png 0<&- 1>&- 2>&-").exit_code, 0);
  EXPECT_EQ(run("render - -o a.png 0<&-").exit_code, 2) << "standard input cannot be read";
}

TEST_F(Outputs, OpenThePictureModuleOnlyForPictures) {
  write_text(folder_ / "bad.scene", "scene 1\nsphere { }\n");
  const std::string nowhere = "SDLC_MODULE_PATH=/nowhere \"$SDLC\" ";
  EXPECT_EQ(run_shell(folder_.path(), nowhere + "--help").exit_code, 0);
  EXPECT_EQ(run_shell(folder_.path(), nowhere + "render bad.scene").exit_code, 1);
  EXPECT_EQ(run_shell(folder_.path(), nowhere + "render ball.scene").exit_code, 2);
}

TEST_F(Outputs, ThatNoModuleWritesAreRefusedBeforeTheSceneIsRead) {
  const std::string nowhere = "SDLC_MODULE_PATH=/nowhere \"$SDLC\" ";
  for (const char* command :
       {"render absent.scene -o a.exr", "render absent.scene -o a.exr --watch",
        "merge absent.film -o a.exr"}) {
    const ProgramResult result = run_shell(folder_.path(), nowhere + command);
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_THAT(result.err, StartsWith("error: cannot write `a.exr`: cannot load")) << command;
  }
  const std::string farm = nowhere + "farm ball.scene --tasks 2 --aov depth -o job --engine ";
  EXPECT_THAT(run_shell(folder_.path(), farm + "shell").err, HasSubstr(".exr`: cannot load"));
  EXPECT_EQ(run_shell(folder_.path(), farm + "kubernetes").exit_code,
            0);  // its container has a program of its own
}

}  // namespace
}  // namespace sdlc::test
