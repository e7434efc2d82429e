#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program_test.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;
using Json = nlohmann::json;

constexpr const char* kScene =
    "scene 1\n"
    "render { width: 48, height: 32 }\n"
    "camera { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg, shutter: 0s .. 0.5s }\n"
    "sphere { center: (0, -100.5, 0), radius: 100, material: diffuse(#888888) }\n"
    "sphere { center: (time / 1s, 0, 0), radius: 0.5, material: transmissive(#FFFFFF, ior: 1.5) }\n"
    "sphere { center: (1, 2, 1), radius: 0.1, material: emissive(#FFFFFF, 50) }\n";

class FilmCommand : public ProgramTest {
 protected:
  FilmCommand() {
    write("a.scene", kScene);
    write("film.scene", std::string(kScene) + "animation { frames: 1 .. 5, fps: 24 }\n");
  }

  Json stats(const std::string& name) const { return Json::parse(content(name)); }
  /// Renders all shards of a.scene as NAME1.film, …
  void render_shards(const std::string& name, int count, const std::string& flags) const {
    for (int i = 1; i <= count; ++i) {
      succeed(
          fmt::format("render a.scene {} --shard {}/{} -o {}{}.film", flags, i, count, name, i));
    }
  }
  /// Sends a signal to a render as soon as the film is there.
  ProgramResult stop_after_checkpoint(const std::string& signal, const std::string& arguments,
                                      const std::string& film) const {
    return shell(
        fmt::format("env --default-signal=INT \"$SDLC\" {} --checkpoint 10ms & pid=$!\n"
                    "until [ -e {} ] || ! kill -0 $pid; do sleep 0.01; done\n"
                    "kill -{} $pid\nwait $pid",
                    arguments, film, signal));
  }
};

TEST_F(FilmCommand, MergesToTheBytesOfOneMachineHoweverThePictureIsDivided) {
  struct Case {
    int shards;
    const char* flags;
  };
  const Case cases[]{
      {5, "--samples 1283 --shard-by samples --light-sampling on --aov normal,albedo"},
      {5, "--samples 1283 --shard-by tiles --light-sampling caustics --aov depth"},
      {7, "--samples 3 --width 31 --sampler independent"},
      {2, "--samples 512 --precision double --depth 4 --seed 9 --tone neutral --exposure 1.5"},
  };
  for (const Case& each : cases) {
    const bool has_variance = std::string(each.flags).find("--samples 3 ") == std::string::npos;
    const std::string aovs = has_variance ? " --aov variance,samples" : "";
    succeed(fmt::format("render a.scene {}{} -o a.exr -o a.png -o a.film --stats a.json",
                        each.flags, aovs));
    render_shards("p", each.shards, each.flags);
    const std::string channels = std::string(each.flags).find("normal") != std::string::npos
                                     ? " --aov normal,albedo"
                                 : std::string(each.flags).find("depth") != std::string::npos &&
                                         has_variance && each.shards == 5
                                     ? " --aov depth"
                                     : "";
    succeed(fmt::format("merge p*.film --expect {}{}{} -o m.exr -o m.png -o m.film --stats m.json",
                        each.shards, channels, aovs));
    expect_same("a.exr", "m.exr");
    expect_same("a.png", "m.png");
    expect_same("a.film", "m.film");
    const Json one = stats("a.json"), merged = stats("m.json");
    for (const auto& [name, value] : merged.items()) {
      if (!value.is_null()) EXPECT_EQ(value, one.at(name)) << name;
    }
    for (const char* name : {"rays", "camera_samples", "relative_error", "samples", "features"}) {
      EXPECT_TRUE(merged.contains(name)) << name;
    }
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      if (entry.path().extension() == ".film") fs::remove(entry.path());
    }
  }
}

