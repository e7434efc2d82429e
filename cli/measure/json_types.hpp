#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "render/compare/difference.hpp"
#include "render/measure/measurement.hpp"

/// Conversion of the small types of a measurement to and from JSON. Files may be edited or
/// truncated: the readers throw std::invalid_argument with a message that names the invalid field.
namespace sdlc::cli {

using Json = nlohmann::ordered_json;

template <typename T, typename Convert>
Json array_json(const std::vector<T>& items, Convert convert) {
  Json array = Json::array();
  for (const T& item : items) array.push_back(convert(item));
  return array;
}

/// Parses JSON.
Json parse_json(std::string_view text);

/// The field of this name, of any type.
const Json& any_field(const Json& json, const std::string& name);

/// The value of `json`, called `name` in messages: a finite number, or an integer from `min` to
/// `max`. Reading it with nlohmann::json would convert it, which is undefined for numbers that do
/// not fit.
double number_of(const Json& json, const std::string& name);
std::int64_t whole_of(const Json& json, const std::string& name, std::int64_t min,
                      std::int64_t max);
std::uint64_t natural_of(const Json& json, const std::string& name);
std::string string_of(const Json& json, const std::string& name);
bool bool_of(const Json& json, const std::string& name);

/// The field of this name and type.
template <typename T>
T field(const Json& json, const std::string& name) {
  const Json& value = any_field(json, name);
  if constexpr (std::same_as<T, bool>) {
    return bool_of(value, name);
  } else if constexpr (std::same_as<T, double>) {
    return number_of(value, name);
  } else if constexpr (std::same_as<T, std::uint64_t>) {
    return natural_of(value, name);
  } else {
    static_assert(std::same_as<T, std::string>);
    return string_of(value, name);
  }
}

/// A whole number of at least `min`.
int whole_field(const Json& json, const std::string& name, int min,
                int max = std::numeric_limits<int>::max());
/// A number above 0.
double positive_field(const Json& json, const std::string& name);

/// A list field, with each of its items converted.
template <typename Convert>
auto list_field(const Json& json, const std::string& name, Convert convert) {
  const Json& list = any_field(json, name);
  if (!list.is_array()) throw std::invalid_argument(fmt::format("its `{}` is not a list", name));
  std::vector<decltype(convert(list))> items;
  for (const Json& item : list) {
    try {
      items.push_back(convert(item));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(
          fmt::format("`{}`, number {}: {}", name, items.size() + 1, error.what()));
    }
  }
  return items;
}

/// The max number of samples of any render of a measurement, including the reference.
inline constexpr int kMaxMeasuredSamples = 1 << 27;

Json configuration_json(const render::Configuration& configuration);
render::Configuration configuration_of(const Json& json);

/// Adds "NAME" and "NAME_interval"; null for numbers that are not finite, which are read back as
/// infinity.
void put(Json& json, const std::string& name, const render::Measured& measured);
render::Measured measured_of(const Json& json, const std::string& name);

Json difference_json(const render::Difference& difference);
render::Difference difference_of(const Json& json);

}  // namespace sdlc::cli
