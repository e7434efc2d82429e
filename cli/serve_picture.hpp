#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "cli/serve_render.hpp"

/// Served pictures as what a page shows.
namespace sdlc::cli {

/// What of a picture is shown, by its name in the messages of the page.
enum class ServedChannel : std::uint8_t {
  Color,
  Error,   ///< of each pixel: the standard error of its mean
  Normal,  ///< of the first surface, facing the camera
  Depth,   ///< of the first surface; near is bright
  Albedo,  ///< of the first surface
  Samples,
};
inline constexpr std::array<std::string_view, 6> kServedChannels{"color", "error",  "normal",
                                                                 "depth", "albedo", "samples"};

/// Whether the picture has it.
bool has_channel(const ServedPicture& picture, ServedChannel channel) noexcept;

/// The codes of red, green and blue of each pixel of ServedPicture::result, row by row from the
/// top; black where the picture lacks the channel. `exposure`: stops beside those of the scene, for
/// the colour.
std::vector<std::uint8_t> codes_of(const ServedPicture& picture, ServedChannel channel,
                                   double exposure);

}  // namespace sdlc::cli