TEST_F(FilmCommand, MergesPartsOfParts) {
  succeed("render a.scene --samples 700 -o a.png");
  render_shards("p", 5, "--samples 700 --shard-by tiles");
  succeed("merge p1.film p5.film -o x.film");
  succeed("merge p3.film p2.film -o y.film");
  succeed("merge y.film x.film -o z.film");
  EXPECT_THAT(failure(75, "merge z.film -o z.png"),
              HasSubstr("1 of 5 shards is missing or not finished: 4; the partial picture was "
                        "saved as z.partial.png"));
  EXPECT_THAT(failure(75, "merge z.film -o w.film --expect 5"), HasSubstr("finished: 4"));
  EXPECT_FALSE(exists("w.film"));
  succeed("merge z.film p4.film -o z.png --expect 5");
  expect_same("a.png", "z.png");
}

TEST_F(FilmCommand, NamesFilmsThatCannotBeMerged) {
  render_shards("p", 2, "--samples 16");
  succeed("render a.scene --samples 16 --seed 3 --shard 2/2 -o seed.film");
  fs::copy_file(folder_ / "p1.film", folder_ / "copy.film");
  std::string damaged = content("p2.film");
  damaged[damaged.size() / 2] ^= 1;
  write("damaged.film", damaged);
  EXPECT_THAT(failure(1, "merge p1.film copy.film p2.film -o a.png"),
              HasSubstr("`copy.film`: it has shard 1, as `p1.film` has"));
  EXPECT_THAT(failure(1, "merge p1.film seed.film -o a.png"),
              HasSubstr("`seed.film`: the film is of another picture: `seed` is 3, not 0"));
  EXPECT_THAT(failure(1, "merge p1.film damaged.film -o a.png"),
              HasSubstr("`damaged.film`: the file is damaged: a checksum is wrong"));
  EXPECT_THAT(failure(1, "merge p1.film a.scene -o a.png"),
              HasSubstr("`a.scene`: the file is not a film"));
  EXPECT_THAT(failure(2, "merge p1.film gone.film -o a.png"), HasSubstr("gone.film"));
  EXPECT_THAT(failure(1, "merge p1.film p2.film --expect 3 -o a.png"), HasSubstr("of 2, not of 3"));
  EXPECT_THAT(failure(2, "merge p1.film p2.film -o p1.film"), HasSubstr("is an input file"));
  EXPECT_THAT(failure(2, "merge p1.film p2.film -o a.exr --aov normal"),
              HasSubstr("render them with the same --aov"));
  EXPECT_FALSE(exists("a.png") || exists("a.partial.png"));
}

TEST_F(FilmCommand, MergesFrameByFrame) {
  succeed("render film.scene --frames 2-3 --samples 16 -o a.####.png");
  for (const char* shard : {"1", "2"}) {
    succeed(
        fmt::format("render film.scene --frames 2-3 --samples 16 --shard {0}/2 --shard-by tiles "
                    "-o p{0}.####.film",
                    shard));
  }
  EXPECT_THAT(failure(2, "merge p*.film -o m.png"), HasSubstr("2 frames"));
  succeed("merge p*.film -o m.####.png --expect 2");
  expect_same("a.0002.png", "m.0002.png");
  expect_same("a.0003.png", "m.0003.png");
}

TEST_F(FilmCommand, IsInspected) {
  succeed("render film.scene --frames 2 --samples 16 --shard 2/3 --shard-by tiles -o a.film");
  const Json film = Json::parse(sdlc("inspect a.film --format json").out);
  EXPECT_EQ(film.at("frame"), 2);
  EXPECT_EQ(film.at("scene"), "film.scene");
  EXPECT_EQ(film.at("finished_shards"), Json({2}));
  EXPECT_EQ(film.at("missing_shards"), Json({1, 3}));
  EXPECT_EQ(film.at("camera_samples"), 48 * 32 / 3 * 16);
  const ProgramResult text = sdlc("inspect a.film");
  EXPECT_THAT(text.out, HasSubstr("shards      1 of 3 of the tiles: 2\n"));
  EXPECT_THAT(text.out, HasSubstr("film.scene, frame 2\n"));
  write("b.film", "no film");
  EXPECT_THAT(failure(1, "inspect b.film"), HasSubstr("not a film"));
  EXPECT_THAT(failure(2, "render a.film -o a.png"), HasSubstr("sdlc merge a.film -o NAME.png"));
  EXPECT_THAT(failure(2, "render a.scene --zoom 2 -o z.film"), HasSubstr("--zoom"));
}

