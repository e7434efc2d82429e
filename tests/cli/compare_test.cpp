#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "render/compare/color_map.hpp"
#include "render/image/image.hpp"
#include "tests/cli/gradient_picture.hpp"
#include "tests/support/oiio_file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

using Json = nlohmann::json;
using render::ImageFormat;
using render::LinearRgb;
using render::Picture;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

class CompareCommand : public testing::Test {
 protected:
  void write(const std::string& name, const Picture& picture,
             render::Tone tone = render::Tone::Srgb,
             const std::vector<std::pair<std::string, std::string>>& entries = {}) {
    render::write_picture(folder_ / name, picture,
                          {.format = render::image_format_of(name).value(),
                           .mapping = {.tone = tone},
                           .metadata = {.entries = entries}});
  }
  /// Both with a constant variance of that size.
  void write_noisy(const std::string& name, const Picture& picture, float variance) {
    std::vector<render::Layer> layers;
    for (const char* channel : {"variance.R", "variance.G", "variance.B"}) {
      layers.push_back({channel, std::vector<float>(picture.pixels.size(), variance)});
    }
    render::write_picture(folder_ / name, picture, {.format = ImageFormat::Exr, .layers = layers});
  }
  ProgramResult run(const std::string& command) { return run_shell(folder_.path(), command); }
  ProgramResult compare(const std::string& arguments) {
    return run("\"$SDLC\" compare " + arguments);
  }
  Json json(const std::string& arguments) {
    return Json::parse(compare(arguments + " --format json").out);
  }

  TemporaryFolder folder_;
};

TEST_F(CompareCommand, MeasuresLinearRadianceInLinearFiles) {
  const Picture reference(10, 10, LinearRgb(0.5));
  Picture picture = reference;
  picture.at(3, 7).g = 0.75;
  write("a.exr", picture);
  write("b.exr", reference);
  const Json report = json("a.exr b.exr");
  EXPECT_EQ(report["a"], "a.exr");
  EXPECT_EQ(report["b"], "b.exr");
  EXPECT_EQ(report["width"], 10);
  EXPECT_EQ(report["height"], 10);
  EXPECT_EQ(report["values"], "linear radiance");
  const double rmse = 0.25 / std::sqrt(300);
  EXPECT_DOUBLE_EQ(report["rmse"], rmse);
  EXPECT_DOUBLE_EQ(report["relative_error"], rmse / 0.5);
  EXPECT_DOUBLE_EQ(report["relative_mse"], 0.0625 / 0.26 / 300);
  EXPECT_EQ(report["relative_mse_trimmed"], 0) << "the one pixel of a hundred is left out";
  EXPECT_DOUBLE_EQ(report["psnr"], -20 * std::log10(rmse));
  EXPECT_GT(report["flip"], 0);
  EXPECT_EQ(report["max_difference"],
            (Json{{"value", 0.25}, {"x", 3}, {"y", 7}, {"channel", "green"}}));
  EXPECT_EQ(report["z_test"], nullptr);
  EXPECT_THAT(report["gates"], IsEmpty());
  EXPECT_THAT(report["notes"], IsEmpty());
  EXPECT_EQ(report["output"], nullptr);
}

TEST_F(CompareCommand, MeasuresCodesAsSharesOfWhite) {
  write("a.png", Picture(4, 4, LinearRgb(1)));
  write("b.tiff", Picture(4, 4, LinearRgb(0)));
  const Json report = json("a.png b.tiff");
  EXPECT_EQ(report["values"], "codes / 255");
  EXPECT_EQ(report["rmse"], 1);
  EXPECT_EQ(report["relative_error"], nullptr) << "the reference is black";
  EXPECT_EQ(report["psnr"], 0);
}

TEST_F(CompareCommand, PrintsTheSameForPeople) {
  write("a.exr", Picture(10, 10, LinearRgb(0.6)));
  write("b.exr", Picture(10, 10, LinearRgb(0.5)));
  const ProgramResult result = compare("a.exr b.exr");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, StartsWith("a.exr against b.exr: 10 x 10 pixels, linear radiance\n"));
  for (const char* line :
       {"  RMSE                 0.1\n",
        "  relative error       20 %          RMSE / mean of the reference\n",
        "  relative MSE         0.03846\n", "  PSNR                 20 dB         peak 1\n",
        "mean, at 67.02 pixels per degree\n",
        "  largest difference   0.1           at (0, 0), red\n",
        "descriptive: without the worst 1 % of pixels\n"}) {
    EXPECT_THAT(result.out, HasSubstr(line));
  }
}

