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

TEST_F(Videos, GifNeedsNoFfmpeg) {
  ASSERT_EQ(run("\"$SDLC\" render film.scene -o f.####.ppm").exit_code, 0);
  const ProgramResult result =
      run("PATH=/nowhere \"$SDLC\" render film.scene --frames 0-13 -o a.gif");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("a.gif: 14 frames, 2 per second\n"));
  EXPECT_EQ(difference("a.gif"), 0) << "a frame has one colour";
  EXPECT_EQ(run("ffprobe -v error -count_frames -show_entries stream=avg_frame_rate,nb_read_frames"
                " -of csv=p=0 a.gif")
                .out,
            "2/1,14\n");
  // Delays are whole hundredths of a second, and some are longer: 14 / 24 s are 0.58 s.
  std::string text = kColors;
  write_text(folder_ / "fast.scene", text.replace(text.find("fps: 2"), 6, "fps: 24"));
  EXPECT_THAT(run("PATH=/nowhere \"$SDLC\" render fast.scene -o a.gif").err,
              HasSubstr("a.gif: 14 frames, 24 per second\n"));
  EXPECT_EQ(
      run("ffprobe -v error -show_entries packet=duration -of csv=p=0 a.gif | tr '\\n' ' '").out,
      "4 4 5 4 4 4 4 4 5 4 4 4 4 4 ");
}

TEST_F(Videos, ThatAreThereAreLeftBySkipExisting) {
  write_text(folder_ / "a.mp4", "mine");
  const ProgramResult none =
      run("\"$SDLC\" render film.scene --skip-existing -o a.mp4 --stats s.json");
  EXPECT_EQ(none.exit_code, 0) << none.err;
  EXPECT_EQ(none.err, "`a.mp4` is there already\n");
  const ProgramResult one = run("\"$SDLC\" render film.scene --skip-existing -o a.mp4 -o b.apng");
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_THAT(one.err, HasSubstr("b.apng: 14 frames"));
  ASSERT_EQ(run("\"$SDLC\" render film.scene --skip-existing -o a.mp4 -o f.####.ppm").exit_code, 0);
  EXPECT_THAT(names(), testing::Contains("f.0013.ppm"));
  EXPECT_EQ(content_of(folder_ / "a.mp4"), "mine");
  EXPECT_THAT(names(), testing::Not(testing::Contains("s.json"))) << "nothing was rendered";
}

/// Of a program in the place of ffmpeg that reads nothing and does not end.
TEST_F(Videos, DoNotWaitForAnEncoderThatHangsAfterASignal) {
  std::filesystem::create_directory(folder_ / "bin");
  write_text(folder_ / "bin/ffmpeg",
             "#!/bin/sh\necho $$ > pid.tmp\nmv pid.tmp pid\nexec sleep 1000\n");
  std::filesystem::permissions(folder_ / "bin/ffmpeg", std::filesystem::perms::owner_all);
  struct Case {
    const char* size;  // of a frame: all fit into the buffer of the socket, or none does
    const char* signals;
    int status;
  };
  for (const auto& [size, signals, status] :
       {Case{"", "", 2}, Case{"--width 640 --height 480", "", 2},
        Case{"", "kill $job; sleep 0.2; kill $job", 143}}) {
    const ProgramResult result = run(
        "PATH=\"$PWD/bin:$PATH\" \"$SDLC\" render film.scene -o a.mp4 " + std::string(size) +
        " & job=$!\n"
        "until [ -e pid ] || ! kill -0 $job; do sleep 0.01; done\n"
        "sleep 0.5; " +
        (*signals == '\0' ? "kill $job" : signals) +
        "; wait $job; status=$?\n"
        "while kill -0 $(cat pid) 2>/dev/null; do sleep 0.01; done\n"  // a zombie's parent reaps it
        "rm pid; exit $status");
    EXPECT_EQ(result.exit_code, status) << size << signals << result.err;
    if (*signals == '\0') {
      EXPECT_THAT(result.err, HasSubstr("ffmpeg did nothing for 5 s after the interruption"));
    }
    EXPECT_THAT(names(), ElementsAre("bin", "film.scene"));
  }
}

/// Videos that are not finished at once.
class KeptVideos : public Videos {
 protected:
  static constexpr const char* kFailing = "assert time != 2s, \"not now\"\n";

