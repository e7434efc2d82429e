#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "render/image/image.hpp"
#include "render/kernel/backend.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kScene = R"(scene 1
camera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }
sphere ball { center: (0, 0, 0), radius: 1, material: diffuse(color: #c04020) }
render { width: 32, samples: 8, depth: 4 }
)";

constexpr const char* kConfig = R"({
  "background": [0, 0, 0],
  "camera": {"look_from": [0, 0, 0], "look_at": [0, 0, -1], "up": [0, 1, 0], "vfov": 90, "focal_length": 1,
             "aspect_ratio": 1.6, "viewport_height": 2, "samples_per_pixel": 4},
  "rendering": {"width": 640, "render_depth": 3},
  "saving": {"path": "results/deep/picture.ppm", "gamma_correct": true},
  "spheres": [{"origin": [0, 0, -3], "radius": 1, "material": {"type": "no_texture", "color": [51, 102, 255]}}]
})";

/// A folder with ball.scene and config.json in it.
class RenderCommand : public testing::Test {
 protected:
  RenderCommand() {
    write_text(folder_ / "ball.scene", kScene);
    write_text(folder_ / "config.json", kConfig);
  }

  ProgramResult run(const std::string& command) { return run_shell(folder_.path(), command); }
  std::vector<std::string> names() const { return names_in(folder_.path()); }

  TemporaryFolder folder_;
};

TEST_F(RenderCommand, NamesThePictureAfterTheSceneByDefault) {
  const ProgramResult result = run("\"$SDLC\" render ball.scene");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("ball.png"));
  EXPECT_THAT(names(), ElementsAre("ball.png", "ball.scene", "config.json"));
  const render::Picture picture = render::read_picture(folder_ / "ball.png");
  EXPECT_EQ(picture.width, 32);
  EXPECT_EQ(picture.height, 18);
}

TEST_F(RenderCommand, MakesTheFolderOfAConfigsOwnPath) {
  const ProgramResult result = run("\"$SDLC\" render config.json --quiet");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const render::Picture picture = render::read_picture(folder_ / "results/deep/picture.ppm");
  EXPECT_EQ(picture.height, 400) << "640 / 1.6";
  // The square root of .2, .4 and 1, rounded to 8 bits.
  const render::LinearRgb middle = picture.at(320, 200);
  EXPECT_EQ(middle, (render::LinearRgb{114 / 255.0, 161 / 255.0, 1}));
}

TEST_F(RenderCommand, LeavesAConfigsFolderAloneWhenTheOutputIsElsewhere) {
  EXPECT_EQ(run("\"$SDLC\" render config.json --width 16 -o here.png").exit_code, 0);
  EXPECT_THAT(names(), ElementsAre("ball.scene", "config.json", "here.png"));
}

TEST_F(RenderCommand, WritesSeveralPicturesOfOneRender) {
  const ProgramResult result =
      run("\"$SDLC\" render ball.scene -o a.png -o b.exr -o c.ppm --ppm-text");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(names(), ElementsAre("a.png", "b.exr", "ball.scene", "c.ppm", "config.json"));
  EXPECT_THAT(content_of(folder_ / "c.ppm"), StartsWith("P3"));
}

TEST_F(RenderCommand, ReadsAndWritesStandardStreams) {
  const ProgramResult result = run("\"$SDLC\" render - -o - <ball.scene");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("\x89PNG"));
  const ProgramResult config = run("\"$SDLC\" render - -o c.png --width 8 <config.json");
  EXPECT_EQ(config.exit_code, 0) << config.err;
}

TEST_F(RenderCommand, NeedsANameForAPictureOfStandardInput) {
  const ProgramResult result = run("\"$SDLC\" render - <ball.scene");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--stdin-filename"));
}

TEST_F(RenderCommand, LetsFlagsWinOverTheScene) {
  const ProgramResult result =
      run("\"$SDLC\" render ball.scene --width 20 --height 30 --samples 3 --depth 2 --seed 9 "
          "--threads 1 "
          "--progress none --stats s.json");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const auto stats = nlohmann::json::parse(content_of(folder_ / "s.json"));
  EXPECT_EQ(stats["width"], 20);
  EXPECT_EQ(stats["height"], 30);
  EXPECT_EQ(stats["samples"], 3);
  EXPECT_EQ(stats["depth"], 2);
  EXPECT_EQ(stats["seed"], 9);
  EXPECT_EQ(stats["threads"], 1);
  EXPECT_EQ(stats["camera_samples"], 20 * 30 * 3);
}

