#pragma once

#include <string>
#include <string_view>

#include "lang/schema/schema.hpp"

/// Texts of the JSON format, and the rows of its tables as text.
namespace sdlc::lang {

/// Whether a JSON text, complete or not, is meant to be a config: it has two or more of the keys of
/// a config. Editors open many other JSON files.
bool looks_like_config(std::string_view text);

/// "a number, at least 0, required"
std::string describe_key(const JsonKey& key);
/// `material`: whose key it is; null for other keys.
std::string_view documentation_of(const JsonKey& key, const MaterialInfo* material) noexcept;

}  // namespace sdlc::lang
