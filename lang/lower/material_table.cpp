#include "lang/lower/material_table.hpp"

#include <bit>

namespace sdlc::lang {
namespace {

std::uint64_t hash(const render::Material& material) {
  std::uint64_t h =
      static_cast<std::uint64_t>(material.type) * 2 + static_cast<std::uint64_t>(material.fresnel);
  for (const double v :
       {material.color.r, material.color.g, material.color.b, material.parameter}) {
    // Adding 0 turns -0, which equals 0, into 0.
    h = (h ^ std::bit_cast<std::uint64_t>(v + 0.0)) * 0x9E3779B97F4A7C15u;
    h ^= h >> 32;
  }
  return h;
}

}  // namespace

std::uint32_t MaterialTable::index_of(const render::Material& material) {
  if (2 * materials_.size() >= slots_.size()) grow();
  std::size_t slot = hash(material) & (slots_.size() - 1);
  for (; slots_[slot] != kEmpty; slot = (slot + 1) & (slots_.size() - 1)) {
    if (materials_[slots_[slot]] == material) return slots_[slot];
  }
  slots_[slot] = static_cast<std::uint32_t>(materials_.size());
  materials_.push_back(material);
  return slots_[slot];
}

void MaterialTable::grow() {
  slots_.assign(slots_.empty() ? 16 : 2 * slots_.size(), kEmpty);
  for (std::uint32_t i = 0; i < materials_.size(); ++i) {
    std::size_t slot = hash(materials_[i]) & (slots_.size() - 1);
    while (slots_[slot] != kEmpty) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = i;
  }
}

}  // namespace sdlc::lang
