// What `render` says about the error of a picture: goals, samples, denoising, and light that is not
// found.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program_test.hpp"

namespace sdlc::test {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kScene = R"(scene 1
camera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }
sphere ball { center: (0, 0, 0), radius: 1, material: diffuse(color: #c04020) }
render { width: 32, samples: 8, depth: 4 }
)";

/// A folder with ball.scene in it.
class RenderError : public ProgramTest {
 protected:
  RenderError() { write("ball.scene", kScene); }
};

TEST_F(RenderError, ReportsHowItSampled) {
  const auto stats = [&](const std::string& flags) {
    const ProgramResult result = sdlc("render ball.scene --width 8 --quiet --stats - " + flags);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out);
  };
  EXPECT_EQ(stats("")["sampler"], "sobol");
  EXPECT_EQ(stats("")["light_sampling"], "auto");
  EXPECT_EQ(stats("--sampler independent")["sampler"], "independent");
  EXPECT_EQ(stats("--light-sampling off")["light_sampling"], "off");
}

TEST_F(RenderError, TakesSamplesBesideAGoalAsTheMostOfThem) {
  for (const char* flags :
       {"--error 1%", "--error 0.01", "--time 1h", "--error 1% --time 2min --adaptive"}) {
    const ProgramResult result =
        sdlc(std::string("render ball.scene --width 8 --samples 9 --stats s.json ") + flags);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("W502"))) << flags;
    const auto stats = nlohmann::json::parse(content("s.json"));
    EXPECT_LE(stats["samples"], 9) << flags;
  }
}

TEST_F(RenderError, SuggestsTheIntendedGoal) {
  const auto refusal = [&](const std::string& flags) {
    const ProgramResult result = sdlc("render ball.scene " + flags);
    EXPECT_EQ(result.exit_code, 2) << flags;
    return result.err;
  };
  EXPECT_THAT(refusal("--time 10"), HasSubstr("--time: takes a time above 0 with its unit"));
  EXPECT_THAT(refusal("--time 10"), HasSubstr("not `10` (did you mean `10s`?)"));
  EXPECT_THAT(refusal("--error 3"), HasSubstr("--error: takes a share above 0 and at most 100%"));
  EXPECT_THAT(refusal("--error 3"), HasSubstr("not `3` (did you mean `3%`?)"));
  EXPECT_THAT(refusal("--error 200%"), HasSubstr("at most 100%"));
  EXPECT_THAT(refusal("--sampler sobel"), HasSubstr("did you mean `sobol`?"));
  EXPECT_THAT(refusal("--light-sampling auot"), HasSubstr("did you mean `auto`?"));
  EXPECT_THAT(refusal("--light_sampling off"), HasSubstr("did you mean `--light-sampling`?"));
  EXPECT_THAT(refusal("--eror 1%"), HasSubstr("did you mean `--error`?"));
  EXPECT_THAT(names_in(folder_.path()), ElementsAre("ball.scene"));
}

TEST_F(RenderError, IsAdaptiveOnlyTowardsAnError) {
  for (const char* flags : {"", "--samples 64", "--time 10s"}) {
    const ProgramResult result = sdlc(std::string("render ball.scene --adaptive ") + flags);
    EXPECT_EQ(result.exit_code, 2) << flags;
    EXPECT_THAT(result.err, HasSubstr("--adaptive needs")) << flags;
    EXPECT_THAT(result.err, HasSubstr("--error 1%")) << flags;
  }
  write("goal.scene", R"(scene 1
camera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }
render { width: 8, samples: 8, error: 5% }
)");
  EXPECT_EQ(sdlc("render goal.scene --adaptive").exit_code, 0);
  EXPECT_EQ(sdlc("render goal.scene --adaptive --time 10s").exit_code, 2);
}

/// A lamp that lights a ground, with much noise.
constexpr const char* kLampOverGround = R"(scene 1
camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }
background { color: rgb(20%, 20%, 20%) }
render { width: 80, height: 60, samples: 16, light_sampling: off }
sphere { center: (0, -100, 0), radius: 100, material: diffuse(white) }
sphere { center: (0, 2.5, 0), radius: 0.6, material: emissive(color: white, intensity: 5) }
)";

TEST_F(RenderError, StatesTheErrorBeforeAndAfterDenoising) {
  write("lamp.scene", kLampOverGround);
  const ProgramResult plain = sdlc("render lamp.scene -o plain.png --stats plain.json");
  const ProgramResult result =
      sdlc("render lamp.scene --denoise -o denoised.png --stats denoised.json");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, ContainsRegex("error [0-9.]+ % → [0-9.]+ % \\([0-9.]+ to [0-9.]+ %\\)"));
  EXPECT_THAT(result.err, Not(HasSubstr("warning")));
  const auto before = nlohmann::json::parse(content("plain.json"));
  const auto after = nlohmann::json::parse(content("denoised.json"));
  EXPECT_EQ(before["denoised"], false);
  EXPECT_EQ(after["denoised"], true);
  EXPECT_EQ(before["plain_relative_error"], before["relative_error"]);
  EXPECT_EQ(after["plain_relative_error"], before["relative_error"]);
  EXPECT_LT(after["relative_error"], before["relative_error"]);
  EXPECT_NE(content("denoised.png"), content("plain.png"));
}

