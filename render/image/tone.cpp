#include "render/image/tone.hpp"

#include <cmath>

namespace sdlc::render {
namespace {

/// The encoding curve of IEC 61966-2-1 for v in [0, 1].
double encode_srgb(double v) noexcept {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

}  // namespace

double encode_tone(Tone tone, double v) noexcept {
  // Written so that a NaN takes the first way out: every comparison with it is false.
  if (!(v > 0)) return 0;
  if (v >= 1) return 1;
  switch (tone) {
    case Tone::Srgb: return encode_srgb(v);
    case Tone::Sqrt: return std::sqrt(v);
    case Tone::Linear: return v;
  }
  return v;
}

std::uint8_t to_code8(Tone tone, double v) noexcept {
  return static_cast<std::uint8_t>(std::lround(255 * encode_tone(tone, v)));
}

}  // namespace sdlc::render
