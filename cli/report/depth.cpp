#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/report/chart.hpp"
#include "cli/report/section.hpp"

namespace sdlc::cli {
namespace {

std::string plain_tick(double number) { return figure(number, 6); }

std::string_view remark(const render::Measurement& measurement, const render::DepthLoss& depth) {
  return depth.depth == measurement.own.depth ? "the scene's own" : "";
}

/// `y` maps a depth to the plotted value.
template <typename Y>
std::string chart_over_depth(const render::Measurement& measurement, Chart chart, Y y,
                             std::string_view caption) {
  chart.x = {"depth", plain_tick};
  ChartSeries series{.name = chart.y.label, .is_joined = true};
  for (const render::DepthLoss& depth : measurement.depths) {
    series.points.push_back(
        {.x = {.value = static_cast<double>(depth.depth)},
         .y = y(depth),
         .reading = fmt::format("depth {}: {} of the light lost, {} the time", depth.depth,
                                read(depth.loss, percent).text(), times(depth.relative_seconds)),
         .remark = std::string(remark(measurement, depth))});
  }
  chart.series.push_back(std::move(series));
  return chart_figure(chart, caption);
}

Table depth_table(const render::Measurement& measurement) {
  Table table("Loss and cost of each depth",
              measurement.depths_have_converged
                  ? "#Depth|#Light lost|#Paths cut|#Time, relative"
                  : "#Depth|#Light lost, at least|#Paths cut|#Time, relative");
  for (const render::DepthLoss& depth : measurement.depths) {
    table.row({{fmt::to_string(depth.depth), std::string(remark(measurement, depth))},
               read(depth.loss, percent),
               percent(depth.cut_paths),
               times(depth.relative_seconds)});
  }
  return table;
}

}  // namespace

Section depth_section(const Report& report) {
  const render::Measurement& measurement = report.measurement;
  Section section;
  if (measurement.depths.empty()) return section;
  section.page_only("<div class=\"charts\">\n");
  section.page_only(chart_over_depth(
      measurement,
      {.id = "depth-loss",
       .title = measurement.depths_have_converged ? "Light lost by depth"
                                                  : "Light lost by depth: a lower bound",
       .description = "The share of the mean radiance that each depth loses.",
       .y = {"light lost", percent_tick}},
      [](const render::DepthLoss& depth) { return depth.loss; },
      "The same paths with each depth and with the greatest one measured. The light that a depth "
      "loses is missing with any number of samples."));
  section.page_only(chart_over_depth(
      measurement,
      {.id = "depth-cost",
       .title = "Time by depth",
       .description = "The time of a render with each depth, relative to the scene's own.",
       .y = {"time, relative to that of the scene's own depth", plain_tick}},
      [](const render::DepthLoss& depth) {
        return render::Measured{.value = depth.relative_seconds};
      },
      "Most paths end by themselves, so depth is cheap if light can escape."));
  section.page_only("</div>\n");
  section.table(depth_table(measurement));
  return section;
}

}  // namespace sdlc::cli
