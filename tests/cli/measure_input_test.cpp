#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kScene = R"(scene 1
import "paint.scene" as paint
camera main { from: (0, 1, 5), at: (0, 0.5, 0), fov: 30deg }
background { bottom: white, top: #80b3ff }
sphere ball { center: (0, 0.5, 0), radius: 0.5, material: diffuse(color: paint.shade) }
render { width: 6, samples: 8, depth: 4 }
)";

/// An input file must not be overwritten, whatever its name.
class MeasureInput : public testing::Test {
 protected:
  void SetUp() override {
    write_text(folder_ / "ball.scene", kScene);
    write_text(folder_ / "paint.scene", "scene 1\nlet shade = gray\n");
  }

  ProgramResult measure(const std::string& arguments) const {
    return run_shell(folder_.path(), "\"$SDLC\" measure --budget 20s --quiet " + arguments);
  }
  void expect_refused(const std::string& arguments, const std::string& words) const {
    const ProgramResult result = measure(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments << ": " << result.err;
    EXPECT_THAT(result.err, HasSubstr(words)) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
  }

  const TemporaryFolder folder_;
};

TEST_F(MeasureInput, IsNotOverwrittenByAReport) {
  // A JSON scene has the file extension of a report.
  const std::string before = "{}";
  write_text(folder_ / "ball.json", before);
  fs::create_symlink("ball.json", folder_ / "link.json");
  for (const char* name : {"ball.json", "./ball.json", "link.json"}) {
    expect_refused(std::string("ball.json -o ") + name, "is the scene that is measured");
  }
  EXPECT_EQ(content_of(folder_ / "ball.json"), before);
}

TEST_F(MeasureInput, OfASceneIncludesWhatItReads) {
  write_text(folder_ / "paint.json", "scene 1\nlet shade = gray\n");
  std::string scene = kScene;
  scene.replace(scene.find("paint.scene"), std::string("paint.scene").size(), "paint.json");
  write_text(folder_ / "ball.scene", scene);
  const std::string before = content_of(folder_ / "paint.json");
  expect_refused("ball.scene -o ./paint.json", "is a part of the scene");
  EXPECT_EQ(content_of(folder_ / "paint.json"), before);
}

TEST_F(MeasureInput, IsTheReportOfAgainstToo) {
  ASSERT_EQ(measure("ball.scene -o r.json").exit_code, 0);
  const std::string before = content_of(folder_ / "r.json");
  expect_refused("ball.scene --against r.json -o ./r.json", "is the report of --against");
  fs::copy_file(folder_ / "r.json", folder_ / "a.partial.json");
  expect_refused("ball.scene --against a.partial.json -o a.json",
                 "is the report of --against, and would be overwritten by a partial report");
  EXPECT_EQ(content_of(folder_ / "r.json"), before);
}

TEST_F(MeasureInput, IsTheStudyOfAFolderToo) {
  ASSERT_EQ(measure("ball.scene --work kept").exit_code, 0);
  const std::string before = content_of(folder_ / "kept" / "study.json");
  expect_refused("ball.scene --work kept -o kept/../kept/study.json", "is kept by --work");
  EXPECT_EQ(content_of(folder_ / "kept" / "study.json"), before);
}

TEST_F(MeasureInput, NamesEachOutputOnce) {
  expect_refused("ball.scene -o x.json -o ./x.json", "two outputs go to `./x.json`");
  write_text(folder_ / "x.json", "");
  fs::create_symlink("x.json", folder_ / "y.json");
  expect_refused("ball.scene -o x.json -o y.json", "two outputs go to `y.json`");
  expect_refused("ball.scene -o -", "-o -: --format selects the report on standard output");
}

TEST_F(MeasureInput, OfAnEarlierReportIsRejectedWithTheInvalidField) {
  ASSERT_EQ(measure("ball.scene -o old.json").exit_code, 0);
  const json old = json::parse(content_of(folder_ / "old.json"));
  const auto expect_told = [&](const char* pointer, const json& value, const std::string& words) {
    json changed = old;
    changed[json::json_pointer(pointer)] = value;
    write_text(folder_ / "changed.json", changed.dump());
    const ProgramResult result = measure("ball.scene --against changed.json");
    EXPECT_EQ(result.exit_code, 2) << pointer;
    EXPECT_THAT(result.err, HasSubstr("cannot use `changed.json`: " + words));
    EXPECT_THAT(result.err, Not(HasSubstr("json.exception")));
  };
  expect_told("/version", 3, "its `version` is no text");
  expect_told("/format", 3, "it is not a JSON report of `sdlc measure`");
  expect_told("/width", 1e300, "its `width` is not a whole number from 1 to");
  expect_told("/height", 0, "its `height` is not a whole number from 1 to");
  expect_told("/seed", -1, "its `seed` is not a whole number from 0 on");
  expect_told("/threads", 1.5, "its `threads` is not a whole number from 1 to");
  expect_told("/is_complete", "yes", "its `is_complete` is neither true nor false");
  expect_told("/machine", json::array(), "its `machine` is not an object");
  expect_told("/machine/processor", 7, "its `processor` is no text");
  expect_told("/points", 7, "its `points` is not a list");
  expect_told("/points/1", 7, "`points`, number 2: ");
  expect_told("/points/0/samples", 1e300,
              "`points`, number 1: its `samples` is not a whole number");
  expect_told("/points/0/seconds", 0, "`points`, number 1: it took no time");
  expect_told("/points/0/timings/0", -1, "`points`, number 1: it took no time");
  expect_told("/points/0/seconds_interval", 1,
              "`points`, number 1: its `seconds_interval` is not a list of two");
  expect_told("/points/0/relative_error", -1,
              "`points`, number 1: its `relative_error` is invalid");
  expect_told("/points/0/sampler", "magic",
              "`points`, number 1: its `sampler` is `magic`, which is unknown");
  json lacking = old;
  lacking.erase("points");
  write_text(folder_ / "lacking.json", lacking.dump());
  EXPECT_THAT(measure("ball.scene --against lacking.json").err,
              HasSubstr("its `points` is missing"));
  write_text(folder_ / "text.json", "{\"format\": }");
  EXPECT_THAT(measure("ball.scene --against text.json").err, HasSubstr("it is not valid JSON"));
}

}  // namespace
}  // namespace sdlc::test
