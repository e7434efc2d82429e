#include "lang/convert/config_facts.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/convert/config_number.hpp"
#include "lang/convert/material_names.hpp"

namespace sdlc::lang {
namespace {

constexpr std::uint32_t kValue = 1;        // the tape index of a member's value
constexpr std::size_t kMinRadiusUses = 4;  // fewer may be chance

const MaterialInfo& kind_of(const ConfigValue& material) {
  const std::string type = material.find("type")->value.string();
  const auto kinds = all_materials();
  return *std::ranges::find(kinds, type, &MaterialInfo::json_name);
}

/// The kind and the bits of all numbers of the material: a key for a hash table.
std::string identity_of(const ConfigValue& material) {
  const MaterialInfo& info = kind_of(material);
  std::string identity(1, static_cast<char>(info.id));
  const auto add = [&](double number) {
    std::array<char, sizeof number> bytes;
    std::memcpy(bytes.data(), &number, sizeof number);
    identity.append(bytes.data(), bytes.size());
  };
  for (const JsonKey& key : json_material_keys(info.id)) {
    const ConfigValue value = material.find(key.key)->value;
    if (key.type == JsonType::Number) add(value.number());
    if (key.type != JsonType::Color) continue;
    for (const ConfigValue& component : value.elements()) add(component.number());
  }
  return identity;
}

render::LinearRgb color_value(const ConfigValue& color) {
  const auto c = color.elements();
  return {c[0].number() / kWhite, c[1].number() / kWhite, c[2].number() / kWhite};
}

ConfigMaterial read_material(const ConfigValue& material) {
  const MaterialInfo& info = kind_of(material);
  ConfigMaterial read;
  std::vector<std::string> arguments;
  read.value.kind = info.id;
  for (const JsonKey& key : json_material_keys(info.id)) {
    const ConfigValue value = material.find(key.key)->value;
    const bool is_color = key.type == JsonType::Color;
    if (is_color) {
      read.value.color = color_value(value);
    } else {
      read.value.parameter = value.number();
    }
    const Property& argument = info.arguments[key.property];
    if (is_default(argument, key, value)) continue;
    arguments.push_back(fmt::format("{}: {}", argument.name,
                                    is_color ? color_text(value) : std::string(value.spelling())));
  }
  read.text = fmt::format("{}({})", info.name, fmt::join(arguments, ", "));
  return read;
}

/// Of equally frequent spellings the first in the text is the more common one.
bool is_less_common(const std::pair<const std::string_view, std::size_t>& a,
                    const std::pair<const std::string_view, std::size_t>& b) {
  return a.second != b.second ? a.second < b.second : a.first.data() > b.first.data();
}

/// "red" if each component is 0 or 1.
std::optional<std::string_view> pure_color(const std::vector<ConfigValue>& color) {
  static constexpr std::array<std::string_view, 8> kNames{"black", "blue",    "lime",   "cyan",
                                                          "red",   "magenta", "yellow", "white"};
  std::size_t index = 0;
  for (const ConfigValue& component : color) {
    const bool is_full = component.number() == kWhite;
    if (!is_full && !have_same_bits(component.number(), 0)) return std::nullopt;
    index = index * 2 + (is_full ? 1 : 0);
  }
  return kNames[index];
}

/// The components divided by 255, if their spelling is shorter.
std::optional<std::string> fraction_color(const std::vector<ConfigValue>& color) {
  std::string text;
  std::size_t plain_size = 0, size = 0;
  for (const ConfigValue& component : color) {
    const double fraction = component.number() / kWhite;
    // The conversion back must give the number in the config.
    const ScaledComponent back = to_config_scale(fraction, {});
    if (!back.is_exact || !have_same_bits(back.number, component.number())) return std::nullopt;
    const std::string spelling = config_number(fraction);
    text += (text.empty() ? "" : ", ") + spelling;
    size += spelling.size();
    plain_size += component.spelling().size();
  }
  if (size >= plain_size) return std::nullopt;
  return text;
}

}  // namespace

bool is_default(const Property& property, const JsonKey& key, const ConfigValue& value) {
  if (const auto* number = std::get_if<double>(&property.default_value)) {
    return have_same_bits(*number, value.number());
  }
  const auto* triple = std::get_if<std::array<double, 3>>(&property.default_value);
  if (triple == nullptr) return false;
  const double scale = key.type == JsonType::Color ? kWhite : 1;
  const auto v = value.elements();
  return have_same_bits((*triple)[0] * scale, v[0].number()) &&
         have_same_bits((*triple)[1] * scale, v[1].number()) &&
         have_same_bits((*triple)[2] * scale, v[2].number());
}

std::string triple_text(const ConfigValue& triple) {
  const auto v = triple.elements();
  return fmt::format("({}, {}, {})", v[0].spelling(), v[1].spelling(), v[2].spelling());
}

std::string color_text(const ConfigValue& color) {
  const std::vector<ConfigValue> components = color.elements();
  if (const auto name = pure_color(components)) return std::string(*name);
  if (const auto fractions = fraction_color(components)) {
    return fmt::format("linear({})", *fractions);
  }
  return "linear255" + triple_text(color);
}

void ConfigFacts::take_element(const Tape& tape, std::uint32_t element) {
  const ConfigValue sphere(*file_, tape, element);
  const ConfigValue material = sphere.find("material")->value;
  const auto [place, is_new] = indices_.emplace(identity_of(material), materials_.size());
  if (is_new) materials_.push_back(read_material(material));
  ConfigMaterial& counted = materials_[place->second];
  ++counted.uses;
  ++counted.radii[sphere.find("radius")->value.spelling()];
}

void ConfigFacts::take_member(const Tape& tape) {
  std::string buffer;
  if (member_name(*file_, tape[0], buffer) != "camera") return;
  has_shutter_ = tape[kValue].type == JsonNodeType::Object &&
                 ConfigValue(*file_, tape, kValue).find("time_interval");
}

void ConfigFacts::finish() {
  MaterialNames names;
  for (ConfigMaterial& material : materials_) {
    if (material.uses < 2) continue;
    material.name = names.name_of(material.value);
    const auto& [spelling, uses] = *std::ranges::max_element(material.radii, is_less_common);
    if (uses < kMinRadiusUses) continue;
    material.radius = {.spelling = spelling, .name = material.name + "_radius"};
  }
}

const ConfigMaterial& ConfigFacts::material_of(const ConfigValue& material) const {
  return materials_[indices_.at(identity_of(material))];
}

}  // namespace sdlc::lang