TEST_F(RenderCommand, KeepsTheAspectWithOneSideAlone) {
  EXPECT_EQ(run("\"$SDLC\" render ball.scene --width 100 -o w.png").exit_code, 0);
  EXPECT_EQ(render::read_picture(folder_ / "w.png").height, 56);
  EXPECT_EQ(run("\"$SDLC\" render ball.scene --height 90 -o h.png").exit_code, 0);
  EXPECT_EQ(render::read_picture(folder_ / "h.png").width, 160);
}

TEST_F(RenderCommand, WritesEveryFieldOfTheStatistics) {
  const ProgramResult result = run("\"$SDLC\" render ball.scene --quiet --stats -");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto stats = nlohmann::json::parse(result.out);
  for (const char* field : {"scene",
                            "spheres",
                            "width",
                            "height",
                            "samples",
                            "depth",
                            "seed",
                            "sampler",
                            "light_sampling",
                            "threads",
                            "instruction_set",
                            "precision",
                            "precision_bound",
                            "kernel",
                            "features",
                            "parse_seconds",
                            "lower_seconds",
                            "build_seconds",
                            "render_seconds",
                            "write_seconds",
                            "camera_samples",
                            "rays",
                            "samples_per_second",
                            "rays_per_second",
                            "peak_rss_bytes",
                            "render_rss_bytes",
                            "relative_error",
                            "relative_error_interval",
                            "truncated_paths",
                            "nonfinite_samples"}) {
    EXPECT_TRUE(stats.contains(field)) << field;
  }
  EXPECT_EQ(stats["spheres"], 1);
  EXPECT_EQ(stats["nonfinite_samples"], 0);
  EXPECT_EQ(stats["features"], (nlohmann::json{"gradient", "diffuse"}));
}

TEST_F(RenderCommand, UsesTheRequestedKernel) {
  if (render::available_vectors().empty()) GTEST_SKIP() << "this machine has no wide kernel";
  const auto stats = [&](const std::string& flags) {
    const ProgramResult result =
        run("\"$SDLC\" render ball.scene --overwrite --quiet --stats - " + flags);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out);
  };
  EXPECT_EQ(stats("--kernel scalar")["kernel"], "scalar");
  EXPECT_EQ(stats("--kernel scalar")["precision"], "double");
  EXPECT_EQ(stats("--kernel wide --precision double")["kernel"], "wide");
  EXPECT_EQ(stats("--precision double")["precision"], "double");
  EXPECT_EQ(stats("--precision float")["precision"], "float");
  for (const render::Backend* backend : render::available_vectors()) {
    const std::string name(backend->name);
    EXPECT_EQ(stats("--isa " + name)["instruction_set"], name);
    EXPECT_EQ(stats("--isa " + name)["kernel"], "wide");
  }
  const auto chosen = stats("");
  for (const char* flag : {"--kernel auto", "--precision auto", "--isa auto"}) {
    for (const char* field : {"kernel", "precision", "instruction_set"}) {
      EXPECT_EQ(stats(flag)[field], chosen[field]) << flag;
    }
  }
}

