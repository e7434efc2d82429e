#include <cfloat>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/image/image.hpp"
#include "tests/render/image/io_errors.hpp"
#include "tests/support/exr_channels.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::render {
namespace {

using test::error_of;
using test::exr_channels;
using test::TemporaryFolder;

// Not multiples of the rows that are compressed or written together, and more than either.
constexpr int kWidth = 19;
constexpr int kHeight = 150;

Picture picture() {
  Picture picture(kWidth, kHeight);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const auto v = static_cast<double>(i);
    picture.pixels[i] = {v, 2 * v, -v};
  }
  return picture;
}

/// `slope` times the index of the pixel.
Layer ramp(const std::string& name, float slope) {
  Layer layer{.name = name, .values = std::vector<float>(picture().pixels.size())};
  for (std::size_t i = 0; i < layer.values.size(); ++i) {
    layer.values[i] = slope * static_cast<float>(i);
  }
  return layer;
}

/// Names that sort before, between and after B, G and R in a file, which is in alphabetical order.
std::vector<Layer> layers() {
  return {ramp("normal.X", 3), ramp("Z", 1e30F), ramp("A.first", -7), ramp("H", 0.1F),
          ramp("albedo.R", 5)};
}

TEST(ExrLayers, KeepEveryValueUnderItsName) {
  const TemporaryFolder folder;
  const std::vector<Layer> all = layers();
  write_picture(folder / "a.exr", picture(), {.format = ImageFormat::Exr, .layers = all});
  const auto channels = exr_channels(folder / "a.exr");
  EXPECT_EQ(channels.size(), 8u);
  for (const Layer& layer : all) EXPECT_EQ(channels.at(layer.name), layer.values) << layer.name;
  EXPECT_EQ(channels.at("R"), ramp("", 1).values);
  EXPECT_EQ(channels.at("G"), ramp("", 2).values);
  EXPECT_EQ(channels.at("B"), ramp("", -1).values);
}

TEST(ExrLayers, LeaveThePictureAsItIsReadWithoutThem) {
  const TemporaryFolder folder;
  const std::vector<Layer> all = layers();
  write_picture(folder / "a.exr", picture(), {.format = ImageFormat::Exr, .layers = all});
  EXPECT_EQ(read_picture(folder / "a.exr").pixels, picture().pixels);
}

TEST(ExrLayers, AreTheSameBytesTwice) {
  const std::vector<Layer> all = layers();
  const WriteOptions options{.format = ImageFormat::Exr, .layers = all};
  EXPECT_EQ(encode_picture(picture(), options), encode_picture(picture(), options));
}

TEST(ExrLayers, ChangeNoByteOfOtherFormats) {
  const std::vector<Layer> all = layers();
  for (const ImageFormat format : {ImageFormat::Png, ImageFormat::Hdr, ImageFormat::Tiff}) {
    EXPECT_EQ(encode_picture(picture(), {.format = format, .layers = all}),
              encode_picture(picture(), {.format = format}));
  }
}

TEST(ExrLayers, HaveAValueForEveryPixel) {
  const std::vector<Layer> all{{.name = "Z", .values = {1, 2, 3}}};
  EXPECT_EQ(error_of([&] {
              encode_picture(Picture(2, 2), {.format = ImageFormat::Exr, .layers = all}, "a.exr");
            }),
            "cannot write `a.exr`: `Z` has a different number of pixels than the picture");
}

TEST(ToFloat, KeepsWhatIsTooLargeFinite) {
  EXPECT_EQ(to_float(1e300), FLT_MAX);
  EXPECT_EQ(to_float(-1e300), -FLT_MAX);
  EXPECT_EQ(to_float(0.1), 0.1F);
}

}  // namespace
}  // namespace sdlc::render
