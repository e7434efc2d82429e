#include "render/image/picture_file.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/image/image.hpp"
#include "tests/render/image/io_errors.hpp"
#include "tests/support/oiio_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::render {
namespace {

using test::error_of;
using test::float_spec;
using test::write_oiio_file;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

/// Files of other programs, each with a constant value.
class PictureFiles : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::vector<OIIO::ImageSpec>& specs) {
    write_oiio_file(folder_ / name, specs);
    return (folder_ / name).string();
  }
  PictureFile read(const std::string& name, const OIIO::ImageSpec& spec) {
    return read_picture_file(write(name, {spec}));
  }
  std::string refusal(const std::string& name, const std::vector<OIIO::ImageSpec>& specs) {
    const std::string path = write(name, specs);
    return error_of([&] { read_picture_file(path); });
  }

  test::TemporaryFolder folder_;
};

TEST_F(PictureFiles, OfOurOwnSayWhatTheyAre) {
  const std::vector<Layer> layers{
      {"variance.R", {1}}, {"variance.B", {3}}, {"Z", {7}}, {"variance.G", {2}}};
  write_picture(folder_ / "a.exr", Picture(1, 1, {4, 5, 6}),
                {.format = ImageFormat::Exr,
                 .metadata = {.entries = {{"sdlc:seed", "42"}, {"other", "x"}}},
                 .layers = layers});
  const PictureFile file = read_picture_file(folder_ / "a.exr");
  EXPECT_TRUE(file.is_linear);
  EXPECT_FALSE(file.is_grey);
  EXPECT_EQ(file.picture.at(0, 0), LinearRgb(4, 5, 6));
  ASSERT_TRUE(file.variance);
  EXPECT_EQ(file.variance->at(0, 0), LinearRgb(1, 2, 3));
  EXPECT_THAT(file.other_channels, ElementsAre("Z"));
  EXPECT_THAT(file.metadata, ElementsAre(Pair("sdlc:seed", "42")));
  EXPECT_EQ(file.find_metadata("sdlc:seed"), "42");
  EXPECT_EQ(file.find_metadata("sdlc:tone"), std::nullopt);
}

TEST_F(PictureFiles, KeepTheirMetadataAsPngToo) {
  write_picture(folder_ / "a.png", Picture(1, 1),
                {.metadata = {.entries = {{"sdlc:tone", "sqrt"}}}});
  const PictureFile file = read_picture_file(folder_ / "a.png");
  EXPECT_EQ(file.find_metadata("sdlc:tone"), "sqrt");
  EXPECT_FALSE(file.is_linear);
  EXPECT_EQ(file.largest_code, 255);
  EXPECT_FALSE(file.variance);
  EXPECT_THAT(file.other_channels, IsEmpty());
}

TEST_F(PictureFiles, MayHaveCodesOfSixteenBits) {
  OIIO::ImageSpec spec = float_spec(3, 2, {"R", "G", "B"});
  spec.format = OIIO::TypeDesc::UINT16;
  const PictureFile file = read("a.png", spec);
  EXPECT_EQ(file.largest_code, 65535);
  EXPECT_NEAR(file.picture.at(0, 0).g, 0.5, 1 / 65535.0);
}

TEST_F(PictureFiles, MayBeOfAnyCompressionTiledOrOfHalfFloats) {
  for (const char* compression : {"none", "rle", "zips", "zip", "piz", "pxr24"}) {
    OIIO::ImageSpec spec = float_spec(40, 20, {"R", "G", "B", "Z"});
    spec.attribute("compression", compression);
    EXPECT_EQ(read("a.exr", spec).picture.at(39, 19), LinearRgb(0.5)) << compression;
    spec.format = OIIO::TypeDesc::HALF;
    EXPECT_EQ(read("a.exr", spec).picture.at(39, 19), LinearRgb(0.5)) << compression;
  }
  OIIO::ImageSpec tiled = float_spec(40, 20, {"R", "G", "B"});
  tiled.tile_width = tiled.tile_height = 16;
  EXPECT_EQ(read("a.exr", tiled).picture.at(39, 19), LinearRgb(0.5));
}