TEST_F(CompareCommand, HasAFormOfOneLine) {
  write("a.exr", Picture(10, 10, LinearRgb(0.6)));
  write("b.exr", Picture(10, 10, LinearRgb(0.5)));
  EXPECT_THAT(compare("a.exr b.exr --format concise").out,
              MatchesRegex("rmse=0.1 relative_error=0.2 relative_mse=0.038[0-9]* "
                           "relative_mse_trimmed=0.038[0-9]* psnr=20 flip=[0-9.]* "
                           "max_difference=0.1\n"));
}

TEST_F(CompareCommand, FindsNoDifferenceBetweenAFileAndItself) {
  write("a.png", gradient());
  const Json report = json("a.png a.png");
  EXPECT_EQ(report["rmse"], 0);
  EXPECT_EQ(report["flip"], 0);
  EXPECT_EQ(report["psnr"], nullptr);
  EXPECT_EQ(report["max_difference"]["value"], 0);
  EXPECT_EQ(compare("a.png a.png --max-difference 0 --min-psnr 200").exit_code, 0);
}

TEST_F(CompareCommand, ComparesFormatsOfOneKind) {
  write("a.png", gradient());
  write("b.webp", gradient());
  write("c.ppm", gradient());
  EXPECT_LT(json("b.webp a.png")["max_difference"]["value"], 0.2);
  EXPECT_EQ(json("c.ppm a.png")["rmse"], 0);
  write("a.exr", Picture(4, 4, LinearRgb(0.5)));
  write("b.hdr", Picture(4, 4, LinearRgb(0.5)));
  EXPECT_EQ(json("b.hdr a.exr")["rmse"], 0);
}

// FLIP compares radiance: two files of one picture with different curves look the same.
TEST_F(CompareCommand, DecodesCodesForFlipByTheTone) {
  const Picture bright(16, 16, LinearRgb(0.5)), dark(16, 16, LinearRgb(0.1));
  write("a.exr", bright);
  write("b.exr", dark);
  const double expected = json("a.exr b.exr")["flip"];
  for (const render::Tone tone : {render::Tone::Srgb, render::Tone::Sqrt, render::Tone::Linear}) {
    const std::string name(name_of(tone));
    write("a.png", bright, tone, {{"sdlc:tone", name}});
    write("b.png", dark, tone, {{"sdlc:tone", name}});
    // The codes are rounded.
    EXPECT_NEAR(json("a.png b.png")["flip"], expected, 0.02) << name;
  }
}

// A viewer sees the compressed highlights, so FLIP does not undo the compression.
TEST_F(CompareCommand, ComparesNeutralPicturesForFlipAsTheyAreShown) {
  const LinearRgb sun(20, 10, 5), lamp(4, 2, 1);
  write("a.png", Picture(16, 16, sun), render::Tone::Neutral, {{"sdlc:tone", "neutral"}});
  write("b.png", Picture(16, 16, lamp), render::Tone::Neutral, {{"sdlc:tone", "neutral"}});
  write("a.exr", Picture(16, 16, render::compress_neutrally(sun)));
  write("b.exr", Picture(16, 16, render::compress_neutrally(lamp)));
  const double shown = json("a.exr b.exr")["flip"];
  EXPECT_GT(shown, 0.05);
  EXPECT_NEAR(json("a.png b.png")["flip"], shown, 0.02);
}

TEST_F(CompareCommand, RefusesPicturesOfDifferentExposures) {
  write("a.png", gradient(), render::Tone::Srgb, {{"sdlc:tone", "srgb"}});
  write("b.png", gradient(), render::Tone::Srgb, {{"sdlc:tone", "srgb"}, {"sdlc:exposure", "1.5"}});
  write("c.png", gradient(), render::Tone::Neutral,
        {{"sdlc:tone", "neutral"}, {"sdlc:exposure", "1.5"}});
  EXPECT_EQ(compare("b.png b.png").exit_code, 0);
  const ProgramResult exposures = compare("a.png b.png");
  EXPECT_EQ(exposures.exit_code, 2);
  EXPECT_THAT(exposures.err,
              HasSubstr("`a.png` has codes of the tone srgb and `b.png` of srgb with exposure 1.5; "
                        "render one of them with the other's --exposure, or compare .exr files"));
  EXPECT_THAT(compare("b.png c.png").err, HasSubstr("the other's --tone, or"));
  EXPECT_THAT(compare("a.png c.png").err, HasSubstr("the other's --tone and --exposure, or"));
}

