#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

namespace sdlc::test {

/// The specification of a picture of 32-bit floats with channels of these names.
inline OIIO::ImageSpec float_spec(int width, int height, std::vector<std::string> channels) {
  OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames = std::move(channels);
  return spec;
}

/// Writes a file like another program: a picture for each of `specs`, with every value `value`.
inline void write_oiio_file(const std::filesystem::path& path,
                            const std::vector<OIIO::ImageSpec>& specs, float value = 0.5F) {
  const auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output) << OIIO::geterror();
  ASSERT_TRUE(specs.size() == 1
                  ? output->open(path.string(), specs[0])
                  : output->open(path.string(), static_cast<int>(specs.size()), specs.data()))
      << output->geterror();
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (i > 0) {
      ASSERT_TRUE(output->open(path.string(), specs[i], OIIO::ImageOutput::AppendSubimage))
          << output->geterror();
    }
    const std::vector<float> values(
        specs[i].image_pixels() * static_cast<std::size_t>(specs[i].nchannels), value);
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data())) << output->geterror();
  }
  ASSERT_TRUE(output->close()) << output->geterror();
}

}  // namespace sdlc::test