TEST_F(PictureFiles, NameAnOpacityBesideTheColours) {
  OIIO::ImageSpec spec = float_spec(3, 2, {"R", "G", "B", "A"});
  spec.alpha_channel = 3;
  spec.format = OIIO::TypeDesc::UINT8;
  EXPECT_THAT(read("a.png", spec).other_channels, ElementsAre("A"));
}

TEST_F(PictureFiles, DoNotNameAnOpacityWithNothingToTell) {
  const OIIO::ImageSpec spec = float_spec(2, 2, {"R", "G", "B", "A"});
  write_oiio_file(folder_ / "a.exr", {spec}, 1);
  EXPECT_THAT(read_picture_file(folder_ / "a.exr").other_channels, IsEmpty());
}

TEST_F(PictureFiles, SayThatTheyAreGrey) {
  OIIO::ImageSpec spec = float_spec(3, 2, {"Y", "A"});
  spec.alpha_channel = 1;
  spec.format = OIIO::TypeDesc::UINT8;
  const PictureFile file = read("a.png", spec);
  EXPECT_TRUE(file.is_grey);
  EXPECT_EQ(file.picture.at(2, 1).r, file.picture.at(2, 1).b);
  EXPECT_THAT(file.other_channels, ElementsAre("A"));
}

TEST_F(PictureFiles, WithoutRedGreenAndBlueAreRefused) {
  EXPECT_THAT(refusal("y.exr", {float_spec(2, 2, {"Y"})}),
              HasSubstr("it has no channels R, G and B; its channels are Y"));
  EXPECT_THAT(refusal("xyz.exr", {float_spec(2, 2, {"X", "Y", "Z"})}),
              HasSubstr("its channels are X, Y, Z"));
  EXPECT_THAT(refusal("layer.exr", {float_spec(2, 2, {"beauty.R", "beauty.G", "beauty.B"})}),
              HasSubstr("its channels are beauty.R, beauty.G, beauty.B"));
}

TEST_F(PictureFiles, WithAPartOfAVarianceAreRefused) {
  EXPECT_THAT(refusal("a.exr", {float_spec(2, 2, {"R", "G", "B", "variance.R", "variance.G"})}),
              HasSubstr("it has some but not all of variance.R, variance.G, variance.B"));
}

TEST_F(PictureFiles, OfSeveralPicturesAreRefused) {
  std::vector<OIIO::ImageSpec> parts(2, float_spec(2, 2, {"R", "G", "B"}));
  parts[0].attribute("oiio:subimagename", "left");
  parts[1].attribute("oiio:subimagename", "right");
  EXPECT_THAT(refusal("a.exr", parts), HasSubstr("it holds 2 pictures"));
  for (OIIO::ImageSpec& part : parts) part.format = OIIO::TypeDesc::UINT8;
  EXPECT_THAT(refusal("a.gif", {parts[0], parts[1], parts[1]}), HasSubstr("it holds 3 pictures"));
  EXPECT_THAT(refusal("a.tiff", parts), HasSubstr("it holds 2 pictures"));
}

TEST_F(PictureFiles, MayBeCrops) {
  OIIO::ImageSpec spec = float_spec(4, 3, {"R", "G", "B"});
  spec.x = spec.full_x = 2;
  spec.y = spec.full_y = -1;
  EXPECT_EQ(read("a.exr", spec).picture.width, 4);
  EXPECT_EQ(read("a.exr", spec).crop, (PixelWindow{0, 0, 4, 3}));
  spec.full_width = 20;
  spec.full_y = -10;
  spec.full_height = 30;
  const PictureFile crop = read("a.exr", spec);
  EXPECT_EQ(crop.crop, (PixelWindow{0, 9, 4, 3}));
  EXPECT_EQ(crop.whole_width, 20);
  EXPECT_EQ(crop.whole_height, 30);
}

TEST_F(PictureFiles, OfFloatsThatMayBeAnythingAreRefused) {
  EXPECT_THAT(refusal("a.tiff", {float_spec(2, 2, {"R", "G", "B"})}),
              HasSubstr("its values are not codes of 8 or 16 bits, and TIFF does not define their "
                        "meaning; write them as .exr"));
}

}  // namespace
}  // namespace sdlc::render