TEST_F(CompareCommand, KnowsTheExposureThatRenderRecords) {
  std::ofstream(folder_ / "a.scene") << "scene 1\nbackground { color: #336699 }\n"
                                        "render { width: 4, height: 4, exposure: 0.5 }\n";
  const std::string render = "\"$SDLC\" render a.scene --quiet ";
  EXPECT_EQ(run(render + "-o a.png").err, "");
  EXPECT_EQ(run(render + "-o flag.png --exposure -1").err, "");
  EXPECT_EQ(run(render + "-o zero.png --exposure 0").err, "");
  EXPECT_THAT(compare("a.png flag.png").err,
              HasSubstr("srgb with exposure 0.5 and `flag.png` of srgb with exposure -1;"));
  EXPECT_THAT(content_of(folder_ / "zero.png"), Not(HasSubstr("sdlc:exposure")));
  EXPECT_EQ(run(render + "-o a.exr && " + render + "-o flag.exr --exposure -1").err, "");
  EXPECT_EQ(content_of(folder_ / "a.exr"), content_of(folder_ / "flag.exr"));
}

TEST_F(CompareCommand, TakesAnUntoldToneForThatOfTheOther) {
  write("a.png", gradient(), render::Tone::Sqrt, {{"sdlc:tone", "sqrt"}});
  write("b.tiff", gradient(), render::Tone::Sqrt);
  EXPECT_THAT(json("a.png b.tiff")["notes"],
              ElementsAre("b.tiff does not record its tone; assuming that of the other, sqrt"));
}

TEST_F(CompareCommand, NamesChannelsThatItDoesNotCompare) {
  write_oiio_file(folder_ / "a.exr", {float_spec(4, 4, {"R", "G", "B", "A", "Z"})});
  write_oiio_file(folder_ / "b.exr", {float_spec(4, 4, {"R", "G", "B"})});
  EXPECT_THAT(json("a.exr b.exr")["notes"], ElementsAre("not compared: A, Z of a.exr"));
}

TEST_F(CompareCommand, CallsGreyGrey) {
  OIIO::ImageSpec spec = float_spec(4, 4, {"Y"});
  spec.format = OIIO::TypeDesc::UINT8;
  write_oiio_file(folder_ / "a.png", {spec}, 0.5F);
  write_oiio_file(folder_ / "b.png", {spec}, 0.6F);
  EXPECT_EQ(json("a.png b.png")["max_difference"]["channel"], "grey");
}

TEST_F(CompareCommand, SeesLessFromFartherAway) {
  // Fine noise, which blurs to grey.
  Picture noise(64, 64);
  for (int i = 0; i < 64 * 64; ++i) noise.at(i % 64, i / 64) = LinearRgb(i * i % 97 / 97.0);
  write("a.exr", noise);
  write("b.exr", Picture(64, 64, LinearRgb(0.5)));
  EXPECT_LT(json("a.exr b.exr --pixels-per-degree 200")["flip"],
            0.5 * json("a.exr b.exr --pixels-per-degree 20")["flip"].get<double>());
  EXPECT_THAT(compare("a.exr b.exr --pixels-per-degree 0.5").err,
              HasSubstr("takes a number from 1 on"));
  EXPECT_EQ(compare("a.exr b.exr --pixels-per-degree 2000").exit_code, 2);
}

struct GateCase {
  const char* name;
  const char* passes;
  const char* breaks;
  const char* told;
};

class CompareGate : public CompareCommand, public testing::WithParamInterface<GateCase> {};
INSTANTIATE_TEST_SUITE_P(
    Compare, CompareGate,
    testing::Values(
        GateCase{"Rmse", "--max-rmse 0.11", "--max-rmse 0.09",
                 "error: the RMSE is 0.1, more than the 0.09 of --max-rmse\n"},
        GateCase{"RelativeError", "--max-relative-error 21%", "--max-relative-error 0.19",
                 "error: the relative error is 0.2, more than the 0.19 of --max-relative-error\n"},
        GateCase{"RelativeErrorAboveOne", "--max-relative-error 250%", "--max-relative-error 0.19",
                 "of --max-relative-error\n"},
        GateCase{"RelativeMse", "--max-relative-mse 0.04", "--max-relative-mse 0.03",
                 "of --max-relative-mse\n"},
        GateCase{"Flip", "--max-flip 1", "--max-flip 0.01", "of --max-flip\n"},
        GateCase{"Difference", "--max-difference 0.11", "--max-difference 0",
                 "error: the largest difference is 0.1, more than the 0 of --max-difference\n"},
        GateCase{"Psnr", "--min-psnr 19.9", "--min-psnr 20.1",
                 "error: the PSNR is 20, less than the 20.1 of --min-psnr\n"},
        GateCase{"PsnrBelowZero", "--min-psnr -3", "--min-psnr 20.1", "of --min-psnr\n"},
        GateCase{"Z", "--max-z 40", "--max-z 10", "of --max-z\n"}),
    [](const auto& gate) { return gate.param.name; });

