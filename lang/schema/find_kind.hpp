#pragma once

#include <algorithm>
#include <string_view>

#include "lang/schema/schema.hpp"

namespace sdlc::lang {

/// The kind of this name, or null.
inline const Kind* find_kind(std::string_view name) noexcept {
  const auto kinds = all_kinds();
  const auto found = std::ranges::find(kinds, name, &Kind::name);
  return found == kinds.end() ? nullptr : &*found;
}

}  // namespace sdlc::lang
