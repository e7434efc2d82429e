#include "render/image/image.hpp"

#include <algorithm>
#include <cfloat>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/image/codec_loader.hpp"
#include "render/image/io_error.hpp"
#include "tests/render/image/io_errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::render {
namespace {

using test::error_of;
using test::names_in;
using test::TemporaryFolder;
using test::write_text;

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Smooth, like most of a render, with three different channels; every value in [0, 1).
Picture gradient(int width, int height) {
  Picture picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double u = x / static_cast<double>(width), v = y / static_cast<double>(height);
      picture.at(x, y) = {u, v, 0.5 * (1 - u * v)};
    }
  }
  return picture;
}

/// The values after a round trip through a format that stores 8-bit codes exactly.
Picture codes_of(const Picture& picture, Tone tone) {
  Picture codes = picture;
  for (LinearRgb& p : codes.pixels) {
    const auto value = [&](double v) { return to_code8(tone, v) / 255.0; };
    p = {value(p.r), value(p.g), value(p.b)};
  }
  return codes;
}

double max_difference(const Picture& a, const Picture& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  double difference = 0;
  for (std::size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i) {
    const LinearRgb d = a.pixels[i] - b.pixels[i];
    difference = std::max({difference, std::fabs(d.r), std::fabs(d.g), std::fabs(d.b)});
  }
  return difference;
}

Picture round_trip(const Picture& picture, const std::string& name, WriteOptions options = {}) {
  const TemporaryFolder folder;
  options.format = image_format_of(name).value();
  write_picture(folder / name, picture, options);
  EXPECT_EQ(names_in(folder.path()), std::vector{name});
  return read_picture(folder / name);
}

std::string encoded(const Picture& picture, const WriteOptions& options) {
  const std::vector<std::byte> file = encode_picture(picture, options);
  return {reinterpret_cast<const char*>(file.data()), file.size()};
}

// Sizes that are not multiples of a block of JPEG, WebP or EXR.
constexpr int kWidth = 67;
constexpr int kHeight = 45;

/// The extension of "a.png" as the last part of a test's name: "png".
const auto kExtension = [](const testing::TestParamInfo<const char*>& tested) {
  return fs::path(tested.param).extension().string().substr(1);
};

class ExactFormat : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Image, ExactFormat, testing::Values("a.png", "a.ppm", "a.tiff", "a.TIF"),
                         kExtension);

TEST_P(ExactFormat, KeepsEveryCode) {
  for (const Tone tone : {Tone::Srgb, Tone::Sqrt, Tone::Linear}) {
    const Picture picture = gradient(kWidth, kHeight);
    const Picture read = round_trip(picture, GetParam(), {.mapping = {.tone = tone}});
    EXPECT_EQ(max_difference(read, codes_of(picture, tone)), 0);
  }
}

TEST_P(ExactFormat, KeepsASinglePixel) {
  const Picture picture(1, 1, {1, 0.5, 0});
  EXPECT_EQ(max_difference(round_trip(picture, GetParam()), codes_of(picture, Tone::Srgb)), 0);
}

TEST(Image, TextPpmKeepsEveryCode) {
  const Picture picture = gradient(kWidth, kHeight);
  EXPECT_EQ(max_difference(round_trip(picture, "a.ppm", {.ppm_text = true}),
                           codes_of(picture, Tone::Srgb)),
            0);
}

/// The largest difference to the written codes, for a smooth picture.
double lossy_difference(const std::string& name) {
  const Picture picture = gradient(kWidth, kHeight);
  return 255 * max_difference(round_trip(picture, name), codes_of(picture, Tone::Srgb));
}

// The limits are the measured differences plus a margin for other versions of the encoders.

TEST(Image, JpegStaysNear) {
  // Quality 95: quantisation steps of a few codes; 6. With halved colour resolution it would be 20.
  EXPECT_LE(lossy_difference("a.jpg"), 8);
}

