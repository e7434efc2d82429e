#include "cli/crop_option.hpp"

#include <cmath>
#include <cstddef>
#include <sstream>

#include <fmt/format.h>

#include "cli/amounts.hpp"
#include "cli/usage_error.hpp"
#include "cli/whole_number.hpp"
#include "lang/text/display_width.hpp"

namespace sdlc::cli {
namespace {

constexpr std::uint64_t kMaxPixels = 1u << 30;

Crop::Length parse_length(const std::string& text) {
  if (!text.ends_with('%')) {
    const std::uint64_t pixels = parse_whole_number("--crop", text, {.highest = kMaxPixels});
    return {.value = static_cast<double>(pixels)};
  }
  const double percent = parse_number("--crop", text.substr(0, text.size() - 1), 0);
  return {.value = percent, .is_percent = true};
}

Crop parse_crop(const std::string& text) {
  Crop crop{.lengths = {}, .text = lang::printable(text)};
  std::istringstream words(text);
  std::size_t count = 0;
  for (std::string word; std::getline(words, word, ','); ++count) {
    if (count < crop.lengths.size()) crop.lengths[count] = parse_length(word);
  }
  if (count == crop.lengths.size() && !text.ends_with(',')) return crop;
  throw ArgumentError("--crop", fmt::format("takes X,Y,WIDTH,HEIGHT in pixels or percent, such as "
                                            "100,50,320,180 or 25%,25%,50%,50%, not `{}`",
                                            crop.text));
}

struct Side {
  int first, size;
};

/// A side of the part, in a picture with as many pixels.
Side side(Crop::Length first, Crop::Length size, int pixels) {
  const auto in_pixels = [pixels](Crop::Length length) {
    return length.is_percent ? length.value / 100 * pixels : length.value;
  };
  const double begin = std::round(in_pixels(first));
  const double end = std::round(in_pixels(first) + in_pixels(size));
  if (!(end <= pixels)) return {.first = 0, .size = 0};
  return {.first = static_cast<int>(begin), .size = static_cast<int>(end - begin)};
}

}  // namespace

render::PixelWindow Crop::window(int width, int height) const {
  const Side across = side(lengths[0], lengths[2], width);
  const Side down = side(lengths[1], lengths[3], height);
  if (across.size > 0 && down.size > 0) {
    return {.x = across.first, .y = down.first, .width = across.size, .height = down.size};
  }
  throw UsageError(fmt::format("--crop: {} has no pixels in a picture of {} x {}, or ends outside",
                               text, width, height));
}

void add_crop_option(Command& command, std::optional<Crop>& crop) {
  command
      .add_text(
          "--crop", [&crop](const std::string& text) { crop = parse_crop(text); },
          "Render only this part of the picture, in pixels or percent from its top left; EXR files "
          "have it as data window")
      .type_name("X,Y,W,H");
}

}  // namespace sdlc::cli
