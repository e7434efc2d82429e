#include "lang/repair/property_names.hpp"

#include <algorithm>

#include "lang/schema/schema.hpp"

namespace sdlc::lang {
namespace {

/// Calls the function with every property and argument of the name until it returns true.
template <typename Function>
bool any_property(std::string_view name, Function is_wanted) {
  const auto has = [&](std::span<const Property> properties) {
    return std::ranges::any_of(properties, [&](const Property& property) {
      return property.name == name && is_wanted(property);
    });
  };
  return std::ranges::any_of(all_kinds(), has, &Kind::properties) ||
         std::ranges::any_of(all_materials(), has, &MaterialInfo::arguments);
}

}  // namespace

bool is_property_name(std::string_view name) noexcept {
  return any_property(name, [](const Property&) { return true; });
}

bool is_object_property(std::string_view name) noexcept {
  return std::ranges::any_of(all_kinds(), [&](const Kind& kind) {
    return std::ranges::find(kind.properties, name, &Property::name) != kind.properties.end();
  });
}

bool is_material(std::string_view name) noexcept {
  return std::ranges::count(all_materials(), name, &MaterialInfo::name) > 0;
}

bool is_argument_of(std::string_view material, std::string_view name) noexcept {
  return std::ranges::any_of(all_materials(), [&](const MaterialInfo& info) {
    return info.name == material &&
           std::ranges::find(info.arguments, name, &Property::name) != info.arguments.end();
  });
}

bool is_point_property(std::string_view name) noexcept {
  const auto is_point = [](const Property& property) {
    return property.type == Type::Vec3 || property.type == Type::Angles;
  };
  const auto is_other = [&](const Property& property) { return !is_point(property); };
  return any_property(name, is_point) && !any_property(name, is_other);
}

}  // namespace sdlc::lang
