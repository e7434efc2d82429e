#pragma once

#include <array>
#include <optional>
#include <string>

#include "cli/command_line.hpp"
#include "render/math/pixel_window.hpp"

namespace sdlc::cli {

/// A part of a picture: x, y, width and height, each in pixels or in percent of the picture.
struct Crop {
  struct Length {
    double value = 0;
    bool is_percent = false;
  };
  std::array<Length, 4> lengths;
  std::string text;  ///< as written

  /// In a picture of this size. Parts in percent that meet have neither gaps nor pixels in common.
  /// Throws UsageError if the part is empty or not inside.
  render::PixelWindow window(int width, int height) const;
};

/// Adds --crop.
void add_crop_option(Command& command, std::optional<Crop>& crop);

}  // namespace sdlc::cli
