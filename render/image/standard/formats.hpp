#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "render/image/codec.hpp"

/// Encoders and decoders of one format each. They throw std::exception with a message for people.
namespace sdlc::render::standard {

/// The file is whole, as far as is known, but of a kind that only OpenImageIO reads.
struct ForeignFile {};

std::vector<std::byte> encode_png(const EncodeRequest& request);
/// 8 or 16 bits, grey or colour, or of a palette. Throws ForeignFile for one with alpha.
DecodedImage decode_png(std::span<const std::byte> file, std::int64_t max_pixels);

std::vector<std::byte> encode_exr(const EncodeRequest& request);
/// Channels R, G, B and others, at full resolution. Throws ForeignFile for files of several parts,
/// of samples at several depths, and of other channels.
DecodedImage decode_exr(std::span<const std::byte> file, std::int64_t max_pixels);

std::vector<std::byte> encode_ppm(const EncodeRequest& request);
/// P2, P3, P5 and P6 of 8 or 16 bits. Throws ForeignFile for others.
DecodedImage decode_ppm(std::span<const std::byte> file, std::int64_t max_pixels);

/// Throws for a picture without pixels, or with more than `max_pixels`.
void check_size(std::int64_t width, std::int64_t height, std::int64_t max_pixels);

}  // namespace sdlc::render::standard
