#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "render/compare/difference.hpp"
#include "render/measure/measurement.hpp"

/// The small types of a measurement as JSON, both ways. Reading throws nlohmann::json::exception,
/// or std::invalid_argument for a word that is none.
namespace sdlc::cli {

using Json = nlohmann::ordered_json;

template <typename T, typename Convert>
Json array_json(const std::vector<T>& items, Convert convert) {
  Json array = Json::array();
  for (const T& item : items) array.push_back(convert(item));
  return array;
}

Json way_json(const render::Way& way);
render::Way way_of(const Json& json);

/// Adds "NAME" and "NAME_interval"; null where they are no numbers, which are read as NaN.
void put(Json& json, const std::string& name, const render::Measured& measured);
render::Measured measured_of(const Json& json, const std::string& name);

Json difference_json(const render::Difference& difference);
render::Difference difference_of(const Json& json);

}  // namespace sdlc::cli
