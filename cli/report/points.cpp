#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/numbers/format_numbers.hpp"
#include "cli/report/chart.hpp"
#include "cli/report/figures.hpp"
#include "cli/report/html.hpp"
#include "cli/report/sections.hpp"

namespace sdlc::cli {
namespace {

std::string rate(double a_second) {
  return std::isfinite(a_second) && a_second >= 0 ? format_count(a_second) : "unknown";
}

std::string place_of(const render::LargestDifference& largest) {
  return fmt::format("{} at ({}, {})",
                     render::kChannelNames[static_cast<std::size_t>(largest.channel)], largest.x,
                     largest.y);
}

std::string plain(double number) { return figure(number); }

void write_point(const render::Point& point, HtmlTable& table) {
  const Reading seconds = read(point.seconds, duration), error = read(point.error, percent);
  const std::string scarce =
      point.scarce_emitters == 0
          ? ""
          : fmt::format("{} rarely reached", count_of(point.scarce_emitters, "emitter"));
  table.row()
      .cell(format_whole(static_cast<std::uint64_t>(point.samples)))
      .cell(seconds.value, seconds.interval)
      .cell(error.value, error.interval)
      .cell(words_of(point.dominance), scarce)
      .cell(rate(point.samples_per_second))
      .cell(rate(point.rays_per_second))
      .cell(figure(point.difference.rmse))
      .cell(figure(point.difference.relative_mse))
      .cell(figure(point.difference.trimmed_relative_mse))
      .cell(figure(point.flip))
      .cell(figure(point.difference.largest.value), place_of(point.difference.largest))
      .cell(percent(point.cut_share));
}

std::string points_table(const render::Measurement& measurement) {
  HtmlTable table("All renders, by configuration and samples",
                  "#Samples|#Time|#Error|Status|#Samples/s|#Rays/s|#RMSE|#relMSE|#relMSE, trimmed "
                  "(descriptive)|#FLIP|#Largest difference|#Paths cut");
  for (std::size_t i = 0; i < measurement.series.size(); ++i) {
    const render::Series& series = measurement.series[i];
    table.group(fmt::format(
        "{} {} {}{}", legend_sample(i), series_key(i),
        escaped(describe_configuration(series.configuration)),
        series.slope ? fmt::format(" <small>slope {}</small>", read(*series.slope, plain).text())
                     : ""));
    for (const std::size_t index : series.points) write_point(measurement.points[index], table);
  }
  return std::move(table).finish();
}

std::string left_out_table(const render::Measurement& measurement) {
  HtmlTable table("What was left out", "#Samples|Configuration|Why");
  for (const render::LeftOut& left : measurement.left_out) {
    table.row()
        .cell(left.samples > 0 ? format_whole(static_cast<std::uint64_t>(left.samples)) : "all")
        .cell(escaped(describe_configuration(left.configuration)))
        .cell(escaped(left.reason));
  }
  return std::move(table).finish();
}

}  // namespace

std::string_view words_of(render::Dominance dominance) {
  switch (dominance) {
    case render::Dominance::Front: return "on the front";
    case render::Dominance::NotDistinguished: return "not distinguishable";
    default: return "dominated";
  }
}

std::string points_section(const Report& report) {
  const render::Measurement& measurement = report.measurement;
  std::string html;
  if (measurement.points.empty()) {
    html = "<p>No render was measured.</p>\n";
  } else {
    html = points_table(measurement);
    html +=
        "<p class=\"fine\">RMSE: root mean square difference from the reference, in linear "
        "radiance. relMSE: mean of the squared difference over the squared reference plus 0.01; "
        "trimmed, without the 1 % of pixels with the largest terms: it describes most of the "
        "picture, and is not used for decisions. FLIP: how strongly a person who flips between the "
        "two pictures sees a difference, from 0 to 1. Largest difference: in one channel of one "
        "pixel, counted from the top left. Paths cut: by the depth limit, in percent of all.</p>\n";
  }
  if (!measurement.left_out.empty()) html += left_out_table(measurement);
  return html;
}

}  // namespace sdlc::cli
