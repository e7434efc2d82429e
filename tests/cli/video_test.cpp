#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/video_writer.hpp"
#include "render/image/image.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A frame is of one colour: greys, then the corners of the cube.
constexpr const char* kColors = R"(scene 1
camera main { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg }
animation { frames: 0 .. 13, fps: 2 }
let i = round(time * 2 / 1s)
let c = i - 6
let corner = linear(mod(c, 2), mod(floor(c / 2), 2), floor(c / 4))
background { color: if i < 6 then rgb(i * 51, i * 51, i * 51) else corner }
render { width: 33, height: 17, samples: 1 }
)";

class Videos : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_program("ffmpeg")) GTEST_SKIP() << "needs ffmpeg";
    write_text(folder_ / "film.scene", kColors);
  }

  ProgramResult run(const std::string& command) { return run_shell(folder_.path(), command); }
  std::vector<std::string> names() const { return names_in(folder_.path()); }

  /// The largest difference of codes between the frames and those of a video.
  double difference(const std::string& video) {
    EXPECT_EQ(run("ffmpeg -loglevel error -i " + video +
                  " -sws_flags accurate_rnd+full_chroma_int+full_chroma_inp -pix_fmt rgb24"
                  " -start_number 0 back.%04d.ppm")
                  .exit_code,
              0);
    double largest = 0;
    for (int i = 0; i <= 13; ++i) {
      const std::string number = (i < 10 ? "000" : "00") + std::to_string(i);
      const render::Picture frame = render::read_picture(folder_ / ("f." + number + ".ppm"));
      const render::Picture back = render::read_picture(folder_ / ("back." + number + ".ppm"));
      for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x) {
          const render::LinearRgb apart = frame.at(x, y) - back.at(x, y);
          largest = std::max({largest, std::abs(apart.r), std::abs(apart.g), std::abs(apart.b)});
        }
      }
    }
    return 255 * largest;
  }

  TemporaryFolder folder_;
};

TEST_F(Videos, HaveTheColorsOfTheFrames) {
  const ProgramResult result = run(
      "\"$SDLC\" render film.scene -o f.####.ppm -o a.apng -o a.mp4 -o a.mkv -o a.webm -o a.webp");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("a.mp4: 14 frames, 2 per second\n"));
  EXPECT_EQ(difference("a.apng"), 0);
  for (const char* video : {"a.mp4", "a.mkv", "a.webm"}) EXPECT_LE(difference(video), 2) << video;
}

TEST_F(Videos, AppearAsAWholeOrNotAtAll) {
  write_text(folder_ / "film.scene", std::string(kColors) + "assert time != 2s, \"not now\"\n");
  const ProgramResult result = run("\"$SDLC\" render film.scene -o a.mp4");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              HasSubstr("error: `a.mp4` was not written, because it has 13 of 14 frames\n"));
  EXPECT_THAT(names(), ElementsAre("film.scene"));
}

TEST_F(Videos, AreRefusedWhereTheyCannotBe) {
  const auto error_of = [&](const std::string& arguments) {
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    return result.err;
  };
  EXPECT_THAT(error_of("PATH=/nowhere \"$SDLC\" render film.scene -o a.mp4"),
              HasSubstr("needs ffmpeg, which is not installed"));
  EXPECT_THAT(error_of("\"$SDLC\" render film.scene -o a.mp4 -o ./a.mp4"),
              HasSubstr("two outputs go to"));
  EXPECT_THAT(error_of("\"$SDLC\" render film.scene -o no/a.mp4"),
              HasSubstr("the folder `no` does not exist"));
  write_text(folder_ / "a.mp4", "mine");
  EXPECT_THAT(error_of("\"$SDLC\" render film.scene -o a.mp4 --no-clobber"),
              HasSubstr("the file exists"));
  EXPECT_EQ(content_of(folder_ / "a.mp4"), "mine");
  write_text(folder_ / "still.scene",
             "scene 1\ncamera main { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg }\n");
  EXPECT_THAT(error_of("\"$SDLC\" render still.scene --samples 1 -o b.webm"),
              HasSubstr("`b.webm` is a video, but the scene has no `animation`"));
  EXPECT_EQ(run("\"$SDLC\" render still.scene --width 8 --samples 1 -o b.gif").exit_code, 0)
      << "a single picture";
  EXPECT_THAT(names(), ElementsAre("a.mp4", "b.gif", "film.scene", "still.scene"));
}

TEST_F(Videos, PlayInRealTime) {
  ASSERT_EQ(run("\"$SDLC\" render film.scene --frames 0-12x4 -o a.mp4").exit_code, 0);
  EXPECT_EQ(run("ffprobe -v error -show_entries stream=avg_frame_rate -of csv=p=0 a.mp4").out,
            "1/2\n");
}

}  // namespace
}  // namespace sdlc::test
