#include <utility>

#include <fmt/format.h>

#include "cli/report/chart.hpp"
#include "cli/report/html.hpp"
#include "cli/report/sections.hpp"

namespace sdlc::cli {
namespace {

std::string plain_tick(double number) { return figure(number, 6); }

/// `y` maps a depth to the plotted value.
template <typename Y>
Chart chart_over_depth(const render::Measurement& measurement, Chart chart, Y&& y) {
  chart.x = {"depth", plain_tick};
  ChartSeries series{.key = "", .name = "", .points = {}, .is_joined = true, .slope = {}};
  for (const render::DepthLoss& depth : measurement.depths) {
    series.name = chart.y.label;
    series.points.push_back(
        {.x = {.value = static_cast<double>(depth.depth), .interval = {}},
         .y = y(depth),
         .reading = fmt::format("depth {}: {} of the light lost, {} the time", depth.depth,
                                read(depth.loss, percent).text(), times(depth.seconds)),
         .remark = depth.depth == measurement.own.depth ? "the scene's own" : ""});
  }
  chart.series.push_back(std::move(series));
  return chart;
}

std::string depth_table(const render::Measurement& measurement) {
  HtmlTable table("Loss and cost of each depth",
                  measurement.depths_have_converged
                      ? "#Depth|#Light lost|#Paths cut|#Time, relative"
                      : "#Depth|#Light lost, at least|#Paths cut|#Time, relative");
  for (const render::DepthLoss& depth : measurement.depths) {
    const Reading loss = read(depth.loss, percent);
    table.row()
        .cell(fmt::to_string(depth.depth),
              depth.depth == measurement.own.depth ? "the scene's own" : "")
        .cell(loss.value, loss.interval)
        .cell(percent(depth.cut_share))
        .cell(times(depth.seconds));
  }
  return std::move(table).finish();
}

}  // namespace

std::string depth_section(const Report& report) {
  const render::Measurement& measurement = report.measurement;
  if (measurement.depths.empty()) return "";
  const Chart loss = chart_over_depth(
      measurement,
      {.id = "depth-loss",
       .title = measurement.depths_have_converged ? "Light lost by depth"
                                                  : "Light lost by depth: a lower bound",
       .description = "The share of the mean radiance that each depth loses.",
       .x = {},
       .y = {"light lost", percent_tick},
       .series = {},
       .front = {},
       .level = {}},
      [](const render::DepthLoss& depth) { return depth.loss; });
  const Chart cost = chart_over_depth(
      measurement,
      {.id = "depth-cost",
       .title = "Time by depth",
       .description = "The time of a render with each depth, relative to the scene's own.",
       .x = {},
       .y = {"time, relative to that of the scene's own depth", plain_tick},
       .series = {},
       .front = {},
       .level = {}},
      [](const render::DepthLoss& depth) {
        return render::Measured{.value = depth.seconds, .interval = {}};
      });
  return "<div class=\"charts\">\n" +
         chart_figure(loss,
                      "The same paths with each depth and with the greatest one measured. The "
                      "light that a depth loses is missing with any number of samples.") +
         chart_figure(cost,
                      "Most paths end by themselves, so depth is cheap if light can escape.") +
         "</div>\n" + depth_table(measurement);
}

}  // namespace sdlc::cli