TEST_P(CompareGate, EndsTheCommandWithOneWhereItIsBroken) {
  const auto& [name, passes, breaks, told] = GetParam();
  // The difference is negative, so its magnitude counts.
  write_noisy("a.exr", Picture(10, 10, LinearRgb(0.4)), 0.001F);
  write_noisy("b.exr", Picture(10, 10, LinearRgb(0.5)), 0.001F);
  const ProgramResult passed = compare(std::string("a.exr b.exr ") + passes);
  EXPECT_EQ(passed.exit_code, 0);
  EXPECT_EQ(passed.err, "");
  const ProgramResult broken = compare(std::string("a.exr b.exr ") + breaks);
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_THAT(broken.err, HasSubstr(told));
  EXPECT_THAT(broken.out, StartsWith("a.exr against b.exr")) << "the report is printed anyway";
  const Json gates = json(std::string("a.exr b.exr ") + breaks)["gates"];
  ASSERT_EQ(gates.size(), 1u);
  EXPECT_EQ(gates[0]["passed"], false);
  EXPECT_THAT(breaks, HasSubstr(gates[0]["name"].get<std::string>()));
}

TEST_F(CompareCommand, ReportsEachGateThatFails) {
  write("a.exr", Picture(10, 10, LinearRgb(0.6)));
  write("b.exr", Picture(10, 10, LinearRgb(0.5)));
  const ProgramResult result =
      compare("a.exr b.exr --max-rmse 0.01 --max-flip 1 --min-psnr 90 --quiet");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(std::ranges::count(result.err, '\n'), 2) << result.err;
  EXPECT_EQ(result.out, "");
}

TEST_F(CompareCommand, PassesAGateAtItsLimit) {
  write("a.exr", Picture(10, 10, LinearRgb(0.75)));
  write("b.exr", Picture(10, 10, LinearRgb(0.5)));
  EXPECT_EQ(compare("a.exr b.exr --max-rmse 0.25 --max-difference 0.25").exit_code, 0);
}

TEST_F(CompareCommand, NeedsAVarianceForAGateOnZ) {
  write("a.exr", gradient());
  write_noisy("b.exr", gradient(), 1);
  const ProgramResult result = compare("a.exr b.exr --max-z 4");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(
      result.err,
      HasSubstr("--max-z needs two .exr files with a variance, from `sdlc render --aov variance`"));
  EXPECT_THAT(json("a.exr b.exr")["notes"], ElementsAre("no z-test: a.exr has no variance"));
}

TEST_F(CompareCommand, RefusesLimitsThatAreNoNumbers) {
  write("a.exr", gradient());
  for (const char* limit : {"x", "''", "-1", "nan", "inf", "1e999", "0,5", "0.5x", "0x1"}) {
    const ProgramResult result = compare(std::string("a.exr a.exr --max-rmse ") + limit);
    EXPECT_EQ(result.exit_code, 2) << limit;
    EXPECT_THAT(result.err, HasSubstr("--max-rmse")) << limit;
  }
  EXPECT_THAT(compare("a.exr a.exr --max-fip 1").err, HasSubstr("did you mean `--max-flip`?"));
}

