#pragma once

#include <string_view>

/// Queries of the schema by the name of a property or material.
namespace sdlc::lang {

/// Whether an object or a material of the language has a property of this name.
bool is_property_name(std::string_view name) noexcept;
bool is_object_property(std::string_view name) noexcept;
bool is_material(std::string_view name) noexcept;
/// Whether the language has the material, and it has the argument.
bool is_argument_of(std::string_view material, std::string_view name) noexcept;
/// Whether every property of this name is a point or three angles.
bool is_point_property(std::string_view name) noexcept;

}  // namespace sdlc::lang