TEST(Image, WebPStaysNear) {
  // The encoder always halves the colour resolution; 19, where the curve is steep.
  EXPECT_LE(lossy_difference("a.webp"), 24);
}

TEST(Image, GifStaysNear) {
  // A palette of 255 colours for a gradient in three channels; 59.
  EXPECT_LE(lossy_difference("a.gif"), 70);
}

TEST(Image, ExrKeepsFloatsExactly) {
  Picture picture(3, 2);
  picture.at(0, 0) = {0.1F, -2.5, 1e30F};
  picture.at(1, 0) = {kInfinity, -kInfinity, 1e-40F};
  picture.at(2, 1) = {3, 2, 1};
  // A tone must have no effect.
  EXPECT_EQ(round_trip(picture, "a.exr", {.mapping = {Tone::Neutral, 2}}).pixels, picture.pixels);
}

TEST(Image, ExrHoldsTheLargestFloatForWhatIsLarger) {
  const Picture read = round_trip(Picture(1, 1, {1e60, -1e60, 3e38F}), "a.exr");
  EXPECT_EQ(read.at(0, 0), (LinearRgb{FLT_MAX, -FLT_MAX, 3e38F}));
}

TEST(Image, ExrKeepsNaN) {
  const Picture read = round_trip(Picture(1, 1, {std::nan(""), 1, 2}), "a.exr");
  EXPECT_TRUE(std::isnan(read.at(0, 0).r));
  EXPECT_EQ(read.at(0, 0).g, 1);
}

TEST(Image, HdrKeepsEightBitsOfThePixelsLargestComponent) {
  Picture picture = gradient(kWidth, kHeight);
  for (LinearRgb& p : picture.pixels) p *= LinearRgb(1000);
  const Picture read = round_trip(picture, "a.hdr", {.mapping = {Tone::Sqrt, 2}});
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const LinearRgb p = picture.pixels[i], d = p - read.pixels[i];
    // The exponent scales the largest component into [128, 256), and the others in the same way.
    const double step = std::max({p.r, p.g, p.b}) / 128;
    EXPECT_LE(std::max({std::fabs(d.r), std::fabs(d.g), std::fabs(d.b)}), step) << i;
  }
}

TEST(Image, HdrTakesWhatItCannotExpressAsTheNearestValue) {
  Picture picture(2, 1);
  picture.at(0, 0) = {1, -1, std::nan("")};
  picture.at(1, 0) = {kInfinity, 0, 0};
  const Picture read = round_trip(picture, "a.hdr");
  EXPECT_EQ(read.at(0, 0), LinearRgb(1, 0, 0));
  EXPECT_GT(read.at(1, 0).r, 9e37);
  EXPECT_TRUE(std::isfinite(read.at(1, 0).r));
}

TEST(Image, PpmIsBytesOrTextAsAsked) {
  const Picture picture(2, 1, LinearRgb(1));
  EXPECT_THAT(encoded(picture, {.format = ImageFormat::Ppm}), StartsWith("P6\n2 1\n255\n"));
  EXPECT_THAT(encoded(picture, {.format = ImageFormat::Ppm, .ppm_text = true}),
              StartsWith("P3\n2 1\n255\n255"));
}

class EveryFormat : public testing::TestWithParam<ImageFormatInfo> {};
INSTANTIATE_TEST_SUITE_P(Image, EveryFormat,
                         testing::ValuesIn(image_formats().begin(), image_formats().end()),
                         [](const auto& tested) {
                           return std::string(tested.param.extensions[0]);
                         });

TEST_P(EveryFormat, HoldsNoTimeOfDay) {
  const std::string file = encoded(gradient(kWidth, kHeight), {.format = GetParam().format});
  // Dates are text in these files, except in a chunk of PNG.
  const std::time_t now = std::time(nullptr);
  char year[8] = {};
  std::strftime(year, sizeof year, "%Y:", std::gmtime(&now));
  EXPECT_THAT(file, Not(HasSubstr(year)));
  EXPECT_THAT(file, Not(HasSubstr("tIME")));
}

