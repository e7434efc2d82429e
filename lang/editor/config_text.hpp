#pragma once

#include <string>
#include <string_view>

#include "lang/schema/schema.hpp"

/// Rows of the tables of the JSON format as text.
namespace sdlc::lang {

/// "a number, at least 0, required"
std::string describe_key(const JsonKey& key);
/// `material`: whose key it is; null for other keys.
std::string_view documentation_of(const JsonKey& key, const MaterialInfo* material) noexcept;

}  // namespace sdlc::lang
