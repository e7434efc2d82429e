#pragma once

#include <string>
#include <string_view>

#include "lang/schema/schema.hpp"

/// Rows of the tables as text, for the reference and for editors. Code is in backticks, as in
/// Markdown.
namespace sdlc::lang {

/// The accepted values: "a number, at least 0", "`srgb`, `sqrt` or `linear`".
std::string describe_values(const Property& property);
/// The default as in a scene, "required", or empty if the property is optional without a default.
std::string describe_default(const Property& property);

/// What a key of the JSON format means: its own documentation or that of the property that it sets.
/// Empty for a key of a material.
std::string_view doc_of(const JsonKey& key) noexcept;

}  // namespace sdlc::lang
