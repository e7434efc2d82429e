#include "render/image/tone.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/math/exp2.hpp"

namespace sdlc::render {
namespace {

/// The encoding curve of IEC 61966-2-1 for v in [0, 1].
double encode_srgb(double v) noexcept {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

double decode_srgb(double v) noexcept {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// At most a value whose square and sums are finite; 0 for NaN.
double to_compressible(double v) noexcept {
  constexpr double kMaxRadiance = 1e100;
  return v > 0 ? std::min(v, kMaxRadiance) : 0;
}

}  // namespace

double encode_tone(Tone tone, double v) noexcept {
  // Written so that NaN takes this branch: every comparison with it is false.
  if (!(v > 0)) return 0;
  if (v >= 1) return 1;
  switch (tone) {
    case Tone::Srgb:
    case Tone::Neutral: return encode_srgb(v);
    case Tone::Sqrt: return std::sqrt(v);
    case Tone::Linear: return v;
  }
  return v;
}

double decode_tone(Tone tone, double encoded) noexcept {
  switch (tone) {
    case Tone::Srgb:
    case Tone::Neutral: return decode_srgb(encoded);
    case Tone::Sqrt: return encoded * encoded;
    case Tone::Linear: break;
  }
  return encoded;
}

std::string_view name_of(Tone tone) noexcept { return kToneWords[static_cast<std::size_t>(tone)]; }

std::optional<Tone> tone_of(std::string_view name) noexcept {
  const auto found = std::ranges::find(kToneWords, name);
  if (found == kToneWords.end()) return std::nullopt;
  return static_cast<Tone>(found - kToneWords.begin());
}

std::uint8_t to_code8(Tone tone, double v) noexcept {
  return static_cast<std::uint8_t>(std::lround(255 * encode_tone(tone, v)));
}

// The names are those of the specification, in lower case.
LinearRgb compress_neutrally(LinearRgb color) noexcept {
  constexpr double kF90 = 0.04;       // reflectance of a surface of ior 1.5, seen vertically
  constexpr double kKs = 0.8 - kF90;  // where compression starts
  constexpr double kKd = 0.15;        // speed of desaturation
  const LinearRgb in{to_compressible(color.r), to_compressible(color.g), to_compressible(color.b)};
  const double x = std::min({in.r, in.g, in.b});
  const double f = x <= 2 * kF90 ? x - x * x / (4 * kF90) : kF90;
  const LinearRgb offset = in - LinearRgb(f);
  const double p = std::max({offset.r, offset.g, offset.b});
  if (p <= kKs) return offset;
  const double pn = 1 - (1 - kKs) * (1 - kKs) / (p + 1 - 2 * kKs);
  const double g = 1 / (kKd * (p - pn) + 1);
  return offset * (pn / p * g) + LinearRgb(pn * (1 - g));
}

std::string describe(const ToneMapping& mapping) {
  const std::string_view tone = name_of(mapping.tone);
  if (mapping.exposure == 0) return std::string(tone);
  return fmt::format("{} with exposure {}", tone, mapping.exposure);
}

std::array<std::uint8_t, 3> to_codes8(const ToneMapping& mapping, LinearRgb radiance) noexcept {
  LinearRgb color = radiance * exp2_reproducible(mapping.exposure);
  if (mapping.tone == Tone::Neutral) color = compress_neutrally(color);
  return {to_code8(mapping.tone, color.r), to_code8(mapping.tone, color.g),
          to_code8(mapping.tone, color.b)};
}

}  // namespace sdlc::render
