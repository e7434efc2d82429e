#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace sdlc::lang {

/// The types that a parameter can be declared with.
inline constexpr auto kTypeNames =
    std::to_array<std::string_view>({"number", "bool", "string", "vec3", "angle", "angles", "color",
                                     "interval", "list", "material"});

constexpr bool is_type_name(std::string_view name) noexcept {
  return std::find(kTypeNames.begin(), kTypeNames.end(), name) != kTypeNames.end();
}

}  // namespace sdlc::lang
