#pragma once

#include <string_view>
#include <vector>

namespace sdlc::lang {

/// The value of the name in a map, or null.
template <typename Map>
const typename Map::mapped_type* find_in(const Map& map, std::string_view name) {
  const auto found = map.find(name);
  return found == map.end() ? nullptr : &found->second;
}

/// The names of declarations, properties or functions: candidates for nearest_name().
template <typename Range>
std::vector<std::string_view> names_of(const Range& range) {
  std::vector<std::string_view> names;
  for (const auto& named : range) names.push_back(named.name);
  return names;
}

}  // namespace sdlc::lang