TEST_F(RenderCommand, RefusesAKernelThatCannotBeBeforeRendering) {
  const ProgramResult refused =
      run("\"$SDLC\" render ball.scene --kernel scalar --precision float");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err,
              HasSubstr("--precision: the scalar kernel computes in double; omit --precision\n"));
  const auto error = [&](const std::string& flags) {
    const ProgramResult result = run("\"$SDLC\" render ball.scene " + flags);
    EXPECT_EQ(result.exit_code, 2);
    return result.err;
  };
  write_text(folder_ / "sky.scene",
             "scene 1\ncamera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n");
  EXPECT_THAT(run("\"$SDLC\" render sky.scene --kernel wide").err,
              HasSubstr("--kernel: not with the wide kernels: no spheres"));
  write_text(folder_ / "sky.scene", std::string(kScene) +
                                        "for i in range(300) { sphere { center: (i, 9, 0), "
                                        "radius: 0.1, material: unlit(red) } }\n");
  EXPECT_THAT(
      run("\"$SDLC\" render sky.scene --kernel wide").err,
      testing::ContainsRegex("--kernel: not with more than [0-9]+ spheres; use --kernel bvh"));
  std::filesystem::remove(folder_ / "sky.scene");
  for (const render::Backend* backend : render::available_vectors()) {
    EXPECT_THAT(error("--kernel scalar --isa " + std::string(backend->name)),
                HasSubstr("--isa: the scalar kernel has no other instruction sets; omit --isa\n"));
  }
  for (const char* flag : {"--kernel", "--precision", "--isa"}) {
    const ProgramResult unknown =
        run(std::string("\"$SDLC\" render ball.scene ") + flag + " nonsense");
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_THAT(unknown.err, HasSubstr(flag));
  }
  EXPECT_THAT(names(), ElementsAre("ball.scene", "config.json"));
}

constexpr const char* kPlanet = R"(scene 1
camera main { from: (0, 1, 9e5), at: (0, 1, 0), fov: 0.01deg }
sphere moon { center: (0, 1, 0), radius: 1, material: diffuse(color: tan) }
sphere planet { center: (0, 1, -18), radius: 2, material: diffuse(color: gray) }
)";

TEST_F(RenderCommand, TakesThePrecisionThatTheSceneAsksForUnlessAFlagDoes) {
  const auto precision = [&](const std::string& render, const std::string& flags) {
    write_text(folder_ / "planet.scene", std::string(kPlanet) + render);
    const ProgramResult result =
        run("\"$SDLC\" render planet.scene --width 16 --samples 1 --overwrite --quiet --stats - " +
            flags);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out)["precision"].get<std::string>() +
           (result.err.empty() ? "" : ", with a warning");
  };
  EXPECT_EQ(precision("", ""), "double");
  EXPECT_EQ(precision("render { precision: auto }", ""), "double");
  EXPECT_EQ(precision("render { precision: float }", ""), "float, with a warning");
  EXPECT_EQ(precision("render { precision: float }", "--precision auto"), "double");
  EXPECT_EQ(precision("render { precision: double }", "--precision float"),
            "float, with a warning");
  // A precision in the scene is a preference: it is used if possible and sufficient.
  EXPECT_EQ(precision("render { precision: float }", "--kernel scalar"), "double");
}

TEST_F(RenderCommand, WarnsOfAPrecisionThatDoesNotResolveTheScene) {
  write_text(folder_ / "planet.scene", kPlanet);
  const ProgramResult result =
      run("\"$SDLC\" render planet.scene --width 16 --samples 1 --precision float --stats s.json");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(
      result.err,
      HasSubstr("warning[W501]: `float` does not resolve the scene: a hit is off by 1.34 of the "
                "smallest radius, where 0.01 is allowed\n --> planet.scene:3:1\n"));
  EXPECT_THAT(result.err, HasSubstr("the farthest"));
  const auto bound = nlohmann::json::parse(content_of(folder_ / "s.json"))["precision_bound"];
  EXPECT_EQ(bound["clause"], "hit");
  EXPECT_EQ(bound["limit"], 0.01);
  EXPECT_NEAR(bound["value"].get<double>(), 25 * 0x1p-24 * 900020, 1e-9);
  EXPECT_EQ(bound["sphere"], 0);
  EXPECT_EQ(bound["other"], 1);
}