TEST_P(EveryFormat, IsTheSameBytesTwice) {
  const WriteOptions options{.format = GetParam().format};
  EXPECT_EQ(encoded(gradient(kWidth, kHeight), options),
            encoded(gradient(kWidth, kHeight), options));
}

TEST_P(EveryFormat, IsAnErrorWhenCutShort) {
  const TemporaryFolder folder;
  const std::string file = encoded(gradient(kWidth, kHeight), {.format = GetParam().format});
  const fs::path path = folder / ("a." + std::string(GetParam().extensions[0]));
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{3}, file.size() / 10, file.size() / 2, file.size() - 1}) {
    write_text(path, file.substr(0, size));
    EXPECT_THAT(error_of([&] { read_picture(path); }),
                StartsWith("cannot read `" + path.string() + "`: "))
        << size << " of " << file.size();
  }
}

TEST_P(EveryFormat, RefusesAnEmptyPicture) {
  EXPECT_THAT(
      error_of([&] { encode_picture(Picture(0, 5), {.format = GetParam().format}, "o/a"); }),
      "cannot write `o/a`: the picture is empty");
}

TEST(Image, HasSidesUpToTheLimitOfItsFormatAndNoMore) {
  for (const ImageFormat format : {ImageFormat::Jpeg, ImageFormat::WebP, ImageFormat::Gif}) {
    const int limit = describe(format).max_side;
    const WriteOptions options{.format = format};
    EXPECT_GT(encode_picture(Picture(limit, 1), options).size(), 0U);
    EXPECT_GT(encode_picture(Picture(1, limit), options).size(), 0U);
    EXPECT_THAT(error_of([&] { encode_picture(Picture(limit + 1, 1), options); }),
                HasSubstr("too many for " + std::string(describe(format).name)));
    EXPECT_THAT(error_of([&] { encode_picture(Picture(1, limit + 1), options); }),
                HasSubstr("too many for"));
  }
}

TEST(Image, CarriesItsMetadata) {
  const Metadata metadata{.software = "sdlc 9.8.7", .entries = {{"sdlc:seed", "42"}}};
  for (const ImageFormat format : {ImageFormat::Png, ImageFormat::Exr}) {
    const std::string file = encoded(Picture(1, 1), {.format = format, .metadata = metadata});
    EXPECT_THAT(file, HasSubstr("sdlc:seed")) << describe(format).name;
    EXPECT_THAT(file, HasSubstr("sdlc 9.8.7")) << describe(format).name;
  }
  for (const ImageFormat format : {ImageFormat::Tiff, ImageFormat::Jpeg}) {
    EXPECT_THAT(encoded(Picture(1, 1), {.format = format, .metadata = metadata}),
                HasSubstr("sdlc 9.8.7"));
  }
}

TEST(Image, SaysThatPngCodesAreSrgbOnlyWhenTheyAre) {
  EXPECT_THAT(encoded(Picture(1, 1), {.mapping = {.tone = Tone::Srgb}}), HasSubstr("sRGB"));
  EXPECT_THAT(encoded(Picture(1, 1), {.mapping = {.tone = Tone::Neutral}}), HasSubstr("sRGB"));
  EXPECT_THAT(encoded(Picture(1, 1), {.mapping = {.tone = Tone::Sqrt}}), Not(HasSubstr("sRGB")));
}

TEST(Image, ReadsGreyAsThreeEqualComponents) {
  const TemporaryFolder folder;
  write_text(folder / "a.ppm", "P2\n2 1\n255\n51 255\n");
  const Picture picture = read_picture(folder / "a.ppm");
  EXPECT_EQ(picture.at(0, 0), LinearRgb(51 / 255.0));
  EXPECT_EQ(picture.at(1, 0), LinearRgb(1));
}

