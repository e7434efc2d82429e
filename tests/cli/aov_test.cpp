#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/image/image.hpp"
#include "tests/support/exr_channels.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

constexpr const char* kScene = R"(scene 1
camera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }
sphere ball { center: (0, 0, 0), radius: 1, material: diffuse(color: rgb(255, 0, 255)) }
render { width: 33, height: 33, samples: 8, depth: 4 }
)";

constexpr std::size_t kMiddle = 16 * 33 + 16;

/// A folder with ball.scene in it.
class AovCommand : public testing::Test {
 protected:
  AovCommand() { write_text(folder_ / "ball.scene", kScene); }

  ProgramResult run(const std::string& command) { return run_shell(folder_.path(), command); }
  ProgramResult render(const std::string& flags) {
    return run("\"$SDLC\" render ball.scene --quiet " + flags);
  }
  /// The output of a command that must not render anything.
  std::string refusal(const std::string& flags) {
    const ProgramResult result = render(flags);
    EXPECT_EQ(result.exit_code, 2) << flags;
    EXPECT_THAT(names_in(folder_.path()), ElementsAre("ball.scene"));
    return result.err;
  }
  std::vector<std::string> names(const std::string& file) {
    std::vector<std::string> names;
    for (const auto& [name, values] : exr_channels(folder_ / file)) names.push_back(name);
    return names;
  }

  TemporaryFolder folder_;
};

TEST_F(AovCommand, WritesEachChannelBesideThePicture) {
  const ProgramResult result =
      render("-o a.exr --aov normal,depth --aov albedo,variance,samples,depth");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const auto channels = exr_channels(folder_ / "a.exr");
  EXPECT_THAT(names("a.exr"),
              UnorderedElementsAre("R", "G", "B", "Z", "normal.X", "normal.Y", "normal.Z",
                                   "albedo.R", "albedo.G", "albedo.B", "variance.R", "variance.G",
                                   "variance.B", "samples.V"));
  EXPECT_NEAR(channels.at("Z")[kMiddle], 4, 1e-3);
  EXPECT_NEAR(channels.at("normal.Z")[kMiddle], 1, 1e-3);
  EXPECT_EQ(channels.at("albedo.R")[kMiddle], 1);
  EXPECT_EQ(channels.at("albedo.G")[kMiddle], 0);
  EXPECT_GT(channels.at("variance.R")[kMiddle], 0);
  EXPECT_EQ(channels.at("variance.G")[kMiddle], 0) << "the ball reflects no green";
  EXPECT_THAT(channels.at("samples.V"), Each(8));
}

TEST_F(AovCommand, LeavesThePictureAsItIsWithoutThem) {
  EXPECT_EQ(render("-o plain.exr -o plain.png").exit_code, 0);
  EXPECT_EQ(render("-o a.exr -o a.png --aov normal,depth,albedo,variance,samples").exit_code, 0);
  EXPECT_EQ(content_of(folder_ / "a.png"), content_of(folder_ / "plain.png"));
  EXPECT_EQ(render::read_picture(folder_ / "a.exr").pixels,
            render::read_picture(folder_ / "plain.exr").pixels);
  EXPECT_THAT(names("plain.exr"), UnorderedElementsAre("R", "G", "B"));
}

TEST_F(AovCommand, GivesTheSameFileForAnyNumberOfThreads) {
  for (const std::string threads : {"1", "7"}) {
    const ProgramResult result = render("--aov normal,depth,albedo,variance,samples --threads " +
                                        threads + " -o " + threads + ".exr");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
  }
  EXPECT_EQ(content_of(folder_ / "1.exr"), content_of(folder_ / "7.exr"));
}

TEST_F(AovCommand, SuggestsTheIntendedChannel) {
  EXPECT_THAT(refusal("-o a.exr --aov depth,normals"),
              HasSubstr("`normals` is not one of normal, depth, albedo, variance, samples (did you "
                        "mean `normal`?)"));
  EXPECT_THAT(refusal("-o a.exr --aov ''"), HasSubstr("--aov"));
}