TEST_F(RenderError, SaysWhyAPictureIsNotDenoised) {
  write("lamp.scene", kLampOverGround);
  const auto warning = [&](const std::string& flags) {
    const ProgramResult result = sdlc("render lamp.scene -o a.png --denoise " + flags);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("→")));
    return result.err;
  };
  EXPECT_THAT(warning("--samples 7"), HasSubstr("warning: the picture is not denoised: that takes "
                                                "at least 8 samples per pixel\n"));
  EXPECT_THAT(warning("--width 1 --height 1"),
              HasSubstr("warning: the picture is not denoised: its error would be unknown\n"));
  EXPECT_THAT(warning("--width 4 --height 3 --samples 4096"),
              HasSubstr("warning: the picture is not denoised: that would not lower its error\n"));
}

TEST_F(RenderError, RefusesToDenoiseWhereTheErrorIsOfThePlainPicture) {
  const auto refusal = [&](const std::string& flags) {
    const ProgramResult result = sdlc("render ball.scene --denoise " + flags);
    EXPECT_EQ(result.exit_code, 2) << flags;
    return result.err;
  };
  EXPECT_THAT(refusal("--error 1% --adaptive"),
              HasSubstr("--adaptive and --denoise exclude each other"));
  EXPECT_THAT(refusal("-o a.exr --aov variance"),
              HasSubstr("--aov: `variance` is that of the picture that is not denoised"));
}

TEST_F(RenderError, WarnsOfSamplesThatCannotReachTheError) {
  const ProgramResult result = sdlc("render ball.scene --error 1% --samples 4");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("warning[W502]: 4 samples cannot reach an error of 1%"));
  EXPECT_THAT(result.err, HasSubstr("remove `--samples`, or set it to at least 8"));
}

TEST_F(RenderError, GivesTheReasonWhyTheErrorIsUnknown) {
  const auto lit_by = [&](const std::string& intensity) {
    write("lamp.scene",
          "scene 1\ncamera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
          "background { color: black }\nrender { width: 32, samples: 8 }\n"
          "sphere { center: (0, 0, 0), radius: 1, material: emissive(color: white, "
          "intensity: " +
              intensity + ") }\n");
    return sdlc("render lamp.scene -o a.png").err;
  };
  EXPECT_THAT(lit_by("1e200"), HasSubstr("warning: the error is unknown: the radiance is so large "
                                         "that its square overflows; use darker lights\n"));
  EXPECT_THAT(lit_by("1e-200"), HasSubstr("warning: the error is unknown: the radiance is so small "
                                          "that its square underflows; use brighter lights\n"));
  EXPECT_THAT(lit_by("1e100"), Not(HasSubstr("unknown")));

  write("room.scene", std::string(kScene) +
                          "sphere { center: (0, 0, 0), radius: "
                          "9, material: diffuse(color: tan) }\n");
  EXPECT_THAT(sdlc("render room.scene -o a.png").err,
              HasSubstr("warning: the error is unknown: the picture is black and `depth` cut off "
                        "paths, which may find light with a larger one\n"));
}

TEST_F(RenderError, SaysWhatAutomaticLightSamplingChose) {
  const auto last_line = [&](const std::string& sky, const std::string& lamp,
                             const std::string& flags) {
    write_text(
        folder_ / "lamp.scene",
        "scene 1\ncamera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n"
        "background { color: " +
            sky +
            " }\nrender { width: 32, samples: 8 }\n"
            "sphere { center: (0, -100, 0), radius: 100, material: diffuse(color: gray) }\n" +
            lamp);
    return sdlc("render lamp.scene -o a.png " + flags).err;
  };
  const std::string lamp =
      "sphere { center: (0, 8, 0), radius: 0.1, material: emissive(color: white) }\n";
  EXPECT_THAT(last_line("black", lamp, ""), EndsWith(", light sampling on, 1 light\n"));
  EXPECT_THAT(last_line("white", lamp, ""), EndsWith(", light sampling off\n"));
  EXPECT_THAT(last_line("black", lamp, "--light-sampling on"), Not(HasSubstr("light sampling")));
  EXPECT_THAT(last_line("white", "", ""), Not(HasSubstr("light sampling")));
}

// Connections by way of rough metal are not made.
TEST_F(RenderError, SuggestsCausticsWhereTheyFindTheLightThatIsMissing) {
  const auto warnings = [&](const std::string& material, const std::string& flags) {
    write("caustic.scene",
          "scene 1\ncamera main { from: (0, 2.5, 7), at: (0, 0.7, 0), fov: 35deg }\n"
          "background { color: black }\nrender { width: 32, samples: 32 }\n"
          "sphere { center: (0, -1000, 0), radius: 1000, material: diffuse(color: gray) }\n"
          "sphere { center: (0, 1, 0), radius: 1, material: " +
              material +
              " }\n"
              "sphere { center: (2.5, 3.5, 1), radius: 0.01, "
              "material: emissive(color: white, intensity: 13500) }\n");
    return sdlc("render caustic.scene -o a.png " + flags).err;
  };
  const char* hint = "more samples, or --light-sampling caustics, may find it";
  EXPECT_THAT(warnings("transmissive(ior: 1.5)", "--light-sampling on"), HasSubstr(hint));
  const std::string rough = warnings("specular(color: white, fuzz: 0.02)", "");
  EXPECT_THAT(rough, HasSubstr("the error is unknown"));
  EXPECT_THAT(rough, Not(HasSubstr("caustics,")));
}

}  // namespace
}  // namespace sdlc::test
