#include "render/image/tone.hpp"

#include <cmath>

namespace sdlc::render {
namespace {

/// The encoding curve of IEC 61966-2-1 for v in [0, 1].
double encode_srgb(double v) noexcept {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

double decode_srgb(double v) noexcept {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

}  // namespace

double encode_tone(Tone tone, double v) noexcept {
  // Written so that NaN takes this branch: every comparison with it is false.
  if (!(v > 0)) return 0;
  if (v >= 1) return 1;
  switch (tone) {
    case Tone::Srgb: return encode_srgb(v);
    case Tone::Sqrt: return std::sqrt(v);
    case Tone::Linear: return v;
  }
  return v;
}

double decode_tone(Tone tone, double encoded) noexcept {
  switch (tone) {
    case Tone::Srgb: return decode_srgb(encoded);
    case Tone::Sqrt: return encoded * encoded;
    case Tone::Linear: break;
  }
  return encoded;
}

std::string_view name_of(Tone tone) noexcept { return kToneWords[static_cast<std::size_t>(tone)]; }

std::optional<Tone> tone_of(std::string_view name) noexcept {
  for (const Tone tone : {Tone::Srgb, Tone::Sqrt, Tone::Linear}) {
    if (name_of(tone) == name) return tone;
  }
  return std::nullopt;
}

std::uint8_t to_code8(Tone tone, double v) noexcept {
  return static_cast<std::uint8_t>(std::lround(255 * encode_tone(tone, v)));
}

}  // namespace sdlc::render
