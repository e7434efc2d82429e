// Files that `compare` refuses.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "render/image/image.hpp"
#include "tests/cli/gradient_picture.hpp"
#include "tests/support/oiio_file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

using render::ImageFormat;
using render::Picture;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Compares the file `bad`, created next to good.exr and good.png of 12 x 8 pixels, with `with`.
struct BrokenCase {
  const char* name;
  const char* bad;
  const char* with;
  std::function<void(const TemporaryFolder&)> make;
  const char* message;
};

void write_good(const std::filesystem::path& path) {
  render::write_picture(path, gradient(), {.format = render::image_format_of(path).value()});
}

/// A valid picture without its last `share`.
std::function<void(const TemporaryFolder&)> cut(const std::string& name, double share) {
  return [=](const TemporaryFolder& folder) {
    write_good(folder / name);
    const std::string whole = content_of(folder / name);
    write_text(
        folder / name,
        whole.substr(0, static_cast<std::size_t>((1 - share) * static_cast<double>(whole.size()))));
  };
}

std::function<void(const TemporaryFolder&)> text(const std::string& name,
                                                 const std::string& content) {
  return [=](const TemporaryFolder& folder) { write_text(folder / name, content); };
}

/// good.exr with a different green value in the pixel (5, 3).
std::function<void(const TemporaryFolder&)> with_value(double value) {
  return [=](const TemporaryFolder& folder) {
    Picture picture = gradient();
    picture.at(5, 3).g = value;
    render::write_picture(folder / "bad.exr", picture, {.format = ImageFormat::Exr});
    // Infinity is preserved.
    ASSERT_FALSE(std::isfinite(render::read_picture(folder / "bad.exr").at(5, 3).g));
  };
}

std::function<void(const TemporaryFolder&)> channels(std::vector<std::string> names,
                                                     float value = 0.5F) {
  return [=](const TemporaryFolder& folder) {
    write_oiio_file(folder / "bad.exr", {float_spec(12, 8, names)}, value);
  };
}

std::function<void(const TemporaryFolder&)> parts(const std::string& name, OIIO::TypeDesc type) {
  return [=](const TemporaryFolder& folder) {
    OIIO::ImageSpec spec = float_spec(12, 8, {"R", "G", "B"});
    spec.format = type;
    std::vector<OIIO::ImageSpec> specs(2, spec);
    specs[0].attribute("oiio:subimagename", "left");
    specs[1].attribute("oiio:subimagename", "right");
    write_oiio_file(folder / name, specs);
  };
}