  void stop_at_frame_4(const std::string& arguments) {
    write_text(folder_ / "film.scene", std::string(kColors) + kFailing);
    const ProgramResult result =
        run("\"$SDLC\" render film.scene --checkpoint 60s --fail-fast " + arguments);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("--resume goes on from the frames in `a.mp4.frames`\n"));
    write_text(folder_ / "film.scene", kColors);
  }
};

TEST_F(KeptVideos, GoOnFromTheFramesThatAreThere) {
  ASSERT_EQ(run("\"$SDLC\" render film.scene -o b.mp4 --stats all.json").exit_code, 0);
  stop_at_frame_4("-o a.mp4");
  EXPECT_EQ(names_in(folder_ / "a.mp4.frames"),
            (std::vector<std::string>{"0000.kept.png", "0001.kept.png", "0002.kept.png",
                                      "0003.kept.png"}));
  const ProgramResult result =
      run("\"$SDLC\" render film.scene -o a.mp4 --checkpoint 60s --resume --stats rest.json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(content_of(folder_ / "a.mp4"), content_of(folder_ / "b.mp4"));
  const std::string rest = content_of(folder_ / "rest.json");
  EXPECT_EQ(std::ranges::count(rest, '\n'), 10) << "the other frames were not rendered again";
  EXPECT_THAT(names(), ElementsAre("a.mp4", "all.json", "b.mp4", "film.scene", "rest.json"));
}

TEST_F(KeptVideos, GoOnAfterAnInterruptionWithinAFrame) {
  write_text(folder_ / "slow.scene",
             std::string(kColors) +
                 "sphere { center: (0, 0, 0), radius: 3, material: diffuse(#888888) }\n");
  const std::string render = "\"$SDLC\" render slow.scene --frames 0-2 --width 65 --samples 3000 ";
  ASSERT_EQ(run(render + "-o b.mp4").exit_code, 0);
  run(render +
      "-o a.mp4 --checkpoint 1ms & job=$!\n"
      "until [ -e a.mp4.frames/0001.kept.film ] || ! kill -0 $job; do sleep 0.01; done\n"
      "kill -s KILL $job; wait $job");
  ASSERT_TRUE(std::filesystem::exists(folder_ / "a.mp4.frames/0001.kept.film"));
  ASSERT_EQ(run(render + "-o a.mp4 --resume --stats s.json").exit_code, 0);
  EXPECT_EQ(content_of(folder_ / "a.mp4"), content_of(folder_ / "b.mp4"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.mp4.frames"));
  const std::string stats = content_of(folder_ / "s.json");
  EXPECT_EQ(std::ranges::count(stats, '\n'), 2) << "frame 0 was not rendered again";
}

TEST_F(KeptVideos, RefuseFramesOfAnotherPicture) {
  stop_at_frame_4("-o a.mp4");
  const auto error_of = [&](int status, const std::string& arguments) {
    const ProgramResult result = run("\"$SDLC\" render film.scene -o a.mp4 " + arguments);
    EXPECT_EQ(result.exit_code, status) << arguments << result.err;
    return result.err;
  };
  EXPECT_THAT(error_of(2, "--checkpoint 60s"), HasSubstr("`a.mp4.frames` exists; use --resume"));
  EXPECT_THAT(error_of(1, "--resume --samples 2"), HasSubstr("`samples` is 1, not 2"));
  EXPECT_THAT(error_of(1, "--resume --zoom 2"), HasSubstr("`zoom` is 1, not 2"));
  std::string text = kColors;
  write_text(folder_ / "film.scene", text.replace(text.find("(0, 0, 9)"), 9, "(0, 0, 8)"));
  EXPECT_THAT(error_of(1, "--resume"),
              HasSubstr("the video cannot go on from this frame: it differs in `camera`"));
  // So is a later one, after a frame that is rendered.
  std::filesystem::remove(folder_ / "a.mp4.frames/0000.kept.png");
  EXPECT_THAT(error_of(1, "--resume"),
              testing::AllOf(HasSubstr("0001.kept.png"), HasSubstr("differs in `camera`"),
                             testing::Not(HasSubstr("--resume goes on"))));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a.mp4.frames/0003.kept.png"));
}

TEST_F(KeptVideos, OfASceneFromStandardInputGoOn) {
  stop_at_frame_4("-o a.mp4");
  ASSERT_EQ(run("\"$SDLC\" render - -o a.mp4 --resume --stats s.json <film.scene").exit_code, 0);
  const std::string stats = content_of(folder_ / "s.json");
  EXPECT_EQ(std::ranges::count(stats, '\n'), 10);
}

TEST_F(KeptVideos, LeaveFilesOfOthersInTheFolder) {
  stop_at_frame_4("-o a.mp4");
  write_text(folder_ / "a.mp4.frames/0001.png", "mine");
  ASSERT_EQ(run("\"$SDLC\" render film.scene -o a.mp4 --resume").exit_code, 0);
  EXPECT_THAT(names_in(folder_ / "a.mp4.frames"), ElementsAre("0001.png"));
}

TEST_F(KeptVideos, RenderDamagedFramesAgain) {
  ASSERT_EQ(run("\"$SDLC\" render film.scene -o b.mp4 --frames 2-13").exit_code, 0);
  stop_at_frame_4("-o a.mp4");
  write_text(folder_ / "a.mp4.frames/0002.kept.png", "no picture");
  const ProgramResult result = run("\"$SDLC\" render film.scene -o a.mp4 --frames 2-13 --resume");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("warning: cannot read `a.mp4.frames/0002.kept.png`"));
  EXPECT_EQ(content_of(folder_ / "a.mp4"), content_of(folder_ / "b.mp4"));
  EXPECT_THAT(names_in(folder_ / "a.mp4.frames"), ElementsAre("0000.kept.png", "0001.kept.png"))
      << "only those of the video";
}

TEST_F(KeptVideos, RenderFramesWithDamagedFilmsOrMetadataAgain) {
  ASSERT_EQ(run("\"$SDLC\" render film.scene -o b.mp4").exit_code, 0);
  stop_at_frame_4("-o a.mp4");
  // A picture without metadata, and a film of no bytes.
  ASSERT_EQ(run("\"$SDLC\" render film.scene --frames 2 -o a.mp4.frames/0002.kept.png").exit_code,
            0);
  write_text(folder_ / "a.mp4.frames/0004.kept.film", "");
  const ProgramResult result = run("\"$SDLC\" render film.scene -o a.mp4 --resume");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err,
              HasSubstr("warning: cannot read `a.mp4.frames/0002.kept.png`: it does not "
                        "say of which picture it is\n"));
  EXPECT_THAT(result.err, HasSubstr("warning: `a.mp4.frames/0004.kept.film`"));
  EXPECT_EQ(content_of(folder_ / "a.mp4"), content_of(folder_ / "b.mp4"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.mp4.frames"));
}

TEST_F(KeptVideos, RenderFramesWhosePicturesAreMissing) {
  stop_at_frame_4("-o a.mp4 -o f.####.ppm");
  const std::string third = content_of(folder_ / "f.0002.ppm");
  std::filesystem::remove(folder_ / "f.0002.ppm");
  ASSERT_EQ(
      run("\"$SDLC\" render film.scene -o a.mp4 -o f.####.ppm --resume --stats s.json").exit_code,
      0);
  EXPECT_EQ(content_of(folder_ / "f.0002.ppm"), third);
  const std::string stats = content_of(folder_ / "s.json");
  EXPECT_EQ(std::ranges::count(stats, '\n'), 11);
}

TEST_F(KeptVideos, DoNotTakePicturesOfBeforeForTheirOwn) {
  std::string other = kColors;
  write_text(folder_ / "film.scene", other.replace(other.find("i * 51"), 6, "i * 40"));
  ASSERT_EQ(run("\"$SDLC\" render film.scene -o f.####.ppm").exit_code, 0);
  write_text(folder_ / "film.scene", kColors);
  // Pictures have 1.7 kB, kept frames less than 1.5 kB.
  const std::string render = "\"$SDLC\" render film.scene -o f.####.ppm -o a.mp4 ";
  EXPECT_NE(run("trap '' XFSZ; prlimit --fsize=1600 " + render + "--checkpoint 60s").exit_code, 0);
  ASSERT_EQ(run(render + "--resume").exit_code, 0);
  const std::string second = content_of(folder_ / "f.0001.ppm");
  ASSERT_EQ(run("\"$SDLC\" render film.scene -o f.####.ppm").exit_code, 0);
  EXPECT_EQ(second, content_of(folder_ / "f.0001.ppm"));
}

TEST_F(KeptVideos, AreKeptBesideFilms) {
  const std::string render = "\"$SDLC\" render film.scene --samples 2 -o a.mp4 -o f.####.film ";
  write_text(folder_ / "film.scene", std::string(kColors) + kFailing);
  EXPECT_EQ(run(render + "--checkpoint 60s --fail-fast").exit_code, 1);
  EXPECT_THAT(names_in(folder_ / "a.mp4.frames"), testing::SizeIs(4));
  write_text(folder_ / "f.0004.film", "no film");
  write_text(folder_ / "film.scene", kColors);
  const ProgramResult result = run(render + "--resume");
  EXPECT_EQ(result.exit_code, 1) << "a film of the user is not replaced";
  EXPECT_EQ(content_of(folder_ / "f.0004.film"), "no film");
}

TEST_F(KeptVideos, GoOnBesideAVideoThatIsThere) {
  stop_at_frame_4("-o a.mp4 -o b.apng");
  write_text(folder_ / "a.mp4", "mine");
  ASSERT_EQ(run("\"$SDLC\" render film.scene -o a.mp4 -o b.apng --resume --skip-existing "
                "--stats s.json")
                .exit_code,
            0);
  const std::string stats = content_of(folder_ / "s.json");
  EXPECT_EQ(std::ranges::count(stats, '\n'), 10);
  EXPECT_THAT(names(), ElementsAre("a.mp4", "b.apng", "film.scene", "s.json"));
}

TEST_F(Videos, HaveRatesThatTheirFormatAllows) {
  std::string text = kColors;
  write_text(folder_ / "fast.scene", text.replace(text.find("fps: 2"), 6, "fps: 120"));
  const ProgramResult result =
      run("\"$SDLC\" render fast.scene -o a.gif -o a.mp4 -o a.webm --frames 0-9");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("a.gif: 10 frames, 50 per second\n"));
  EXPECT_THAT(result.err, HasSubstr("a.mp4: 10 frames, 120 per second\n"));
  EXPECT_EQ(run("ffprobe -v error -show_entries stream=avg_frame_rate -of csv=p=0 a.gif").out,
            "50/1\n");
  text.replace(text.find("fps: 120"), 8, "fps: 9999");
  write_text(folder_ / "fast.scene", text);
  const ProgramResult faster =
      run("\"$SDLC\" render fast.scene --frames 0-9 -o a.gif -o a.mp4 -o a.webm -o a.mkv "
          "-o a.webp -o a.apng");
  EXPECT_EQ(faster.exit_code, 0) << faster.err;
}

TEST_F(Videos, AreTheSameOnAnyNumberOfProcessors) {
  const std::string render = "\"$SDLC\" render film.scene --width 640 --height 360 -o ";
  ASSERT_EQ(run("taskset -c 0 " + render + "a.mp4 -o a.webm").exit_code, 0);
  ASSERT_EQ(run(render + "b.mp4 -o b.webm").exit_code, 0);
  EXPECT_EQ(content_of(folder_ / "a.mp4"), content_of(folder_ / "b.mp4"));
  EXPECT_EQ(content_of(folder_ / "a.webm"), content_of(folder_ / "b.webm"));
}

TEST_F(Videos, AreNotThereIfTheirEndCannotBeWritten) {
  for (const char* name : {"a.mp4", "a.webm", "a.mkv", "a.gif", "a.webp", "a.apng"}) {
    // So much that only the end, or the last block, is missing.
    ASSERT_EQ(run("\"$SDLC\" render film.scene -o " + std::string(name)).exit_code, 0);
    const auto size = std::filesystem::file_size(folder_ / name);
    std::filesystem::remove(folder_ / name);
    const ProgramResult result = run("trap '' XFSZ; prlimit --fsize=" + std::to_string(size - 1) +
                                     " \"$SDLC\" render film.scene --quiet -o " + name);
    EXPECT_NE(result.exit_code, 0) << name;
    EXPECT_THAT(names(), ElementsAre("film.scene")) << name;
  }
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
  EXPECT_THAT(
      error_of("\"$SDLC\" render film.scene --samples 600 --shard 1/2 --shard-by samples -o b.mp4"),
      HasSubstr("a video of all frames, and a shard has not all: use -o NAME.####.film"));
  EXPECT_THAT(error_of("\"$SDLC\" render film.scene --shard 1/2 -o b.mp4"),
              HasSubstr("use -o NAME.####.png"));
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
