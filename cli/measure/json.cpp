#include "cli/measure/json.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace sdlc::cli {

Json parse_json(std::string_view text) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw std::invalid_argument(fmt::format("it is not valid JSON from byte {} on", error.byte));
  } catch (const Json::exception&) {
    throw std::invalid_argument("it has a number that is too large");
  }
}

void refuse_field(const std::string& name, const std::string& what) {
  throw std::invalid_argument(fmt::format("its `{}` is {}", name, what));
}

const Json& field(const Json& json, const std::string& name) {
  if (!json.is_object()) throw std::invalid_argument(fmt::format("no object has `{}`", name));
  const auto found = json.find(name);
  if (found == json.end()) refuse_field(name, "missing");
  return *found;
}

void read_value(const Json& json, const std::string& name, Range, bool& value) {
  if (!json.is_boolean()) refuse_field(name, "neither true nor false");
  value = json.get<bool>();
}

void read_value(const Json& json, const std::string& name, Range, std::string& value) {
  if (!json.is_string()) refuse_field(name, "no text");
  value = json.get<std::string>();
}

void read_value(const Json& json, const std::string& name, Range range, int& value) {
  // Rejects numbers with a point or an exponent; those beyond 63 bits become negative.
  const bool is_in_range = json.is_number_integer() &&
                           json.get<std::int64_t>() >= std::max(range.min, std::int64_t{0}) &&
                           json.get<std::int64_t>() <= range.max;
  if (!is_in_range) {
    refuse_field(name, fmt::format("not a whole number from {} to {}", range.min, range.max));
  }
  value = json.get<int>();
}

void read_value(const Json& json, const std::string& name, Range, std::uint64_t& value) {
  if (!json.is_number_unsigned()) refuse_field(name, "not a whole number from 0 on");
  value = json.get<std::uint64_t>();
}

void read_value(const Json& json, const std::string& name, Range, double& value) {
  if (!json.is_number() && !json.is_null()) refuse_field(name, "no number");
  value = json.is_null() ? INFINITY : json.get<double>();
}

void read_value(const Json& json, const std::string& name, Range, render::Interval& value) {
  if (!json.is_array() || json.size() != 2) refuse_field(name, "not a list of two");
  read_value(json[0], name, {}, value.from);
  read_value(json[1], name, {}, value.to);
}

void read_value(const Json& json, const std::string&, Range, render::LargestDifference& value) {
  std::string channel;
  read_value(field(json, "value"), "value", {}, value.value);
  read_value(field(json, "x"), "x", {}, value.x);
  read_value(field(json, "y"), "y", {}, value.y);
  read_value(field(json, "channel"), "channel", {}, channel);
  const auto found = std::ranges::find(render::kChannelNames, channel);
  if (found == render::kChannelNames.end()) {
    refuse_field("channel", fmt::format("`{}`, which is unknown", channel));
  }
  value.channel = static_cast<int>(found - render::kChannelNames.begin());
}

void read_value(const Json& json, const std::string& name, Range, NamedTexts& value) {
  if (!json.is_object()) refuse_field(name, "not an object");
  for (const auto& [key, text] : json.items()) {
    read_value(text, key, {}, value.emplace_back(key, "").second);
  }
}

Json value_json(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json value_json(const render::Interval& value) {
  return {value_json(value.from), value_json(value.to)};
}

Json value_json(const render::LargestDifference& value) {
  return {{"value", value_json(value.value)},
          {"x", value.x},
          {"y", value.y},
          {"channel", render::kChannelNames[static_cast<std::size_t>(value.channel)]}};
}

Json value_json(const NamedTexts& value) {
  Json json = Json::object();
  for (const auto& [name, text] : value) json[name] = text;
  return json;
}

}  // namespace sdlc::cli