TEST(Image, ReadsEveryKindOfPpm) {
  const TemporaryFolder folder;
  using namespace std::string_literals;
  for (const std::string& file : {
           "P6 2 1 255\n\x33\x33\x33\xff\x00\x80"s,
           "P6\n# a comment\n2 # another\n1\n255# a third\n\x33\x33\x33\xff\x00\x80"s,
           "P6 2 1 65535\n\x33\x33\x33\x33\x33\x33\xff\xff\x00\x00\x80\x80"s,
           "P3 2 1 255 51 51 51 255 0 128"s,
           "P3\n2 1\n255\n51 51 51 # the second\n255 0 128\n"s,
       }) {
    write_text(folder / "a.ppm", file);
    const Picture picture = read_picture(folder / "a.ppm");
    EXPECT_EQ(picture.at(0, 0), LinearRgb(51 / 255.0)) << file;
    EXPECT_EQ(picture.at(1, 0), LinearRgb(1, 0, 128 / 255.0)) << file;
  }
  write_text(folder / "a.ppm", "P5 2 1 255\n\x33\xff");
  EXPECT_EQ(read_picture(folder / "a.ppm").at(0, 0), LinearRgb(51 / 255.0));
  write_text(folder / "a.ppm", "P1 2 1\n1 0\n");  // by OpenImageIO
  EXPECT_EQ(read_picture(folder / "a.ppm").at(1, 0), LinearRgb(1));
  for (const char* file : {"P6 2 1 255", "P6 2 1 255x123456", "P6 2 1\n", "P3 2 1 255 1 2 3 4 5",
                           "P3 2 1 255 1 2 3 4 5 256", "P3 2 1 255 1 2 3 4 5 x", "P6 0 1 255\n"}) {
    write_text(folder / "a.ppm", file);
    EXPECT_NE(error_of([&] { read_picture(folder / "a.ppm"); }), "") << file;
  }
}

TEST(Image, RefusesAPngThatClaimsMoreThanItHas) {
  const TemporaryFolder folder;
  using namespace std::string_literals;
  const std::string png = encoded(Picture(1, 1), {});
  const std::size_t end = png.find("IEND") - 4;
  write_text(folder / "a.png", png.substr(0, end) + "\x7f\xff\xff\xfftEXt"s + png.substr(end));
  EXPECT_THAT(error_of([&] { read_picture(folder / "a.png"); }), HasSubstr("it is truncated"));
}

TEST(Image, RefusesToReadMorePixelsThanAnyPictureHas) {
  const TemporaryFolder folder;
  write_text(folder / "a.ppm", "P6\n100000 100000\n255\n");
  EXPECT_THAT(error_of([&] { read_picture(folder / "a.ppm"); }),
              HasSubstr("more than 268435456 pixels"));
}

TEST(Image, ReportsFilesThatCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of([&] { read_picture(folder / "none.png"); }),
              HasSubstr("No such file or directory"));
  EXPECT_THAT(error_of([&] { read_picture(folder / "a.bmp"); }),
              HasSubstr("its extension is not that of a picture format; known are png, exr, hdr"));
  fs::create_directory(folder / "b.png");
  EXPECT_THAT(error_of([&] { read_picture(folder / "b.png"); }), HasSubstr("it is a folder"));
}

TEST(Image, ReportsAFileOfAnotherFormat) {
  const TemporaryFolder folder;
  write_picture(folder / "a.exr", Picture(1, 1), {.format = ImageFormat::Exr});
  fs::rename(folder / "a.exr", folder / "a.png");
  EXPECT_THAT(error_of([&] { read_picture(folder / "a.png"); }),
              HasSubstr("a.png`: its content is OpenEXR, not PNG; call it .exr"));
  write_text(folder / "b.png", "");
  EXPECT_THAT(error_of([&] { read_picture(folder / "b.png"); }), HasSubstr("b.png`: it is empty"));
  write_text(folder / "c.png", "no picture at all");
  EXPECT_THAT(error_of([&] { read_picture(folder / "c.png"); }), StartsWith("cannot read `"));
}

}  // namespace
}  // namespace sdlc::render