TEST_F(CompareCommand, ShowsTheDifferenceInColours) {
  const Picture reference(3, 1, LinearRgb(0.5));
  Picture picture = reference;
  picture.at(1, 0) = LinearRgb(0.75);
  picture.at(2, 0) = LinearRgb(0);
  write("a.exr", picture);
  write("b.exr", reference);
  const Json output = json("a.exr b.exr -o d.png")["output"];
  EXPECT_EQ(output, (Json{{"path", "d.png"}, {"what", "difference"}, {"top", 0.5}}));
  const auto code = [](double share) {
    const LinearRgb c = render::mapped_color(share);
    return LinearRgb(to_code8(render::Tone::Srgb, c.r), to_code8(render::Tone::Srgb, c.g),
                     to_code8(render::Tone::Srgb, c.b)) /
           255;
  };
  Picture shown = render::read_picture(folder_ / "d.png");
  EXPECT_EQ(shown.at(0, 0), code(0));
  EXPECT_EQ(shown.at(1, 0), code(0.5));
  EXPECT_EQ(shown.at(2, 0), code(1));
  EXPECT_EQ(json("a.exr b.exr -o d.png --top 1")["output"]["top"], 1);
  shown = render::read_picture(folder_ / "d.png");
  EXPECT_EQ(shown.at(1, 0), code(0.25));
  EXPECT_EQ(shown.at(2, 0), code(0.5));
}

TEST_F(CompareCommand, WritesTheSignedDifferenceToExr) {
  write("a.exr", Picture(2, 2, {0.25, 0.5, 1}));
  write("b.exr", Picture(2, 2, {0.5, 0.5, 0.5}));
  EXPECT_EQ(compare("a.exr b.exr -o d.exr").exit_code, 0);
  EXPECT_EQ(render::read_picture(folder_ / "d.exr").at(1, 1), LinearRgb(-0.25, 0, 0.5));
}

TEST_F(CompareCommand, ShowsTheFlipMap) {
  Picture picture = gradient(40, 40);
  picture.at(20, 20) = LinearRgb(0);
  write("a.exr", picture);
  write("b.exr", gradient(40, 40));
  EXPECT_EQ(json("a.exr b.exr -o d.png --what flip")["output"],
            (Json{{"path", "d.png"}, {"what", "flip"}, {"top", 1}}));
  const double mean = json("a.exr b.exr -o d.exr --what flip")["flip"];
  const Picture map = render::read_picture(folder_ / "d.exr");
  EXPECT_GT(map.at(20, 20).r, 0.1);
  EXPECT_EQ(map.at(20, 20).r, map.at(20, 20).b);
  EXPECT_EQ(map.at(0, 0).r, 0);
  double sum = 0;
  for (const LinearRgb c : map.pixels) sum += c.g;
  EXPECT_NEAR(sum / 1600, mean, 1e-9);
}

TEST_F(CompareCommand, ShowsTheDifferenceBesideABrokenGate) {
  write("a.exr", Picture(2, 2, LinearRgb(1)));
  write("b.exr", Picture(2, 2, LinearRgb(0)));
  EXPECT_EQ(compare("a.exr b.exr -o d.png --max-rmse 0.1").exit_code, 1);
  EXPECT_THAT(names_in(folder_.path()), ElementsAre("a.exr", "b.exr", "d.png"));
}

TEST_F(CompareCommand, RefusesOutputsThatCannotBe) {
  write("a.exr", gradient());
  write("b.exr", gradient());
  run("ln -s a.exr link.exr");
  const auto refusal = [&](const std::string& flags) {
    const ProgramResult result = compare("a.exr b.exr " + flags);
    EXPECT_EQ(result.exit_code, 2) << flags;
    EXPECT_EQ(result.out, "") << flags;
    return result.err;
  };
  const std::string before = content_of(folder_ / "a.exr");
  for (const char* name : {"a.exr", "./b.exr", "link.exr"}) {
    EXPECT_THAT(refusal(std::string("-o ") + name),
                HasSubstr("it is one of the pictures to compare"));
  }
  EXPECT_EQ(content_of(folder_ / "a.exr"), before);
  EXPECT_THAT(refusal("-o d.hdr"), HasSubstr("cannot store negative values; use .exr"));
  EXPECT_THAT(refusal("-o d.pgn"), HasSubstr("(did you mean `png`?)"));
  EXPECT_THAT(refusal("-o none/d.png"), HasSubstr("none/d.png"));
  EXPECT_THAT(refusal("-o -"), HasSubstr("name a file"));
  EXPECT_THAT(refusal("-o d.exr --top 1"), HasSubstr("--top is for colour maps such as .png"));
  for (const char* top : {"0", "-1", "nan"}) {
    EXPECT_THAT(refusal(std::string("-o d.png --top ") + top),
                HasSubstr("--top: takes a number above 0, such as `0.5`, not `"));
  }
  EXPECT_THAT(refusal("--top 1"), HasSubstr("--top applies to the picture that -o writes"));
  EXPECT_THAT(refusal("--what flip"), HasSubstr("--what applies to the picture that -o writes"));
  EXPECT_THAT(refusal("-o d.png --what flipp"), HasSubstr("(did you mean `flip`?)"));
  EXPECT_THAT(names_in(folder_.path()), ElementsAre("a.exr", "b.exr", "link.exr"));
}