std::vector<BrokenCase> broken_cases() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto nothing = [](const TemporaryFolder&) {};
  return {
      {"Missing", "bad.png", "good.png", nothing, "No such file or directory"},
      {"Folder", "bad.png", "good.png",
       [](const TemporaryFolder& folder) { std::filesystem::create_directory(folder / "bad.png"); },
       "it is a folder"},
      {"Empty", "bad.png", "good.png", text("bad.png", ""), "it is empty"},
      {"StandardInput", "-", "good.png", nothing,
       "pictures cannot be read from standard input: the format follows from the name"},
      {"NoExtension", "bad", "good.png", text("bad", "x"), "the name has no extension"},
      {"UnknownExtension", "bad.pgn", "good.png", text("bad.pgn", "x"),
       "unknown extension `.pgn`; known are png exr hdr tiff tif jpg jpeg webp ppm gif (did you "
       "mean `png`?)"},
      {"ContentOfAnotherFormat", "bad.png", "good.png",
       [](const TemporaryFolder& folder) {
         std::filesystem::copy(folder / "good.exr", folder / "bad.png");
       },
       "its content is OpenEXR, not PNG; call it .exr"},
      {"NoPicture", "bad.exr", "good.exr", text("bad.exr", "hello, world"),
       "its content is not OpenEXR"},
      {"CutPng", "bad.png", "good.png", cut("bad.png", 0.01), "cannot read `bad.png`"},
      {"CutExr", "bad.exr", "good.exr", cut("bad.exr", 0.2), "cannot read `bad.exr`"},
      {"CutHdr", "bad.hdr", "good.exr", cut("bad.hdr", 0.2), "cannot read `bad.hdr`"},
      {"CutJpeg", "bad.jpg", "good.png", cut("bad.jpg", 0.2), "cannot read `bad.jpg`"},
      {"CutTiff", "bad.tiff", "good.png", cut("bad.tiff", 0.4), "cannot read `bad.tiff`"},
      {"CutWebP", "bad.webp", "good.png", cut("bad.webp", 0.2), "cannot read `bad.webp`"},
      {"CutPpm", "bad.ppm", "good.png", cut("bad.ppm", 0.1), "cannot read `bad.ppm`"},
      {"CutGif", "bad.gif", "good.png", cut("bad.gif", 0.1), "cannot read `bad.gif`"},
      {"OtherSize", "bad.png", "good.png",
       [](const TemporaryFolder& folder) {
         render::write_picture(folder / "bad.png", gradient(8, 12), {});
       },
       "only pictures of the same size can be compared"},
      {"Nan", "bad.exr", "good.exr", with_value(std::nan("")),
       "cannot compare `bad.exr`: 1 of its values is not finite; the first is nan in green "
       "of the pixel (5, 3)"},
      {"Infinity", "bad.exr", "good.exr", with_value(-kInfinity),
       "the first is -inf in green of the pixel (5, 3)"},
      {"LinearAndCodes", "good.exr", "good.png", nothing,
       "`good.exr` holds linear radiance and `good.png` the codes of a tone curve; compare two "
       "files of the same kind"},
      {"GreyAndColour", "bad.ppm", "good.png",
       [](const TemporaryFolder& folder) {
         write_text(folder / "bad.ppm", "P5\n12 8\n255\n" + std::string(96, 'x'));
       },
       "`bad.ppm` is grey and `good.png` has colours"},
      {"OnlyY", "bad.exr", "good.exr", channels({"Y"}), "its channels are Y"},
      {"OnlyXyz", "bad.exr", "good.exr", channels({"X", "Y", "Z"}), "its channels are X, Y, Z"},
      {"OnlyALayer", "bad.exr", "good.exr", channels({"beauty.R", "beauty.G", "beauty.B"}),
       "it has no channels R, G and B; its channels are beauty.R, beauty.G, beauty.B"},
      {"TwoParts", "bad.exr", "good.exr", parts("bad.exr", OIIO::TypeDesc::FLOAT),
       "it holds 2 pictures"},
      {"AnimatedGif", "bad.gif", "good.png", parts("bad.gif", OIIO::TypeDesc::UINT8),
       "it holds 2 pictures; extract the one to use"},
      {"Crop", "bad.exr", "good.exr",
       [](const TemporaryFolder& folder) {
         OIIO::ImageSpec spec = float_spec(12, 8, {"R", "G", "B"});
         spec.full_width = 100;
         write_oiio_file(folder / "bad.exr", {spec});
       },
       "12 x 8 pixels at (0, 0) of a picture of 100 x 8"},
      {"PartOfAVariance", "bad.exr", "good.exr", channels({"R", "G", "B", "variance.G"}),
       "it has some but not all of variance.R, variance.G, variance.B"},
      {"NegativeVariance", "bad.exr", "good.exr",
       channels({"R", "G", "B", "variance.R", "variance.G", "variance.B"}, -0.25F),
       "288 of its variances are negative or not finite; the first is -0.25 in red of the pixel "
       "(0, 0)"},
      {"VarianceOfNan", "bad.exr", "good.exr",
       channels({"R", "G", "B", "variance.R", "variance.G", "variance.B"},
                std::numeric_limits<float>::quiet_NaN()),
       "cannot compare `bad.exr`"},
      {"TooManyPixels", "bad.ppm", "good.png", text("bad.ppm", "P6\n100000 100000\n255\n"),
       "it has more than 268435456 pixels"},
      {"FloatTiff", "bad.tiff", "good.png",
       [](const TemporaryFolder& folder) {
         write_oiio_file(folder / "bad.tiff", {float_spec(12, 8, {"R", "G", "B"})});
       },
       "its values are not codes of 8 or 16 bits"},
      {"Pipe", "bad.png", "good.png",
       [](const TemporaryFolder& folder) {
         ASSERT_EQ(::mkfifo((folder / "bad.png").c_str(), 0600), 0);
       },
       "it is not a regular file"},
      {"TerminalCodesInTheName", "'bad\033[31m.exr'", "good.exr", nothing, "bad"},
      {"LinkToItself", "bad.tif", "good.png",
       [](const TemporaryFolder& folder) {
         std::filesystem::create_symlink("bad.tif", folder / "bad.tif");
       },
       "cannot read `bad.tif`: Too many levels of symbolic links"},
  };
}

class CompareRefuses : public testing::TestWithParam<BrokenCase> {
 protected:
  TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Compare, CompareRefuses, testing::ValuesIn(broken_cases()),
                         [](const auto& broken) { return broken.param.name; });

TEST_P(CompareRefuses, WhatItCannotCompare) {
  const BrokenCase& broken = GetParam();
  write_good(folder_ / "good.exr");
  write_good(folder_ / "good.png");
  broken.make(folder_);
  for (const std::string& files :
       {std::string(broken.bad) + " " + broken.with, std::string(broken.with) + " " + broken.bad}) {
    const ProgramResult result =
        run_shell(folder_.path(), "\"$SDLC\" compare " + files + " -o diff.png");
    EXPECT_EQ(result.exit_code, 2) << files;
    EXPECT_EQ(result.out, "") << files;
    EXPECT_THAT(result.err, StartsWith("error: ")) << files;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("\033")));
    EXPECT_THAT(result.err, HasSubstr(broken.message)) << files;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "diff.png"));
  }
}

}  // namespace
}  // namespace sdlc::test
