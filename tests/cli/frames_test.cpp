#include "cli/frames.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/usage_error.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::vector<int> frames(const std::string& text) {
  const auto ranges = cli::parse_frames(text);
  return ranges ? cli::frames_of(*ranges) : std::vector<int>();
}

TEST(Frames, AreOneARangeOrEverySoManyOfIt) {
  EXPECT_THAT(frames("7"), ElementsAre(7));
  EXPECT_THAT(frames("0"), ElementsAre(0));
  EXPECT_THAT(frames("1-4"), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(frames("5-5"), ElementsAre(5));
  EXPECT_THAT(frames("1-8x3"), ElementsAre(1, 4, 7));
  EXPECT_THAT(frames("2-8x3"), ElementsAre(2, 5, 8));
  EXPECT_THAT(frames("1-3x100"), ElementsAre(1));
  EXPECT_THAT(frames("007-08"), ElementsAre(7, 8));
  EXPECT_THAT(frames("2147483646-2147483647"), ElementsAre(2147483646, 2147483647));
  EXPECT_THAT(frames("0-2147483647x2147483647"), ElementsAre(0, 2147483647));
}

TEST(Frames, AreAListOfRanges) {
  EXPECT_THAT(frames("1-3,5,7-20x6,100"), ElementsAre(1, 2, 3, 5, 7, 13, 19, 100));
  EXPECT_THAT(frames("5,1-3,2-4"), ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(frames("1-8:3"), ElementsAre(1, 4, 7));
  for (const char* text : {"1,", ",1", "1,,2", ",", "1;2", "1, 2", "1-3,x"}) {
    EXPECT_FALSE(cli::parse_frames(text)) << "`" << text << "`";
  }
}

TEST(Frames, AreNotMoreThanAMillion) {
  EXPECT_EQ(frames("1-1000000").size(), 1'000'000u);
  EXPECT_THROW(frames("0-1000000"), cli::UsageError);
  EXPECT_THROW(frames("0-2147483647,0-2147483647"), cli::UsageError);
}

TEST(Frames, AreDescribedAsTheyAreWritten) {
  for (const char* text : {"7", "1-2", "1-3,5,7-8,100", "0,2,4"}) {
    EXPECT_EQ(cli::describe_frames(frames(text)), text);
  }
  EXPECT_EQ(cli::describe_frames({}), "");
}

TEST(Frames, AreNothingElse) {
  for (const char* text :
       {"",      " ",      "a",       "1-",    "-1",   "1-2-3", "4-1",        "1-4x",
        "1-4x0", "1-4x-1", "1-4x2x2", "1 - 4", "1..4", "1:2",   "1.5",        "1-4.5",
        " 1",    "1 ",     "+1",      "1-+4",  "0x10", "7x2",   "2147483648", "1-99999999999",
        "x2"}) {
    EXPECT_FALSE(cli::parse_frames(text)) << "`" << text << "`";
  }
}

TEST(Frames, TakeThePlaceOfTheMarksInAName) {
  EXPECT_EQ(cli::name_of_frame("a.####.png", 7), "a.0007.png");
  EXPECT_EQ(cli::name_of_frame("####/a####.png", 12345), "12345/a12345.png");
  EXPECT_EQ(cli::name_of_frame("a.###.png", 7), "a.###.png");
  EXPECT_EQ(cli::name_of_frame("a.#####.png", 7), "a.0007#.png");
  EXPECT_TRUE(cli::has_frame_mark("a.####.png"));
  EXPECT_FALSE(cli::has_frame_mark("a.###.png"));
}

constexpr const char* kFilm = R"(scene 1
camera main { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg }
animation { frames: 1 .. 5, fps: 2, step: 2 }
for i in range(round(time * 2 / 1s)) { sphere { center: (i, 0, 0), radius: 0.4, material: unlit(red) } }
render { width: 16, samples: 1 }
)";

class FramesFlag : public testing::Test {
 protected:
  FramesFlag() { write_text(folder_ / "film.scene", kFilm); }

  ProgramResult render(const std::string& arguments) {
    return run_shell(folder_.path(), "\"$SDLC\" render --quiet --color never " + arguments);
  }
  std::vector<std::string> names() const { return names_in(folder_.path()); }

  TemporaryFolder folder_;
};

TEST_F(FramesFlag, DefaultsToTheFramesOfTheAnimation) {
  const ProgramResult result = render("film.scene");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(names(),
              ElementsAre("film.0001.png", "film.0003.png", "film.0005.png", "film.scene"));
}

TEST_F(FramesFlag, ChoosesFrames) {
  EXPECT_EQ(render("film.scene --frames 4").exit_code, 0);
  EXPECT_THAT(names(), ElementsAre("film.0004.png", "film.scene"));
  EXPECT_EQ(render("film.scene --frames 2-3 -o b-####.ppm").exit_code, 0);
  EXPECT_EQ(render("film.scene --frames 10-14x4 -o c####.png").exit_code, 0);
  EXPECT_THAT(names(), ElementsAre("b-0002.ppm", "b-0003.ppm", "c0010.png", "c0014.png",
                                   "film.0004.png", "film.scene"));
}

TEST_F(FramesFlag, RefusesWhatIsNoRange) {
  for (const char* text : {"''", "a", "1-", "4-1", "1-4x0", "1..4", "-1", "1,"}) {
    const ProgramResult result = render("film.scene --frames " + std::string(text));
    EXPECT_EQ(result.exit_code, 2) << text;
    EXPECT_THAT(result.err, HasSubstr("--frames")) << text;
  }
  EXPECT_THAT(names(), ElementsAre("film.scene"));
}

TEST_F(FramesFlag, WritesOneLineOfStatisticsAFrame) {
  for (const std::string target : {"stats.jsonl", "-"}) {
    const ProgramResult result = render("film.scene --frames 1-3 --stats " + target);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    std::istringstream lines(target == "-" ? result.out : content_of(folder_ / target));
    std::vector<int> spheres;
    for (std::string line; std::getline(lines, line);) {
      spheres.push_back(nlohmann::json::parse(line)["spheres"].get<int>());
    }
    EXPECT_THAT(spheres, ElementsAre(1, 2, 3)) << target;
  }
}

TEST_F(FramesFlag, GivesEachFrameItsOwnTimes) {
  ASSERT_EQ(render("film.scene --frames 1-20 -o a####.ppm --stats s.jsonl").exit_code, 0);
  std::istringstream lines(content_of(folder_ / "s.jsonl"));
  std::vector<double> seconds;
  for (std::string line; std::getline(lines, line);) {
    seconds.push_back(nlohmann::json::parse(line)["parse_seconds"].get<double>());
  }
  ASSERT_EQ(seconds.size(), 20U);
  EXPECT_FALSE(std::ranges::is_sorted(seconds)) << "the times of all frames until then";
}

TEST_F(FramesFlag, RequiresAPlaceholderInTheNamesOfSeveralFrames) {
  for (const std::string outputs : {"-o a.png", "-o -", "-o a.####.png -o b.png", "-o a.###.png"}) {
    const ProgramResult result = render("film.scene " + outputs);
    EXPECT_EQ(result.exit_code, 2) << outputs;
    EXPECT_THAT(result.err, HasSubstr("put #### in its name")) << outputs;
  }
  EXPECT_THAT(names(), ElementsAre("film.scene"));
  EXPECT_EQ(render("film.scene --frames 3 -o a.png").exit_code, 0);
  EXPECT_EQ(render("film.scene --frames 3 -o -").exit_code, 0);
  EXPECT_THAT(names(), ElementsAre("a.png", "film.scene"));
}

TEST_F(FramesFlag, RequiresAPlaceholderInTheOutputOfAnAnimatedScene) {
  const auto film_to = [&](const std::string& output) {
    std::string film = kFilm;
    film.replace(film.find("width"), 0, "output: \"" + output + "\", ");
    write_text(folder_ / "film.scene", film);
    return render("film.scene --frames 3-4");
  };
  const ProgramResult bad = film_to("out.png");
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.err, HasSubstr("error[E237]: the output `out.png` has no `####`"));
  EXPECT_THAT(names(), ElementsAre("film.scene"));
  EXPECT_EQ(render("film.scene --frames 3-4 -o mine.####.png").exit_code, 0)
      << "the scene's own output is not used";
  EXPECT_EQ(film_to("out/f####.png").exit_code, 0);
  EXPECT_THAT(names(), ElementsAre("film.scene", "mine.0003.png", "mine.0004.png", "out"));
  EXPECT_THAT(names_in(folder_ / "out"), ElementsAre("f0003.png", "f0004.png"));
}

