#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace sdlc::render {

/// The transfer curve from linear radiance to the codes of a display-referred picture.
enum class Tone : std::uint8_t { Srgb, Sqrt, Linear };

/// Encodes the linear value `v` to [0, 1]. `v` is clamped to [0, 1] first; NaN counts as 0. Srgb is
/// the curve of IEC 61966-2-1; Sqrt the square root (the JSON format's `gamma_correct`).
double encode_tone(Tone tone, double v) noexcept;

/// The inverse of encode_tone, for `encoded` in [0, 1].
double decode_tone(Tone tone, double encoded) noexcept;

/// The spelling in scenes, in the order of the enumerators.
inline constexpr std::array<std::string_view, 3> kToneWords{"srgb", "sqrt", "linear"};

std::string_view name_of(Tone tone) noexcept;
std::optional<Tone> tone_of(std::string_view name) noexcept;

/// The 8-bit code of a linear value: encode_tone scaled by 255 and rounded once, to nearest
/// (truncation would darken every picture by half a code).
std::uint8_t to_code8(Tone tone, double v) noexcept;

}  // namespace sdlc::render