// Whatever the scene requests: here pixels are too narrow for float, and even for double.
TEST_F(RenderCommand, WarnsOfThePrecisionThatIsTaken) {
  write_text(folder_ / "narrow.scene",
             "scene 1\ncamera main { from: (0, 0, 5), at: (0, 0, 0), fov: 1e-12deg }\n"
             "sphere ball { center: (0, 0, 0), radius: 1, material: unlit(red) }\n"
             "render { precision: float }\n");
  const auto messages = [&](const std::string& command, const std::string& flags) {
    return run("\"$SDLC\" " + command + " narrow.scene --format concise --quiet " + flags).err;
  };
  const std::string rendered = "render --width 16 --samples 1 --overwrite";
  for (const std::string& command : {rendered, std::string("inspect")}) {
    EXPECT_THAT(messages(command, ""),
                HasSubstr("narrow.scene:4:21: warning[W501]: `float` does not resolve"));
    for (const char* flags : {"--kernel scalar", "--precision auto"}) {
      const std::string told = messages(command, flags);
      EXPECT_THAT(told, HasSubstr("warning[W501]: `double` does not resolve")) << flags;
      EXPECT_THAT(told, Not(HasSubstr("narrow.scene:4:21"))) << "unused settings are not reported";
      EXPECT_THAT(told, Not(HasSubstr("`float`"))) << flags;
    }
  }
}

TEST_F(RenderCommand, PointsAtLightThatOverflows) {
  write_text(folder_ / "bright.scene",
             "scene 1\ncamera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n"
             "sphere ground { center: (0, -9, 0), radius: 9, material: diffuse(white * 1e30) }\n"
             "sphere lamp { center: (0, 2, 0), radius: 1, material: emissive(color: white, "
             "intensity: 1e300) }\n");
  const ProgramResult result =
      run("\"$SDLC\" render bright.scene --width 32 --samples 16 -o a.png");
  EXPECT_EQ(result.exit_code, 1) << "it is no defect of the program";
  EXPECT_THAT(result.err, HasSubstr("`double` does not resolve the scene: reflected light reaches "
                                    "inf, where 1e+300 is allowed\n --> bright.scene:4:1\n"));
  EXPECT_THAT(result.err, HasSubstr("------ what multiplies light most"));
  EXPECT_THAT(result.err, HasSubstr("use darker lights, and colors up to white"));
  EXPECT_THAT(result.err, HasSubstr("samples are not finite and were left out: colors or "
                                    "intensities are beyond the precision\n"));
}

TEST_F(RenderCommand, RefusesAScenePastDoubleUnlessItIsForced) {
  write_text(folder_ / "speck.scene", std::string(kScene) +
                                          "sphere { center: (0, 0, -1e13), radius: 1, material: "
                                          "diffuse(color: tan) }\n");
  const ProgramResult refused = run("\"$SDLC\" render speck.scene");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("error[E314]: the scene extends to 1e+13 times"));
  EXPECT_THAT(refused.err, HasSubstr("--precision double"));
  const ProgramResult forced = run("\"$SDLC\" render speck.scene --precision double");
  EXPECT_EQ(forced.exit_code, 0) << forced.err;
  EXPECT_THAT(forced.err, HasSubstr("warning[W501]: `double` does not resolve"));
}

TEST_F(RenderCommand, GivesTheSameFileForAnyNumberOfThreads) {
  EXPECT_EQ(run("\"$SDLC\" render ball.scene --threads 1 -o one.exr").exit_code, 0);
  EXPECT_EQ(run("\"$SDLC\" render ball.scene --threads 7 -o seven.exr").exit_code, 0);
  EXPECT_EQ(content_of(folder_ / "one.exr"), content_of(folder_ / "seven.exr"));
}

TEST_F(RenderCommand, ExitsWithOneWhenTheSceneHasErrors) {
  write_text(folder_ / "bad.scene", "scene 1\nsphere { center: (0, 0, 0), radus: 1 }\n");
  const ProgramResult result = run("\"$SDLC\" render bad.scene --format concise");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("bad.scene:2:29: error[E104]: "));
  EXPECT_THAT(result.err, HasSubstr("; did you mean radius?"));
  EXPECT_THAT(names(), ElementsAre("bad.scene", "ball.scene", "config.json"));
}

TEST_F(RenderCommand, ExitsWithTwoWhenTheSceneCannotBeRead) {
  const ProgramResult result = run("\"$SDLC\" render missing.scene");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("cannot read `missing.scene`: No such file"));
}

TEST_F(RenderCommand, RefusesAnUnknownExtensionBeforeRendering) {
  const ProgramResult result = run("\"$SDLC\" render ball.scene -o out.pgn --samples 100000000");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("did you mean `png`?"));
  EXPECT_THAT(names(), ElementsAre("ball.scene", "config.json"));
}