TEST_F(FramesFlag, RefusesASceneThatHasNoFrames) {
  write_text(folder_ / "still.scene",
             "scene 1\ncamera main { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg }\n");
  const ProgramResult result = render("still.scene --frames 1-4 --width 8 --samples 1");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("the scene has no `animation`"));
  EXPECT_EQ(render("still.scene --width 8 --samples 1 -o a.####.png").exit_code, 0);
  EXPECT_THAT(names(), ElementsAre("a.####.png", "film.scene", "still.scene"))
      << "without frames the marks are a name like any other";
}

TEST_F(FramesFlag, ReportsTheMistakesOfASceneOnceAndStops) {
  std::string film = kFilm;
  film +=
      "assert time < 2s, \"too late\"\nsphere { center: (0, 5, 0), radius: 0, material: unlit(red) "
      "}\n";
  write_text(folder_ / "film.scene", film);
  const ProgramResult result = render("film.scene --format concise");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("error[E231]: too late"));
  const std::size_t first = result.err.find("W402");
  EXPECT_NE(first, std::string::npos);
  EXPECT_EQ(result.err.find("W402", first + 1), std::string::npos) << result.err;
  // The valid frames were rendered.
  EXPECT_THAT(names(), ElementsAre("film.0001.png", "film.0003.png", "film.scene"));
}

