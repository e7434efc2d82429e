#pragma once

#include <string_view>

#include "lang/source/source.hpp"

/// What the text around a mistake says about its fix: whether it is certainly what was meant.
namespace sdlc::lang {

/// Whether an object or a material of the language has a property of this name.
bool is_property_name(std::string_view name) noexcept;
bool is_object_property(std::string_view name) noexcept;
bool is_material(std::string_view name) noexcept;
/// Whether the language has the material, and it has the argument.
bool is_argument_of(std::string_view material, std::string_view name) noexcept;
/// Whether the property of this name is a point or three angles wherever there is one.
bool is_point_property(std::string_view name) noexcept;

/// Whether the sign at `sign`, of another language, has operands that leave no doubt about what it
/// stands for. Precondition: find_foreign_sign() knows it.
bool is_certain_sign(std::string_view text, Span sign) noexcept;
/// Whether nothing but the end of a statement can be meant by the `;` at `at`.
bool ends_statement(std::string_view text, std::uint32_t at) noexcept;
/// The closing quote that belongs to the typographic one at `opening`; empty if there is none, or
/// if the text between them would not be a string.
Span closing_quote(std::string_view text, Span opening) noexcept;
/// Whether this text in double quotes is a string of the same content.
bool is_plain_string(std::string_view content) noexcept;

}  // namespace sdlc::lang
