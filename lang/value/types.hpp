#pragma once

#include <span>
#include <string_view>

#include "lang/object/value.hpp"

namespace sdlc::lang {

/// A type that declarations of params and parameters may name.
struct TypeInfo {
  std::string_view name;
  bool (*holds)(const Value& value);
  std::string_view doc;
};

std::span<const TypeInfo> all_types() noexcept;
/// The type with this name, or null.
const TypeInfo* find_type(std::string_view name) noexcept;

}  // namespace sdlc::lang