TEST_F(RenderCommand, RefusesAMissingFolderBeforeRendering) {
  const ProgramResult result =
      run("\"$SDLC\" render ball.scene -o no/such/out.png --samples 100000000");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("no/such/out.png"));
}

TEST_F(RenderCommand, RefusesAStatisticsFileThatCannotBeWrittenBeforeRendering) {
  const ProgramResult result =
      run("\"$SDLC\" render ball.scene --stats no/such/stats.json --samples 100000000");
  EXPECT_EQ(result.exit_code, 2);
}

TEST_F(RenderCommand, LeavesNoFilesWhenTheDiskIsFull) {
  // A limit on file sizes simulates a full disk: it also applies to root.
  const ProgramResult result =
      run("ulimit -f 1; \"$SDLC\" render ball.scene --width 200 -o big.ppm");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("cannot write `big.ppm`: "));
  EXPECT_THAT(names(), ElementsAre("ball.scene", "config.json"));
}

TEST_F(RenderCommand, KeepsExistingFilesWhenAskedTo) {
  write_text(folder_ / "ball.png", "mine");
  const ProgramResult result = run("\"$SDLC\" render ball.scene --no-clobber");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(content_of(folder_ / "ball.png"), "mine");
}

TEST_F(RenderCommand, SavesAPartialPictureWhenItIsInterrupted) {
  for (const std::string signal : {"INT", "TERM"}) {
    const std::string log = signal + ".log";
    // A shell starts background jobs with SIGINT ignored, which the program respects.
    const ProgramResult result =
        run("env --default-signal=INT \"$SDLC\" render ball.scene --width 2000 --samples 1000 "
            "--progress json "
            "-o out.png 2>" +
            log +
            " & pid=$!\n"
            "while kill -0 $pid && ! grep -qs '\"samples\": [1-9]' " +
            log +
            "; do sleep 0.1; done\n"
            "kill -" +
            signal + " $pid; wait $pid");
    EXPECT_EQ(result.exit_code, 130) << signal;
    EXPECT_THAT(content_of(folder_ / log), HasSubstr("saved as out.partial.png"));
    ASSERT_TRUE(std::filesystem::exists(folder_ / "out.partial.png"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.png"));
    const render::Picture picture = render::read_picture(folder_ / "out.partial.png");
    EXPECT_EQ(picture.width, 2000);
    EXPECT_GT(picture.at(0, 0).b, 0) << "the first tile is there";
    std::filesystem::remove(folder_ / "out.partial.png");
  }
}

TEST_F(RenderCommand, SuggestsTheIntendedFlag) {
  const ProgramResult flag = run("\"$SDLC\" render ball.scene --sample 3");
  EXPECT_EQ(flag.exit_code, 2);
  EXPECT_THAT(flag.err, HasSubstr("unknown flag `--sample` (did you mean `--samples`?)"));
  const ProgramResult word = run("\"$SDLC\" render ball.scene --tone sgrb");
  EXPECT_EQ(word.exit_code, 2);
  EXPECT_THAT(word.err, HasSubstr("did you mean `srgb`?"));
  EXPECT_THAT(run("\"$SDLC\" render ball.scene --width 60 --width 0").err,
              HasSubstr("--width: given 2 times; give it once\n"));
  EXPECT_THAT(run("\"$SDLC\" render ball.scene --frames 3-1").err,
              HasSubstr("with whole numbers, A at most B, not `3-1`\n"));
  const ProgramResult command = run("\"$SDLC\" rendr ball.scene");
  EXPECT_EQ(command.exit_code, 2);
  EXPECT_THAT(command.err, HasSubstr("did you mean `render`?"));
}

TEST_F(RenderCommand, RefusesNumbersOutOfRange) {
  for (const char* flags : {"--width 0", "--samples -1", "--depth 0", "--samples 1.5",
                            "--threads -2", "--seed -1", "--width 99999999999"}) {
    const ProgramResult result = run(std::string("\"$SDLC\" render ball.scene ") + flags);
    EXPECT_EQ(result.exit_code, 2) << flags;
    EXPECT_THAT(result.err, HasSubstr("error: ")) << flags;
  }
  EXPECT_THAT(names(), ElementsAre("ball.scene", "config.json"));
}

TEST_F(RenderCommand, TakesNumbersInDecimalDigitsOnly) {
  EXPECT_EQ(run("\"$SDLC\" render ball.scene --width 010 --height 9 -o w.ppm").exit_code, 0);
  EXPECT_EQ(render::read_picture(folder_ / "w.ppm").width, 10);
  for (const char* flags : {"--width 0x10", "--width 10.0", "--seed 18446744073709551616"}) {
    EXPECT_THAT(run(std::string("\"$SDLC\" render ball.scene ") + flags).err,
                HasSubstr("takes a whole number from"))
        << flags;
  }
}

TEST_F(RenderCommand, ProtectsEveryFileWithNoClobber) {
  write_text(folder_ / "stats.json", "mine");
  write_text(folder_ / "a.partial.png", "mine");
  std::filesystem::create_symlink("nowhere.png", folder_ / "link.png");
  for (const char* flags : {"-o new.png --stats stats.json", "-o a.png", "-o link.png"}) {
    const ProgramResult result =
        run(std::string("\"$SDLC\" render ball.scene --no-clobber ") + flags);
    EXPECT_EQ(result.exit_code, 2) << flags;
    EXPECT_THAT(result.err, HasSubstr("--no-clobber")) << flags;
  }
  EXPECT_EQ(content_of(folder_ / "stats.json"), "mine");
}

TEST_F(RenderCommand, RefusesTwoOutputsToOnePlace) {
  for (const char* flags : {"-o a.png -o ./a.png", "-o a.png --stats a.png", "-o - --stats -"}) {
    const ProgramResult result = run(std::string("\"$SDLC\" render ball.scene ") + flags);
    EXPECT_EQ(result.exit_code, 2) << flags;
    EXPECT_THAT(result.err, HasSubstr("two outputs go to")) << flags;
  }
}

TEST_F(RenderCommand, RefusesAPictureItsFormatCannotHoldBeforeRendering) {
  const ProgramResult result =
      run("\"$SDLC\" render ball.scene --width 70000 --height 60 --samples 100000000 -o w.jpg");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("65500"));
}

TEST_F(RenderCommand, LeavesNoFoldersWhenItRefuses) {
  std::string config = kConfig;
  const std::string path = "results/deep/picture.ppm";
  // The first two are errors of the config, the last one is a disk error.
  const std::pair<const char*, int> others[] = {
      {"new/sub/x.bmp", 1}, {"new/", 1}, {"config.json/x.png", 2}};
  for (const auto& [other, status] : others) {
    config = kConfig;
    config.replace(config.find(path), path.size(), other);
    write_text(folder_ / "config.json", config);
    EXPECT_EQ(run("\"$SDLC\" render config.json").exit_code, status) << other;
    EXPECT_THAT(names(), ElementsAre("ball.scene", "config.json")) << other;
  }
}

TEST_F(RenderCommand, NeverPrintsControlCharactersOfAScene) {
  std::string config = kConfig;
  const std::string path = "results/deep/picture.ppm";
  config.replace(config.find(path), path.size(), "\\u001b[31mx.bmp");
  write_text(folder_ / "config.json", config);
  const ProgramResult result = run("\"$SDLC\" render config.json");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, testing::Not(HasSubstr("\x1b")));
}

TEST_F(RenderCommand, ReportsThatStandardOutputCannotBeWritten) {
  EXPECT_EQ(run("\"$SDLC\" --help >&-").exit_code, 2);
  EXPECT_EQ(run("\"$SDLC\" render ball.scene --stats - >&-").exit_code, 2);
}

TEST_F(RenderCommand, ShowsExamplesInItsHelp) {
  const ProgramResult result = run("\"$SDLC\" render --help");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("Examples:"));
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(run("\"$SDLC\" --help").out, HasSubstr("render"));
  EXPECT_THAT(run("\"$SDLC\" --version").out, StartsWith("sdlc "));
}

}  // namespace
}  // namespace sdlc::test
