#include "cli/measure/json_types.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "render/measure/configuration.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::cli {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw std::invalid_argument(fmt::format("its `{}` is {}", name, what));
}

void read_setting(const Json& json, const std::string& name, int& value) {
  value = whole_field(json, name, 1);
}

template <render::Choice T>
void read_setting(const Json& json, const std::string& name, T& value) {
  const std::string word = field<std::string>(json, name);
  const auto choice = render::choice_named<T>(word);
  if (!choice) refuse(name, fmt::format("`{}`, which is unknown", word));
  value = *choice;
}

// JSON has no infinity.
Json finite_or_null(double number) { return std::isfinite(number) ? Json(number) : Json(); }
double number_or(double otherwise, const Json& json, const std::string& name) {
  return json.is_null() ? otherwise : number_of(json, name);
}

}  // namespace

Json parse_json(std::string_view text) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw std::invalid_argument(fmt::format("it is not valid JSON from byte {} on", error.byte));
  } catch (const Json::exception&) {
    throw std::invalid_argument("it has a number that is too large");
  }
}

const Json& any_field(const Json& json, const std::string& name) {
  if (!json.is_object()) {
    throw std::invalid_argument(fmt::format("no object has `{}`", name));
  }
  const auto found = json.find(name);
  if (found == json.end()) refuse(name, "missing");
  return *found;
}

double number_of(const Json& json, const std::string& name) {
  if (!json.is_number()) refuse(name, "no number");
  const double number = json.get<double>();
  if (!std::isfinite(number)) refuse(name, "not a finite number");
  return number;
}

std::int64_t whole_of(const Json& json, const std::string& name, std::int64_t min,
                      std::int64_t max) {
  // Rejects numbers with a point or an exponent; integers beyond 64 bits are parsed as such.
  const bool is_in_range = json.is_number_unsigned()
                               ? std::cmp_less_equal(json.get<std::uint64_t>(), max) &&
                                     std::cmp_greater_equal(json.get<std::uint64_t>(), min)
                               : json.is_number_integer() && json.get<std::int64_t>() >= min &&
                                     json.get<std::int64_t>() <= max;
  if (!is_in_range) refuse(name, fmt::format("not a whole number from {} to {}", min, max));
  return json.get<std::int64_t>();
}

std::uint64_t natural_of(const Json& json, const std::string& name) {
  if (!json.is_number_unsigned()) refuse(name, "not a whole number from 0 on");
  return json.get<std::uint64_t>();
}

std::string string_of(const Json& json, const std::string& name) {
  if (!json.is_string()) refuse(name, "no text");
  return json.get<std::string>();
}

bool bool_of(const Json& json, const std::string& name) {
  if (!json.is_boolean()) refuse(name, "neither true nor false");
  return json.get<bool>();
}

int whole_field(const Json& json, const std::string& name, int min, int max) {
  return static_cast<int>(whole_of(any_field(json, name), name, min, max));
}

double positive_field(const Json& json, const std::string& name) {
  const double number = field<double>(json, name);
  if (!(number > 0)) refuse(name, "not above 0");
  return number;
}

Json configuration_json(const render::Configuration& configuration) {
  Json json;
  render::for_each_configuration_setting([&](const auto& setting) {
    json[std::string(setting.name)] = render::shown(configuration.*setting.member);
  });
  return json;
}

render::Configuration configuration_of(const Json& json) {
  render::Configuration configuration;
  render::for_each_configuration_setting([&](const auto& setting) {
    read_setting(json, std::string(setting.name), configuration.*setting.member);
  });
  return configuration;
}

void put(Json& json, const std::string& name, const render::Measured& measured) {
  json[name] = finite_or_null(measured.value);
  json[name + "_interval"] = {finite_or_null(measured.interval.from),
                              finite_or_null(measured.interval.to)};
}

render::Measured measured_of(const Json& json, const std::string& name) {
  const std::string both = name + "_interval";
  const Json& interval = any_field(json, both);
  if (!interval.is_array() || interval.size() != 2) refuse(both, "not a list of two");
  return {number_or(INFINITY, any_field(json, name), name),
          {number_or(INFINITY, interval[0], both), number_or(INFINITY, interval[1], both)}};
}

Json difference_json(const render::Difference& difference) {
  const auto& [value, x, y, channel] = difference.largest;
  return {{"rmse", difference.rmse},
          {"relative_error", finite_or_null(difference.relative_error)},
          {"relative_mse", difference.relative_mse},
          {"relative_mse_trimmed", difference.trimmed_relative_mse},
          {"psnr", finite_or_null(difference.psnr)},
          {"max_difference",
           {{"value", value},
            {"x", x},
            {"y", y},
            {"channel", render::kChannelNames[static_cast<std::size_t>(channel)]}}}};
}

render::Difference difference_of(const Json& json) {
  const Json& largest = any_field(json, "max_difference");
  const std::string name = field<std::string>(largest, "channel");
  const auto channel = std::ranges::find(render::kChannelNames, name);
  if (channel == render::kChannelNames.end())
    refuse("channel", fmt::format("`{}`, which is unknown", name));
  const auto number_or_infinity = [&](const char* field) {
    return number_or(INFINITY, any_field(json, field), field);
  };
  return {.rmse = field<double>(json, "rmse"),
          .relative_error = number_or_infinity("relative_error"),
          .relative_mse = field<double>(json, "relative_mse"),
          .trimmed_relative_mse = field<double>(json, "relative_mse_trimmed"),
          .psnr = number_or_infinity("psnr"),
          .largest = {.value = field<double>(largest, "value"),
                      .x = whole_field(largest, "x", 0),
                      .y = whole_field(largest, "y", 0),
                      .channel = static_cast<int>(channel - render::kChannelNames.begin())}};
}

}  // namespace sdlc::cli
