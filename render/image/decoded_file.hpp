#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include "render/image/codec.hpp"
#include "render/image/image_format.hpp"
#include "render/image/picture.hpp"

namespace sdlc::render {

/// A file as the codec decodes it.
struct DecodedFile {
  ImageFormat format = ImageFormat::Png;
  DecodedImage image;
};

/// Throws IoError if `path` cannot be read, or its content does not match its extension.
DecodedFile decode_file(const std::filesystem::path& path);

/// The index of the channel with this name, -1 if there is none.
int channel_index(const DecodedImage& image, std::string_view name) noexcept;

/// The channels with these indices as a picture.
Picture picture_of(const DecodedImage& image, const std::array<int, 3>& channels);

/// R, G and B if there are channels with these names, otherwise the first three, otherwise the
/// first as grey.
Picture rgb_of(const DecodedImage& image);

}  // namespace sdlc::render