TEST_F(AovCommand, NeedsAnExrFile) {
  for (const char* outputs : {"", "-o a.png -o a.hdr", "-o -"}) {
    EXPECT_THAT(refusal(std::string("--aov depth ") + outputs),
                HasSubstr("error: --aov: only .exr files can store additional channels, and there "
                          "is no .exr output; add one, such as -o picture.exr"));
  }
  const ProgramResult both = render("-o - -o a.exr --aov depth");
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_THAT(both.out, HasSubstr("PNG"));
}

TEST_F(AovCommand, NeedsEightSamplesForTheVariance) {
  EXPECT_THAT(refusal("-o a.exr --aov variance --samples 7"),
              HasSubstr("`variance` takes at least 8 samples per pixel, and this render has 7; use "
                        "more, such as --samples 8, or omit `variance`"));
  EXPECT_EQ(render("-o a.exr --aov variance --samples 8").exit_code, 0);
}

TEST_F(AovCommand, LeavesOutAVarianceThatTimeWasTooShortFor) {
  const ProgramResult result =
      render("-o a.exr --aov variance,samples --time 1ms --width 600 --height 600");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("warning: --aov: without variance, as it takes at least 8 "
                                    "samples per pixel, and there was time for "));
  EXPECT_THAT(names("a.exr"), UnorderedElementsAre("R", "G", "B", "samples.V"));
}

TEST_F(AovCommand, LeavesOutAVarianceThatFloatsCannotHold) {
  const auto lit = [&](const std::string& intensity) {
    write_text(folder_ / "lit.scene", content_of(folder_ / "ball.scene") +
                                          "sphere lamp { center: (0, 9, 9), radius: 5, material: "
                                          "emissive(color: white, intensity: " +
                                          intensity + ") }\nbackground { color: black }\n");
    return run("\"$SDLC\" render lit.scene --quiet --depth 9 --samples 32 --aov variance -o a.exr");
  };
  const char* const warning =
      "warning: --aov: without variance, as its values are beyond the range of 32-bit floats\n";
  for (const char* intensity : {"1e25", "1e-25", "1e200"}) {
    const ProgramResult result = lit(intensity);
    EXPECT_EQ(result.exit_code, 0) << intensity;
    EXPECT_THAT(result.err, HasSubstr(warning)) << intensity;
    EXPECT_THAT(names("a.exr"), UnorderedElementsAre("R", "G", "B")) << intensity;
  }
  for (const char* intensity : {"1e15", "1e-15"}) {
    EXPECT_EQ(lit(intensity).err, "") << intensity;
    EXPECT_EQ(names("a.exr").size(), 6u) << intensity;
  }
}

TEST_F(AovCommand, ReportsTheSamplesOfEachPixel) {
  const ProgramResult result =
      render("-o a.exr --aov samples,variance --error 0.3% --adaptive --samples 65536");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto channels = exr_channels(folder_ / "a.exr");
  const auto& samples = channels.at("samples.V");
  EXPECT_LT(*std::ranges::min_element(samples), *std::ranges::max_element(samples));
  EXPECT_GT(*std::ranges::max_element(channels.at("variance.R")), 0);
}

TEST_F(AovCommand, IsOfEachFrameOfAFilm) {
  write_text(folder_ / "film.scene",
             "scene 1\ncamera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
             "animation { fps: 1, frames: 1 .. 2 }\n"
             "sphere ball { center: (0, 0, -time / 1s), radius: 1, material: unlit(red) }\n"
             "render { width: 33, height: 33, samples: 1 }\n");
  const ProgramResult result =
      run("\"$SDLC\" render film.scene --quiet -o f.####.exr --aov depth --frames 1-2");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const float first = exr_channels(folder_ / "f.0001.exr").at("Z")[kMiddle];
  const float second = exr_channels(folder_ / "f.0002.exr").at("Z")[kMiddle];
  EXPECT_EQ(second - first, 1);
}

/// Rows of balls; the third row begins at (0, 0, 0), and the first is not an instance.
std::string instances(int balls, int instances) {
  return "scene 1\ncamera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
         "render { width: 33, height: 33, samples: 1 }\n"
         "def row() {\n  for i in range(" +
         std::to_string(balls) +
         ") { sphere { center: (0, 0, -3 * i), radius: 1, material: unlit(red) } }\n}\n"
         "for i in range(" +
         std::to_string(instances) + ") { row { translate: (3 * (i - 2), 0, 0) } }\n";
}

