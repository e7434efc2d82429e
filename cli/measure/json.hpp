#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/report/member.hpp"
#include "cli/report/point_columns.hpp"
#include "render/compare/difference.hpp"
#include "render/measure/measurement.hpp"

/// JSON of the structs declared by kMembers. Files may be edited or truncated: readers throw
/// std::invalid_argument with a message that names the invalid field.
namespace sdlc::cli {

using Json = nlohmann::ordered_json;
/// An object with any names.
using NamedTexts = std::vector<std::pair<std::string, std::string>>;

Json parse_json(std::string_view text);
/// The field of this name.
const Json& field(const Json& json, const std::string& name);
/// Throws: "its `NAME` is WHAT".
[[noreturn]] void refuse_field(const std::string& name, const std::string& what);

/// Reads `json`, the value of the field `name`. nlohmann::json would convert numbers, which is
/// undefined for those that do not fit.
void read_value(const Json& json, const std::string& name, Range, bool& value);
void read_value(const Json& json, const std::string& name, Range, std::string& value);
void read_value(const Json& json, const std::string& name, Range range, int& value);
void read_value(const Json& json, const std::string& name, Range, std::uint64_t& value);
/// JSON has no infinity: null is infinity.
void read_value(const Json& json, const std::string& name, Range, double& value);
void read_value(const Json& json, const std::string& name, Range, render::Interval& value);
void read_value(const Json& json, const std::string& name, Range, render::LargestDifference& value);
void read_value(const Json& json, const std::string& name, Range, NamedTexts& value);

Json value_json(double value);
Json value_json(const render::Interval& value);
Json value_json(const render::LargestDifference& value);
Json value_json(const NamedTexts& value);

template <typename T>
concept Declared = !std::same_as<std::remove_cvref_t<decltype(kMembers<T>)>, std::nullptr_t>;

template <Declared T>
void write_members(Json& json, const T& object);
template <Declared T>
void read_members(const Json& json, T& object);

template <typename T>
Json value_json(const T& value) {
  if constexpr (Declared<T>) {
    Json json = Json::object();
    write_members(json, value);
    return json;
  } else if constexpr (render::Choice<T>) {
    return name_of(value);
  } else {
    return value;
  }
}
template <typename T>
Json value_json(const std::optional<T>& value) {
  return value ? value_json(*value) : Json();
}
template <typename T>
Json value_json(const std::vector<T>& values) {
  Json json = Json::array();
  for (const T& value : values) json.push_back(value_json(value));
  return json;
}

template <render::Choice T>
void read_value(const Json& json, const std::string& name, Range, T& value) {
  std::string word;
  read_value(json, name, {}, word);
  const auto choice = render::choice_named<T>(word);
  if (!choice) refuse_field(name, fmt::format("`{}`, which is unknown", word));
  value = *choice;
}
template <Declared T>
void read_value(const Json& json, const std::string&, Range, T& value) {
  read_members(json, value);
}
template <typename T>
void read_value(const Json& json, const std::string& name, Range range, std::optional<T>& value) {
  if (json.is_null()) return value.reset();
  read_value(json, name, range, value.emplace());
}
template <typename T>
void read_value(const Json& json, const std::string& name, Range range, std::vector<T>& values) {
  if (!json.is_array()) refuse_field(name, "not a list");
  for (const Json& item : json) {
    try {
      read_value(item, name, range, values.emplace_back());
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(
          fmt::format("`{}`, number {}: {}", name, values.size(), error.what()));
    }
  }
}

/// Declares a struct whose fields have the names of its members.
#define SDLC_MEMBERS(Type, ...)                                                             \
  template <>                                                                               \
  inline constexpr auto kMembers<Type> = [] {                                               \
    using Self = Type;                                                                      \
    return std::tuple{NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(SDLC_MEMBER, __VA_ARGS__))}; \
  }();
#define SDLC_MEMBER(member) Member(#member, &Self::member),

template <>
inline constexpr auto kMembers<render::Configuration> = std::apply(
    [](const auto&... settings) {
      return std::tuple{Member(
          settings.name, settings.member, Range{1},
          settings.name == render::kDenoise.name ? Presence::Optional : Presence::Required)...};
    },
    render::kConfigurationSettings);

template <>
inline constexpr std::tuple kMembers<render::Reference>{
    Member("configuration", &render::Reference::configuration),
    Member("samples", &render::Reference::samples, kSamplesRange),
    Member("seed", &render::Reference::seed),
    Member("seconds", &render::Reference::seconds),
    Member("relative_error", &render::Reference::error),
    Member("mean_radiance", &render::Reference::mean_radiance),
    Member("scarce_emitters", &render::Reference::scarce_emitters)};

/// The fields of a member of this name are fields of the struct itself.
inline constexpr std::string_view kInlined = "configuration";

/// A number with an interval is two fields: NAME and NAME_interval.
inline std::string interval_name(std::string_view name) { return std::string(name) + "_interval"; }

template <Declared T>
void write_members(Json& json, const T& object) {
  const auto write = [&](const auto& member) {
    const auto& value = std::invoke(member.access, object);
    using Value = std::remove_cvref_t<decltype(value)>;
    const std::string name(member.name);
    if constexpr (std::same_as<Value, render::Measured>) {
      json[name] = value_json(value.value);
      json[interval_name(name)] = value_json(value.interval);
    } else if constexpr (std::same_as<Value, std::optional<render::Measured>>) {
      json[name] = value ? value_json(value->value) : Json();
      json[interval_name(name)] = value ? value_json(value->interval) : Json();
    } else {
      if constexpr (std::same_as<Value, render::Configuration>) {
        if (name == kInlined) return write_members(json, value);
      }
      json[name] = value_json(value);
    }
  };
  std::apply([&](const auto&... members) { (write(members), ...); }, kMembers<T>);
}

template <Declared T>
void read_members(const Json& json, T& object) {
  const auto read = [&](const auto& member) {
    if constexpr (requires { member.range; }) {
      const std::string name(member.name);
      if (member.presence == Presence::Optional && !json.contains(name)) return;
      auto& value = std::invoke(member.access, object);
      using Value = std::remove_cvref_t<decltype(value)>;
      if constexpr (std::same_as<Value, render::Measured>) {
        read_value(field(json, name), name, {}, value.value);
        read_value(field(json, interval_name(name)), interval_name(name), {}, value.interval);
      } else if constexpr (Declared<Value>) {
        read_value(name == kInlined ? json : field(json, name), name, {}, value);
      } else {
        read_value(field(json, name), name, member.range, value);
      }
    }
  };
  std::apply([&](const auto&... members) { (read(members), ...); }, kMembers<T>);
}

}  // namespace sdlc::cli
