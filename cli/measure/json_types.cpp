#include "cli/measure/json_types.hpp"

#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "render/scene/choices.hpp"

namespace sdlc::cli {
namespace {

constexpr std::array kPrecisions{render::Precision::Float, render::Precision::Mixed,
                                 render::Precision::Double};
constexpr std::array<std::string_view, 3> kChannels{"red", "green", "blue"};

template <typename T, std::size_t N>
T named(const std::array<T, N>& choices, const std::string& word) {
  for (const T choice : choices) {
    if (name_of(choice) == word) return choice;
  }
  throw std::invalid_argument(fmt::format("`{}` is no word of a measurement", word));
}

// JSON has no infinity.
Json finite_or_null(double number) { return std::isfinite(number) ? Json(number) : Json(); }
double number_or(double otherwise, const Json& json) {
  return json.is_null() ? otherwise : json.get<double>();
}

}  // namespace

Json way_json(const render::Way& way) {
  return {{"sampler", name_of(way.sampler)},
          {"light_sampling", name_of(way.light_sampling)},
          {"precision", name_of(way.precision)},
          {"depth", way.depth}};
}

render::Way way_of(const Json& json) {
  return {.sampler = named(render::kSamplerKinds, json.at("sampler")),
          .light_sampling = named(render::kLightSamplings, json.at("light_sampling")),
          .precision = named(kPrecisions, json.at("precision")),
          .depth = json.at("depth")};
}

void put(Json& json, const std::string& name, const render::Measured& measured) {
  json[name] = finite_or_null(measured.value);
  json[name + "_interval"] = {finite_or_null(measured.interval.from),
                              finite_or_null(measured.interval.to)};
}

render::Measured measured_of(const Json& json, const std::string& name) {
  const Json& interval = json.at(name + "_interval");
  return {number_or(NAN, json.at(name)),
          {number_or(NAN, interval.at(0)), number_or(NAN, interval.at(1))}};
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
            {"channel", kChannels[static_cast<std::size_t>(channel)]}}}};
}

render::Difference difference_of(const Json& json) {
  const Json& largest = json.at("max_difference");
  const auto channel = std::ranges::find(kChannels, largest.at("channel").get<std::string>());
  if (channel == kChannels.end()) throw std::invalid_argument("a channel has no such name");
  return {.rmse = json.at("rmse"),
          .relative_error = number_or(INFINITY, json.at("relative_error")),
          .relative_mse = json.at("relative_mse"),
          .trimmed_relative_mse = json.at("relative_mse_trimmed"),
          .psnr = number_or(INFINITY, json.at("psnr")),
          .largest = {.value = largest.at("value"),
                      .x = largest.at("x"),
                      .y = largest.at("y"),
                      .channel = static_cast<int>(channel - kChannels.begin())}};
}

}  // namespace sdlc::cli
