#include "lang/lower/material_table.hpp"

#include <array>
#include <bit>
#include <utility>

namespace sdlc::lang {
namespace {

std::uint32_t hash(const render::Material& material) {
  std::uint64_t h =
      static_cast<std::uint64_t>(material.type) * 2 + static_cast<std::uint64_t>(material.fresnel);
  for (const double v :
       {material.color.r, material.color.g, material.color.b, material.parameter}) {
    // Adding 0 turns -0, which equals 0, into 0.
    h = (h ^ std::bit_cast<std::uint64_t>(v + 0.0)) * 0x9E3779B97F4A7C15u;
    h ^= h >> 32;
  }
  return static_cast<std::uint32_t>(h);
}

}  // namespace

render::Material lower_material(const MaterialValue& value) noexcept {
  using render::MaterialType;
  static constexpr std::array kTypes{MaterialType::Diffuse, MaterialType::Specular,
                                     MaterialType::Transmissive, MaterialType::Emissive,
                                     MaterialType::Unlit};
  return {.color = value.color,
          .parameter = value.parameter,
          .type = kTypes[static_cast<std::size_t>(value.kind)],
          .fresnel = value.exact_fresnel ? render::Fresnel::Exact : render::Fresnel::Schlick};
}

bool has_finite_light(const render::Material& material) noexcept {
  return material.type != render::MaterialType::Emissive ||
         is_finite(material.color * material.parameter);
}

std::uint32_t MaterialTable::index_of(const render::Material& material) {
  if (2 * materials_.size() >= slots_.size()) grow();
  const std::uint32_t own_hash = hash(material);
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = own_hash & mask;
  for (; slots_[i].index != kEmpty; i = (i + 1) & mask) {
    if (slots_[i].hash == own_hash && materials_[slots_[i].index] == material) {
      return slots_[i].index;
    }
  }
  const auto index = static_cast<std::uint32_t>(materials_.size());
  slots_[i] = {.hash = own_hash, .index = index};
  materials_.push_back(material);
  return index;
}

void MaterialTable::grow() {
  const std::vector<Slot> old =
      std::exchange(slots_, std::vector<Slot>(slots_.empty() ? 16 : 2 * slots_.size()));
  const std::size_t mask = slots_.size() - 1;
  for (const Slot& slot : old) {
    if (slot.index == kEmpty) continue;
    std::size_t i = slot.hash & mask;
    while (slots_[i].index != kEmpty) i = (i + 1) & mask;
    slots_[i] = slot;
  }
}

}  // namespace sdlc::lang
