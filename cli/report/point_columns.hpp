#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <tuple>

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
  FigureText* format;            ///< for numbers
  std::string_view explanation;  ///< a line below the table

  constexpr Column(Field field, std::string_view heading_, FigureText* format_,
                   std::string_view explanation_ = {})
      : Field(field), heading(heading_), format(format_), explanation(explanation_) {}

  Cell cell(const render::Point& point) const {
    const auto& value = std::invoke(this->access, point);
    if constexpr (requires { value.interval; }) {
      return read(value, format);
    } else if constexpr (requires { words_of(value); }) {
      return std::string(words_of(value));
    } else {
      return format(static_cast<double>(value));
    }
  }
};

/// The max number of samples of any render of a measurement, including the reference.
inline constexpr Range kSamplesRange{1, 1 << 27};

/// Access to a member of the difference of a point.
template <typename T>
constexpr auto in_difference(T render::Difference::*member) {
  return [member](auto& point) -> auto& { return point.difference.*member; };
}

/// All fields of a point, in the order of JSON, CSV, the page and the terminal.
template <>
inline constexpr std::tuple kMembers<render::Point>{
    Column(Member("samples", &render::Point::samples, kSamplesRange), "#Samples", whole),
    Member("configuration", &render::Point::configuration),
    Column(Member("seconds", &render::Point::seconds), "#Time", duration),
    Member("timings", &render::Point::timings),
    Member("samples_per_second", &render::Point::samples_per_second),
    Column(Member("rays_per_second", &render::Point::rays_per_second), "-#Rays/s", rate),
    Column(Member("relative_error", &render::Point::error), "#Error", percent),
    Member("relative_error_spread", &render::Point::error_spread),
    Column(Member("rmse", in_difference(&render::Difference::rmse)), "-#RMSE", figure,
           "root mean square difference from the reference, in linear radiance"),
    Column(Member("relative_mse", in_difference(&render::Difference::relative_mse)), "-#relMSE",
           figure, "mean of the squared difference over the squared reference plus 0.01"),
    Member("relative_mse_trimmed", in_difference(&render::Difference::trimmed_relative_mse)),
    Member("psnr", in_difference(&render::Difference::psnr)),
    Column(
        Member("flip", &render::Point::flip), "#FLIP", figure,
        "how strongly a person who flips between the two pictures sees a difference, from 0 to 1"),
    Member("max_difference", in_difference(&render::Difference::largest)),
    Column(Member("cut_paths", &render::Point::cut_paths), "-#Paths cut", percent,
           "by the depth limit, in percent of all"),
    Column(Member("scarce_emitters", &render::Point::scarce_emitters), "-#Emitters rarely reached",
           whole, "emissive spheres that very few paths reached"),
    Column(Member("standing", &render::Point::dominance), "Status", nullptr),
    Member("rays", &render::Point::rays, {}, Presence::Optional),
};

}  // namespace sdlc::cli