TEST_F(FilmCommand, DividesFramesAmongShards) {
  succeed("render film.scene --samples 8 -o a.####.png");
  for (const char* shard : {"1", "2", "3"}) {
    succeed(fmt::format("render film.scene --samples 8 --shard {}/3 -o b.####.png", shard));
  }
  for (int frame = 1; frame <= 5; ++frame) {
    expect_same(fmt::format("a.000{}.png", frame), fmt::format("b.000{}.png", frame));
  }
  EXPECT_THAT(failure(2, "render film.scene --shard 1/6 --shard-by frames -o c.####.png"),
              HasSubstr("fewer frames than 6 shards"));
}

TEST_F(FilmCommand, RefusesShardsThatCannotBe) {
  EXPECT_THAT(failure(2, "render a.scene --shard 1/2 -o a.png"), HasSubstr("use -o NAME.film"));
  EXPECT_THAT(failure(2, "render a.scene --shard 1/2"), HasSubstr("use -o NAME.film"));
  EXPECT_THAT(failure(2, "render a.scene --shard 1/2 --error 5% -o a.film"), HasSubstr("--error"));
  EXPECT_THAT(failure(2, "render a.scene --shard 1/2 --time 1s -o a.film"), HasSubstr("--time"));
  EXPECT_THAT(failure(2, "render a.scene --shard 1/2 --denoise -o a.film"), HasSubstr("--denoise"));
  EXPECT_THAT(failure(2, "render a.scene --shard 1/2 --shard-by frames -o a.film"),
              HasSubstr("no `animation`"));
  EXPECT_THAT(failure(2, "render a.scene --samples 512 --shard 1/4 --shard-by samples -o a.film"),
              HasSubstr("512 samples can be divided into at most 2 shards; use --shard-by tiles"));
  for (const char* text : {"0/2", "3/2", "1", "1/0", "a/2", "1/2/3", "-1/2"}) {
    EXPECT_THAT(failure(2, fmt::format("render a.scene --shard={} -o a.film", text)),
                HasSubstr("--shard"))
        << text;
  }
  EXPECT_FALSE(exists("a.film"));
}

TEST_F(FilmCommand, GoesOnFromAFilmToTheSameBytes) {
  succeed("render a.scene --samples 400 -o a.exr --stats a.json");
  succeed("render a.scene --samples 100 -o b.film");
  succeed("render a.scene --samples 400 -o b.film -o b.exr --resume --stats b.json");
  expect_same("a.exr", "b.exr");
  EXPECT_EQ(stats("a.json").at("rays"), stats("b.json").at("rays"));
  EXPECT_EQ(stats("a.json").at("camera_samples"), stats("b.json").at("camera_samples"));

  succeed("render a.scene --error 12% -o a.exr");
  succeed("render a.scene --error 30% -o c.film");
  succeed("render a.scene --error 12% -o c.film -o c.exr --resume");
  expect_same("a.exr", "c.exr");
  succeed("merge c.film -o d.exr");
  expect_same("a.exr", "d.exr");
}

TEST_F(FilmCommand, IsNotContinuedForAnotherPicture) {
  succeed("render a.scene --samples 32 -o a.film");
  const auto refusal = [&](const std::string& arguments) {
    return failure(1, "render " + arguments + " -o a.film -o a.png --resume");
  };
  const std::string text = kScene;
  write("b.scene", text + "sphere { center: (0, 1, 0), radius: 0.1, material: diffuse(red) }\n");
  EXPECT_THAT(refusal("b.scene --samples 32"), HasSubstr("it differs in `spheres`"));
  write("b.scene", std::string(text).replace(text.find("40deg"), 5, "41deg"));
  EXPECT_THAT(refusal("b.scene --samples 32"), HasSubstr("it differs in `camera`"));
  EXPECT_THAT(refusal("a.scene --samples 32 --seed 1"), HasSubstr("`seed` is 0, not 1"));
  EXPECT_THAT(refusal("a.scene --samples 32 --width 24"), HasSubstr("`width` is 48, not 24"));
  EXPECT_THAT(refusal("a.scene --samples 16"), HasSubstr("it has 32 samples per pixel, more than"));
  EXPECT_THAT(failure(1, "render a.scene --samples 32 --shard 1/2 -o a.film --resume"),
              HasSubstr("it is divided into other shards"));
  write("a.film", "no film");
  EXPECT_THAT(
      refusal("a.scene --samples 32"),
      HasSubstr("the file is not a film; remove the film, or omit --resume, to begin again"));
  EXPECT_FALSE(exists("a.png"));
}

