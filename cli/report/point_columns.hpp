#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include "cli/numbers/format_numbers.hpp"
#include "cli/report/figures.hpp"
#include "cli/report/member.hpp"
#include "cli/report/section.hpp"
#include "render/compare/difference.hpp"
#include "render/measure/measurement.hpp"

namespace sdlc::cli {

/// A field of a point that is also a column of the table of all renders.
template <typename Field>
struct Column : Field {
  std::string_view heading;      ///< as in Table
  std::string_view explanation;  ///< a line below the table

  constexpr Column(Field field, std::string_view heading_, FigureText* format,
                   std::string_view explanation_ = {})
      : Field(field), heading(heading_), explanation(explanation_), format_(format) {}
  constexpr Column(Field field, std::string_view heading_, Cell (*make_cell)(const render::Point&),
                   std::string_view explanation_ = {})
      : Field(field), heading(heading_), explanation(explanation_), cell_(make_cell) {}

  Cell cell(const render::Point& point) const {
    if (cell_ != nullptr) return cell_(point);
    const auto& value = std::invoke(this->access, point);
    if constexpr (requires { value.interval; }) {
      return read(value, format_);
    } else if constexpr (requires { static_cast<double>(value); }) {
      return format_(static_cast<double>(value));
    } else {
      return std::string();
    }
  }

 private:
  FigureText* format_ = nullptr;
  Cell (*cell_)(const render::Point&) = nullptr;
};

/// The max number of samples of any render of a measurement, including the reference.
inline constexpr Range kSamplesRange{1, 1 << 27};

inline Cell samples_cell(const render::Point& point) {
  return format_whole(static_cast<std::uint64_t>(point.samples));
}

inline Cell largest_cell(const render::Point& point) {
  const auto& [value, x, y, channel] = point.difference.largest;
  return {figure(value),
          fmt::format("{} at ({}, {})", render::kChannelNames[static_cast<std::size_t>(channel)], x,
                      y)};
}

inline Cell status_cell(const render::Point& point) {
  const std::uint64_t scarce = point.scarce_emitters;
  return {std::string(words_of(point.dominance)),
          scarce == 0 ? "" : count_of(scarce, "emitter") + " rarely reached"};
}

/// Access to a member of the difference of a point.
template <typename T>
constexpr auto in_difference(T render::Difference::*member) {
  return [member](auto& point) -> auto& { return point.difference.*member; };
}

/// All fields of a point, in the order of JSON, CSV, the page and the terminal.
template <>
inline constexpr std::tuple kMembers<render::Point>{
    Column(Member("samples", &render::Point::samples, kSamplesRange), "#Samples", samples_cell),
    Member("configuration", &render::Point::configuration),
    Column(Member("seconds", &render::Point::seconds), "#Time", duration),
    Member("timings", &render::Point::timings),
    Column(Member("samples_per_second", &render::Point::samples_per_second), "-#Samples/s", rate),
    Column(Member("rays_per_second", &render::Point::rays_per_second), "-#Rays/s", rate),
    Column(Member("relative_error", &render::Point::error), "#Error", percent),
    Member("relative_error_spread", &render::Point::error_spread),
    Column(Member("rmse", in_difference(&render::Difference::rmse)), "-#RMSE", figure,
           "root mean square difference from the reference, in linear radiance"),
    Column(Member("relative_mse", in_difference(&render::Difference::relative_mse)), "-#relMSE",
           figure, "mean of the squared difference over the squared reference plus 0.01"),
    Column(
        Member("relative_mse_trimmed", in_difference(&render::Difference::trimmed_relative_mse)),
        "-#relMSE, trimmed (descriptive)", figure,
        "without the 1 % of pixels with the largest terms: it describes most of the picture, and "
        "is not used for decisions"),
    Member("psnr", in_difference(&render::Difference::psnr)),
    Column(
        Member("flip", &render::Point::flip), "#FLIP", figure,
        "how strongly a person who flips between the two pictures sees a difference, from 0 to 1"),
    Column(Member("max_difference", in_difference(&render::Difference::largest)),
           "-#Largest difference", largest_cell,
           "in one channel of one pixel, counted from the top left"),
    Column(Member("cut_paths", &render::Point::cut_paths), "-#Paths cut", percent,
           "by the depth limit, in percent of all"),
    Member("scarce_emitters", &render::Point::scarce_emitters),
    Column(Member("standing", &render::Point::dominance), "Status", status_cell),
    Member("rays", &render::Point::rays, {}, Presence::Optional),
};

}  // namespace sdlc::cli