// Two specks shrink in turn, so each frame reports a different number.
TEST_F(FramesFlag, WarnsOfThePrecisionOnceForEachSphere) {
  write_text(folder_ / "film.scene", R"(scene 1
camera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }
animation { frames: 1 .. 8, fps: 1 }
sphere first { center: (0, 0, 0), radius: if time < 2.5s then 0.1 else 1e-6 / (time / 1s), material: unlit(red) }
sphere second { center: (1, 0, 0), radius: if time < 5.5s then 0.1 else 1e-8 / (time / 1s), material: unlit(red) }
render { width: 8, samples: 1, precision: float }
)");
  const std::string err = render("film.scene --format concise").err;
  std::vector<std::string> warnings;
  std::istringstream lines(err);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("W501") != std::string::npos) warnings.push_back(line);
  }
  ASSERT_EQ(warnings.size(), 2u) << err;
  EXPECT_THAT(warnings[0], HasSubstr("a hit is off by 23.2 of the smallest radius"));
  EXPECT_THAT(warnings[1], HasSubstr("a hit is off by 4.56e+03 of the smallest radius"));
}

TEST_F(FramesFlag, GivesEachFrameThePictureOfItsTime) {
  ASSERT_EQ(render("film.scene --frames 1-3x2").exit_code, 0);
  EXPECT_NE(content_of(folder_ / "film.0001.png"), content_of(folder_ / "film.0003.png"));
  ASSERT_EQ(render("film.scene --frames 3 -o again.png").exit_code, 0);
  EXPECT_EQ(content_of(folder_ / "again.png"), content_of(folder_ / "film.0003.png"))
      << "whatever frames were rendered before it";
}

TEST_F(FramesFlag, ProtectsEveryFrameWithNoClobber) {
  write_text(folder_ / "film.0003.png", "mine");
  const ProgramResult result = render("film.scene --no-clobber");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("film.0003.png"));
  EXPECT_EQ(content_of(folder_ / "film.0003.png"), "mine");
  EXPECT_THAT(names(), ElementsAre("film.0003.png", "film.scene")) << "known before the first";
}

TEST_F(FramesFlag, WarnsOfFramesOutsideOfTheAnimation) {
  EXPECT_EQ(render("film.scene --frames 1-5").err, "");
  EXPECT_EQ(render("film.scene --frames 0-7x7,2").err,
            "warning: --frames: 0,7 are outside of the animation, 1 to 5\n");
}

TEST_F(FramesFlag, SkipsPicturesThatAreThere) {
  write_text(folder_ / "film.0003.png", "mine");
  const ProgramResult result =
      run_shell(folder_.path(), "\"$SDLC\" render film.scene --skip-existing --color never");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("1 of 3 frames were there already\n"));
  EXPECT_EQ(content_of(folder_ / "film.0003.png"), "mine");
  EXPECT_THAT(names(),
              ElementsAre("film.0001.png", "film.0003.png", "film.0005.png", "film.scene"));
  write_text(folder_ / "film.0005.png", "");
  EXPECT_EQ(render("film.scene --skip-existing").exit_code, 0);
  EXPECT_NE(content_of(folder_ / "film.0005.png"), "") << "an empty file is no picture";
  EXPECT_EQ(render("film.scene --skip-existing -o film.####.png -o film.####.exr").exit_code, 0);
  EXPECT_NE(content_of(folder_ / "film.0003.png"), "mine") << "the other picture was not there";
  EXPECT_EQ(render("film.scene --skip-existing --no-clobber").exit_code, 2);
}

