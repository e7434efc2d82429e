#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "render/math/color.hpp"

namespace sdlc::render {

/// The curve from linear radiance to the codes of a display-referred picture.
enum class Tone : std::uint8_t { Srgb, Sqrt, Linear, Neutral };

/// The transfer curve of one component: encodes the linear value `v` to [0, 1]. `v` is clamped to
/// [0, 1] first; NaN counts as 0. Srgb and Neutral have the curve of IEC 61966-2-1; Sqrt is the
/// square root (the JSON format's `gamma_correct`).
double encode_tone(Tone tone, double v) noexcept;

/// The inverse of encode_tone, for `encoded` in [0, 1]: what a display emits. The highlights that
/// Neutral compresses remain compressed.
double decode_tone(Tone tone, double encoded) noexcept;

/// The spelling in scenes, in the order of the enumerators.
inline constexpr std::array<std::string_view, 4> kToneWords{"srgb", "sqrt", "linear", "neutral"};

std::string_view name_of(Tone tone) noexcept;
std::optional<Tone> tone_of(std::string_view name) noexcept;

/// The 8-bit code of a linear value: encode_tone scaled by 255 and rounded once, to nearest
/// (truncation would darken every picture by half a code).
std::uint8_t to_code8(Tone tone, double v) noexcept;

/// Compresses a colour of any brightness to [0, 1] without a change of hue: the Khronos PBR Neutral
/// tone mapper, https://github.com/KhronosGroup/ToneMapping/blob/main/PBR_Neutral/README.md.
/// Negative components and NaN count as 0, infinity as the largest value that it accepts.
LinearRgb compress_neutrally(LinearRgb color) noexcept;

/// How the radiance of a picture becomes the codes of an 8-bit file.
struct ToneMapping {
  Tone tone = Tone::Srgb;
  double exposure = 0;  ///< in stops: radiance is first multiplied by 2^exposure

  friend bool operator==(const ToneMapping&, const ToneMapping&) = default;
};

/// "srgb", or "srgb with exposure 1.5".
std::string describe(const ToneMapping& mapping);

/// The 8-bit codes of red, green and blue.
std::array<std::uint8_t, 3> to_codes8(const ToneMapping& mapping, LinearRgb radiance) noexcept;

}  // namespace sdlc::render