constexpr const char* kScene = R"(scene 1
param shade = 0.7
camera main { from: (0, 1, 5), at: (0, 0.5, 0), fov: 30deg }
sphere ground { center: (0, -1000, 0), radius: 1000, material: diffuse(color: gray) }
sphere ball { center: (0, 0.5, 0), radius: 0.5, material: diffuse(color: shade * white) }
render { width: 64, height: 48, samples: 32, depth: 8 }
)";

// H0: the same scene. Noise alone exceeds 4 in one of about 4500 pairs of seeds.
TEST_F(CompareCommand, DistinguishesNoiseFromADifference) {
  write_text(folder_ / "s.scene", kScene);
  const std::string render = "\"$SDLC\" render s.scene --quiet --aov variance ";
  EXPECT_EQ(run(render + "-o a.exr --seed 1").err, "");
  EXPECT_EQ(run(render + "-o b.exr --seed 2").err, "");
  EXPECT_EQ(run(render + "-o c.exr --seed 3 --set shade=0.67").err, "");
  const ProgramResult same = compare("a.exr b.exr --max-z 4");
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("z of the means"));
  EXPECT_THAT(same.out, Not(HasSubstr("note")));
  const ProgramResult changed = compare("c.exr b.exr --max-z 4");
  EXPECT_EQ(changed.exit_code, 1) << changed.out;
  const Json test = json("c.exr b.exr")["z_test"];
  EXPECT_LT(test["mean_z"][1], -4);
  EXPECT_LT(test["mean_p"], 1e-3);
}

TEST_F(CompareCommand, ReportsThatPicturesOfOneSeedShareTheirNoise) {
  write_text(folder_ / "s.scene", kScene);
  for (const std::string name : {"a", "b"}) {
    run("\"$SDLC\" render s.scene --quiet --aov variance --seed 7 -o " + name + ".exr");
  }
  EXPECT_THAT(json("a.exr b.exr")["notes"].dump(),
              HasSubstr("both have seed 7: they share noise, so the z-test is less sensitive; "
                        "render one of them with another --seed"));
}

TEST_F(CompareCommand, RefusesTonesThatDiffer) {
  write_text(folder_ / "s.scene", kScene);
  run("\"$SDLC\" render s.scene --quiet -o a.png --tone srgb -o a.exr");
  run("\"$SDLC\" render s.scene --quiet -o b.png --tone sqrt");
  const ProgramResult result = compare("a.png b.png");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err,
              HasSubstr("`a.png` has codes of the tone srgb and `b.png` of sqrt; render "
                        "one of them with the other's --tone, or compare .exr files"));
}

TEST_F(CompareCommand, ComparesCrops) {
  OIIO::ImageSpec spec = float_spec(12, 8, {"R", "G", "B"});
  spec.x = 3;
  spec.full_width = 100;
  spec.full_height = 50;
  write_oiio_file(folder_ / "a.exr", {spec});
  write_oiio_file(folder_ / "b.exr", {spec});
  const ProgramResult result = compare("a.exr b.exr");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  spec.y = 2;
  write_oiio_file(folder_ / "b.exr", {spec});
  EXPECT_THAT(
      compare("a.exr b.exr").err,
      HasSubstr("`a.exr` has 12 x 8 pixels at (3, 0) of a picture of 100 x 50 and `b.exr` "
                "12 x 8 pixels at (3, 2) of a picture of 100 x 50; only the same pixels can "
                "be compared\n"));
}

TEST_F(CompareCommand, ReportsBothSizes) {
  write("a.png", gradient(8, 12));
  write("b.png", gradient(12, 8));
  EXPECT_THAT(compare("a.png b.png").err,
              HasSubstr("`a.png` has 8 x 12 pixels and `b.png` 12 x 8;"));
}

TEST_F(CompareCommand, MeasuresWhatNumpyDoes) {
  if (run("/usr/bin/python3 -c 'import numpy, OpenImageIO'").exit_code != 0) {
    GTEST_SKIP() << "no python3-numpy and python3-openimageio here";
  }
  const ProgramResult result =
      run("/usr/bin/python3 '" SDLC_SOURCE_DIR "/tests/cli/check_compare.py' \"$SDLC\" .");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("flip: "));
}

}  // namespace
}  // namespace sdlc::test