TEST_F(FramesFlag, GoesOnAfterAFrameThatFails) {
  std::string film = kFilm;
  film += "assert time != 1.5s, \"not now\"\n";
  write_text(folder_ / "film.scene", film);
  const ProgramResult result = render("film.scene");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("error[E231]: not now"));
  EXPECT_THAT(result.err, HasSubstr("error: 1 of 3 frames failed: 3\n"));
  EXPECT_THAT(names(), ElementsAre("film.0001.png", "film.0005.png", "film.scene"));
  std::filesystem::remove(folder_ / "film.0001.png");
  std::filesystem::remove(folder_ / "film.0005.png");
  EXPECT_EQ(render("film.scene --fail-fast").exit_code, 1);
  EXPECT_THAT(names(), ElementsAre("film.0001.png", "film.scene"));
}

TEST_F(FramesFlag, ReportsTheSameErrorOfSeveralFramesOnce) {
  std::string film = kFilm;
  film += "sphere { center: (0, 5, 0), radius: 1 }\n";
  write_text(folder_ / "film.scene", film);
  const ProgramResult result = render("film.scene --format concise");
  EXPECT_EQ(result.exit_code, 1);
  const std::size_t first = result.err.find("E235");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(result.err.find("E235", first + 1), std::string::npos) << result.err;
  EXPECT_THAT(result.err, HasSubstr("error: 3 of 3 frames failed: 1,3,5\n"));
}

class SeveralScenes : public FramesFlag {
 protected:
  SeveralScenes() {
    for (const char* name : {"a.scene", "b.scene"}) {
      write_text(folder_ / name,
                 "scene 1\ncamera main { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg }\n"
                 "render { width: 8, samples: 1 }\n");
    }
    std::filesystem::remove(folder_ / "film.scene");
  }
};

TEST_F(SeveralScenes, AreRenderedOneAfterTheOther) {
  const ProgramResult result = render("a.scene b.scene --stats -");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(names(), ElementsAre("a.png", "a.scene", "b.png", "b.scene"));
  EXPECT_EQ(std::ranges::count(result.out, '\n'), 2) << result.out;
  EXPECT_EQ(render("a.scene b.scene -o 'out-{name}.ppm' --stats s.jsonl").exit_code, 0);
  EXPECT_THAT(names(), ElementsAre("a.png", "a.scene", "b.png", "b.scene", "out-a.ppm", "out-b.ppm",
                                   "s.jsonl"));
}

TEST_F(SeveralScenes, DoNotStopEachOther) {
  write_text(folder_ / "bad.scene", "scene 1\nsphere {");
  const ProgramResult result = render("missing.scene bad.scene a.scene");
  EXPECT_EQ(result.exit_code, 2) << "a file cannot be read";
  EXPECT_THAT(result.err, HasSubstr("error: 2 of 3 scenes failed: missing.scene, bad.scene\n"));
  EXPECT_THAT(names(), ElementsAre("a.png", "a.scene", "b.scene", "bad.scene"));
  std::filesystem::remove(folder_ / "a.png");
  EXPECT_EQ(render("bad.scene a.scene --fail-fast").exit_code, 1);
  EXPECT_THAT(names(), ElementsAre("a.scene", "b.scene", "bad.scene"));
}

TEST_F(SeveralScenes, NeverShareAPicture) {
  EXPECT_THAT(render("a.scene b.scene -o x.png").err, HasSubstr("put {name} in its name"));
  EXPECT_THAT(names(), ElementsAre("a.scene", "b.scene"));
  std::filesystem::create_directory(folder_ / "more");
  std::filesystem::copy(folder_ / "a.scene", folder_ / "more/a.scene");
  const ProgramResult result = render("a.scene more/a.scene");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("two outputs go to `a.png`"));
  EXPECT_EQ(render("a.scene b.scene -o '{name}.scene.png' -o b.scene").exit_code, 2);
  EXPECT_THAT(content_of(folder_ / "b.scene"), HasSubstr("scene 1"));
}

}  // namespace
}  // namespace sdlc::test
