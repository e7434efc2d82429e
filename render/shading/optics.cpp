#include "render/shading/optics.hpp"

#include <bit>
#include <cstddef>

namespace sdlc::render {
namespace {

constexpr std::uint32_t kNoRow = 0xFFFFFFFF;

std::uint32_t surface_bits(const Material& material) noexcept {
  switch (material.type) {
    case MaterialType::Diffuse: return 0;
    case MaterialType::Specular:
      return kMirrors | (material.parameter > 0 ? kIsFuzzy : 0u) |
             (is_rough(material) ? kIsRough : 0u) | (is_wide(material) ? kIsWide : 0u);
    case MaterialType::Transmissive:
      return material.fresnel == Fresnel::Exact ? kRefracts | kIsExact : kRefracts;
    default: return kEndsPath;
  }
}

std::uint64_t bits_of(const Optics& optics) noexcept {
  return std::bit_cast<std::uint64_t>(optics.parameter);
}

bool are_same(const Optics& a, const Optics& b) noexcept {
  return a.surface == b.surface && bits_of(a) == bits_of(b);
}

std::size_t hash(const Optics& optics) noexcept {
  std::uint64_t h = (bits_of(optics) ^ optics.surface) * 0x9E3779B97F4A7C15u;
  h ^= h >> 32;
  return h * 0x9E3779B97F4A7C15u >> 32;
}

}  // namespace

Optics optics_of(const Material& material) noexcept {
  const std::uint32_t surface = surface_bits(material);
  return {.surface = surface,
          .parameter = (surface & (kMirrors | kRefracts)) != 0 ? material.parameter : 0};
}

std::uint32_t OpticsTable::row_of(const Optics& optics) {
  if (2 * rows_.size() >= places_.size()) grow();
  std::uint32_t& row = place_of(optics);
  if (row == kNoRow) {
    row = static_cast<std::uint32_t>(rows_.size());
    rows_.push_back(optics);
  }
  return row;
}

std::uint32_t& OpticsTable::place_of(const Optics& optics) {
  const std::size_t mask = places_.size() - 1;
  std::size_t i = hash(optics) & mask;
  while (places_[i] != kNoRow && !are_same(rows_[places_[i]], optics)) i = (i + 1) & mask;
  return places_[i];
}

void OpticsTable::grow() {
  places_.assign(places_.empty() ? 16 : 2 * places_.size(), kNoRow);
  for (std::uint32_t row = 0; row < rows_.size(); ++row) place_of(rows_[row]) = row;
}

}  // namespace sdlc::render