TEST_F(FilmCommand, IsTheCheckpointOnlyUntilThePictureIsThere) {
  succeed("render a.scene --samples 32 -o a.png --checkpoint 1s");
  EXPECT_FALSE(exists("a.film"));
  succeed("render a.scene --samples 16 -o a.film");
  EXPECT_THAT(failure(2, "render a.scene --samples 32 -o a.png --checkpoint 1s"),
              HasSubstr("`a.film` exists; use --resume"));
  EXPECT_TRUE(exists("a.film"));
  succeed("render a.scene --samples 32 -o b.png --resume");
  succeed("render a.scene --samples 32 -o a.png --resume");
  expect_same("a.png", "b.png");
  EXPECT_TRUE(exists("a.film")) << "it is no checkpoint: -o a.film has kept it";
  EXPECT_THAT(failure(2, "render a.scene -o - --checkpoint 1s"), HasSubstr("require a file"));
}

TEST_F(FilmCommand, IsKeptIfThePictureCannotBeWritten) {
  fs::create_symlink("/dev/full", folder_ / "a.png");
  failure(75, "render a.scene --samples 32 -o a.png --checkpoint 1s");
  EXPECT_TRUE(exists("a.film"));
}

// The moments of the kills differ from run to run; the picture does not.
TEST_F(FilmCommand, HasTheSamePictureAfterKills) {
  const std::string flags = "render a.scene --width 240 --samples 900 ";
  succeed(flags + "-o a.exr");
  int kills = 0;
  for (int attempt = 1; attempt <= 12; ++attempt) {
    const ProgramResult result =
        shell(fmt::format("timeout -s KILL {} \"$SDLC\" {} -o b.exr --checkpoint 10ms --resume",
                          0.03 * attempt, flags));
    if (result.exit_code == 0) break;
    EXPECT_EQ(result.exit_code, 137) << result.err;
    ++kills;
  }
  EXPECT_GT(kills, 0);
  succeed(flags + "-o b.exr --resume");
  expect_same("a.exr", "b.exr");
}

TEST_F(FilmCommand, GoesOnAfterAnInterruption) {
  const std::string flags = "render a.scene --width 120 --samples 8000 ";
  succeed(flags + "-o a.exr");
  const ProgramResult result = stop_after_checkpoint("INT", flags + "-o b.exr", "b.film");
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("--resume goes on from b.film"));
  EXPECT_TRUE(exists("b.film") && exists("b.partial.exr"));
  succeed(flags + "-o b.exr --resume");
  expect_same("a.exr", "b.exr");
  EXPECT_FALSE(exists("b.film"));
}

TEST_F(FilmCommand, OfAShardIsContinued) {
  const std::string flags = "render a.scene --width 120 --samples 8000 --shard 2/3 ";
  succeed(flags + "-o a.film");
  EXPECT_EQ(stop_after_checkpoint("KILL", flags + "-o b.film", "b.film").exit_code, 137);
  EXPECT_THAT(failure(75, "merge b.film -o b.png"), HasSubstr("not finished: b.film"));
  EXPECT_THAT(failure(2, flags + "-o b.film --checkpoint 1s"),
              HasSubstr("`b.film` exists and is not finished; use --resume"));
  succeed(flags + "-o b.film --resume --skip-existing");
  expect_same("a.film", "b.film");
  EXPECT_THAT(sdlc(flags + "-o b.film --skip-existing").err, HasSubstr("is there already"));
}

}  // namespace
}  // namespace sdlc::test