TEST_F(AovCommand, SeesWhatIsHeldOnceInEachPlace) {
  write_text(folder_ / "rows.scene", instances(5, 3));
  const ProgramResult result =
      run("\"$SDLC\" render rows.scene --quiet -o a.exr --aov depth,albedo --instances always "
          "--stats -");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("\"instances\":2"));
  EXPECT_EQ(exr_channels(folder_ / "a.exr").at("Z")[kMiddle], 4);
}

TEST_F(AovCommand, TracesVeryManyInstances) {
  write_text(folder_ / "rows.scene", instances(10000, 1001));
  const ProgramResult result =
      run("\"$SDLC\" render rows.scene --quiet -o a.exr --aov depth,samples --instances always");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(exr_channels(folder_ / "a.exr").at("Z")[kMiddle], 4);
}

TEST_F(AovCommand, SavesWhatIsKnownOfAnInterruptedPicture) {
  const ProgramResult result =
      run("env --default-signal=INT \"$SDLC\" render ball.scene --width 1000 --height 1000 "
          "--samples 10000 --progress json --aov depth,variance,samples -o a.exr 2>log & pid=$!\n"
          "while kill -0 $pid && ! grep -qs '\"samples\": [1-9]' log; do sleep 0.1; done\n"
          "kill -INT $pid; wait $pid");
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(content_of(folder_ / "log"),
              HasSubstr("warning: --aov: without variance, samples, as the render was "
                        "interrupted\n"));
  EXPECT_THAT(names("a.partial.exr"), UnorderedElementsAre("R", "G", "B", "Z"));
}

TEST_F(AovCommand, OfACropAreThoseOfTheWholePictureInADataWindow) {
  EXPECT_EQ(render("--width 40 -o whole.exr --aov depth").exit_code, 0);
  EXPECT_EQ(render("--width 40 --crop 10,5,20,10 -o part.exr --aov depth").exit_code, 0);
  EXPECT_EQ(render("--width 40 --crop 25%,5,50%,10 --zoom 3 -o large.exr -o large.png --aov depth")
                .exit_code,
            0);
  const auto input = OIIO::ImageInput::open((folder_ / "part.exr").string());
  ASSERT_TRUE(input);
  const OIIO::ImageSpec& spec = input->spec();
  const std::vector<int> windows{spec.x,      spec.y,      spec.width,      spec.height,
                                 spec.full_x, spec.full_y, spec.full_width, spec.full_height};
  const int height = OIIO::ImageInput::open((folder_ / "whole.exr").string())->spec().height;
  EXPECT_THAT(windows, ElementsAre(10, 5, 20, 10, 0, 0, 40, height));
  const auto whole = exr_channels(folder_ / "whole.exr"), part = exr_channels(folder_ / "part.exr"),
             large = exr_channels(folder_ / "large.exr");
  for (const char* name : {"R", "G", "B", "Z"}) {
    for (std::size_t y = 0; y < 10; ++y) {
      for (std::size_t x = 0; x < 20; ++x) {
        const float value = whole.at(name)[(y + 5) * 40 + x + 10];
        ASSERT_EQ(part.at(name)[y * 20 + x], value);
        ASSERT_EQ(large.at(name)[(3 * y + 2) * 60 + 3 * x + 1], value);
      }
    }
  }
  EXPECT_EQ(render::read_picture(folder_ / "large.png").width, 60);
}

TEST_F(AovCommand, OfACropThatIsNotInsideAreRefused) {
  for (const char* crop : {"0,0,0,5", "50%,0,60%,10%", "0,0,100000,1", "1,2,3", "1,2,3,4,5",
                           "a,0,1,1", "-1,0,2,2", "0,0,1%,1%", "1,2,3,4,", ""}) {
    const ProgramResult result = render(std::string("--width 40 -o a.png --crop=") + crop);
    EXPECT_EQ(result.exit_code, 2) << crop;
    EXPECT_THAT(result.err, HasSubstr("--crop")) << crop;
  }
}

}  // namespace
}  // namespace sdlc::test
