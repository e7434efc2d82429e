#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

namespace sdlc::test {

/// The channels of an EXR file by name, each row by row from the top, as another program reads
/// them; all of them are 32-bit floats.
inline std::map<std::string, std::vector<float>> exr_channels(const std::filesystem::path& path) {
  std::map<std::string, std::vector<float>> channels;
  const auto input = OIIO::ImageInput::open(path.string());
  EXPECT_TRUE(input) << OIIO::geterror();
  if (!input) return channels;
  const OIIO::ImageSpec& spec = input->spec();
  EXPECT_EQ(spec.format, OIIO::TypeDesc::FLOAT);
  EXPECT_TRUE(spec.channelformats.empty()) << "all of one type";
  for (int c = 0; c < spec.nchannels; ++c) {
    std::vector<float> values(spec.image_pixels());
    EXPECT_TRUE(input->read_image(0, 0, c, c + 1, OIIO::TypeDesc::FLOAT, values.data()));
    channels[spec.channelnames[static_cast<std::size_t>(c)]] = std::move(values);
  }
  return channels;
}

}  // namespace sdlc::test
