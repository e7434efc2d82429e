#include "render/image/image_format.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

TEST(ImageFormat, FollowsFromTheExtension) {
  EXPECT_EQ(image_format_of("a.png"), ImageFormat::Png);
  EXPECT_EQ(image_format_of("out/a.exr"), ImageFormat::Exr);
  EXPECT_EQ(image_format_of("a.hdr"), ImageFormat::Hdr);
  EXPECT_EQ(image_format_of("a.tif"), ImageFormat::Tiff);
  EXPECT_EQ(image_format_of("a.tiff"), ImageFormat::Tiff);
  EXPECT_EQ(image_format_of("a.jpg"), ImageFormat::Jpeg);
  EXPECT_EQ(image_format_of("a.jpeg"), ImageFormat::Jpeg);
  EXPECT_EQ(image_format_of("a.webp"), ImageFormat::WebP);
  EXPECT_EQ(image_format_of("a.ppm"), ImageFormat::Ppm);
  EXPECT_EQ(image_format_of("a.b.gif"), ImageFormat::Gif);
}

TEST(ImageFormat, ReadsExtensionsInEitherCase) {
  EXPECT_EQ(image_format_of("A.PNG"), ImageFormat::Png);
  EXPECT_EQ(image_format_of("a.Jpeg"), ImageFormat::Jpeg);
}

TEST(ImageFormat, IsNothingForOtherNames) {
  for (const char* name :
       {"", "a", "png", ".png", "a.", "a.png.txt", "a.pn", "a.pngs", "a.png/b"}) {
    EXPECT_EQ(image_format_of(name), std::nullopt) << name;
  }
}

TEST(ImageFormat, ListsEveryExtensionOnce) {
  EXPECT_THAT(image_extensions(), testing::ElementsAre("png", "exr", "hdr", "tiff", "tif", "jpg",
                                                       "jpeg", "webp", "ppm", "gif"));
}

TEST(ImageFormat, KnowsWhichFormatsHoldLinearRadiance) {
  for (const ImageFormatInfo& info : image_formats()) {
    const bool is_linear = info.format == ImageFormat::Exr || info.format == ImageFormat::Hdr;
    EXPECT_EQ(describe(info.format).is_linear, is_linear) << info.name;
  }
}

}  // namespace
}  // namespace sdlc::render
