#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "cli/report/chart.hpp"
#include "cli/report/html.hpp"
#include "cli/report/section.hpp"

namespace sdlc::cli {
namespace {

std::string seconds_tick(double seconds) {
  return seconds < 1 ? figure(1000 * seconds) + "\u00a0ms" : figure(seconds) + "\u00a0s";
}

/// The reference's own error; nullopt if it is unknown, or so small that it would compress the rest
/// of the chart into its upper half.
std::optional<ChartLevel> reference_level(const render::Measurement& measurement) {
  constexpr double kWorthShowing = 20;
  double smallest = INFINITY;
  for (const render::Point& point : measurement.points) {
    if (point.error.value > 0) smallest = std::min(smallest, point.error.value);
  }
  const double error = measurement.reference ? measurement.reference->error.value : 0;
  if (!std::isfinite(error) || !(error * kWorthShowing > smallest)) return std::nullopt;
  return ChartLevel{.y = error,
                    .label = fmt::format("the reference's own error, {}", percent(error))};
}

/// Fills in the error of each point over `x` of the point.
template <typename X>
Chart error_chart(const render::Measurement& measurement, Chart chart, X&& x) {
  chart.y = {"error", percent};
  chart.level = reference_level(measurement);
  for (std::size_t i = 0; i < measurement.series.size(); ++i) {
    const render::Series& series = measurement.series[i];
    const std::string name = describe_configuration(measurement, series.configuration);
    ChartSeries& drawn = chart.series.emplace_back(ChartSeries{.key = series_letter(i)});
    for (const std::size_t index : series.points) {
      const render::Point& point = measurement.points[index];
      drawn.points.push_back(
          {.x = x(point),
           .y = point.error,
           .dominance = point.dominance,
           .reading = fmt::format("{} {} · {}: {}, {}, error {}", drawn.key, name,
                                  words_of(point.dominance), count_of(point.samples, "sample"),
                                  read(point.seconds, duration).text(),
                                  read(point.error, percent).text())});
    }
  }
  return chart;
}

Chart error_against_time(const render::Measurement& measurement) {
  Chart chart = error_chart(measurement,
                            {.id = "error-time",
                             .title = "Error against time",
                             .description = "All figures are in the table of all renders.",
                             .x = {"time of a render", seconds_tick}},
                            [](const render::Point& point) { return point.seconds; });
  for (const render::Point& point : measurement.points) {
    if (point.dominance != render::Dominance::Front || !std::isfinite(point.error.value)) continue;
    chart.front.emplace_back(point.seconds.value, point.error.value);
  }
  std::ranges::sort(chart.front);
  return chart;
}

Chart error_against_samples(const render::Measurement& measurement) {
  return error_chart(
      measurement,
      {.id = "error-samples",
       .title = "Error against samples",
       .description = "All figures are in the table of all renders.",
       .x = {"samples per pixel", figure}},
      [](const render::Point& point) { return render::Measured{.value = double(point.samples)}; });
}

std::string legend(const render::Measurement& measurement) {
  std::string html = "<ul class=\"legend\">\n";
  for (std::size_t i = 0; i < measurement.series.size(); ++i) {
    const render::Series& series = measurement.series[i];
    html += fmt::format("<li>{} {} <small>{}</small></li>\n", series_key(i),
                        escaped(describe_configuration(measurement, series.configuration)),
                        series.slope ? "slope " + read(*series.slope, figure).text() : "");
  }
  return html + "</ul>\n";
}

}  // namespace

std::string series_letter(std::size_t index) {
  return {static_cast<char>('A' + index % 26)};  // a study has at most eight configurations
}

std::string series_key(std::size_t index) {
  return fmt::format("<b class=\"key {}\">{}</b>", color_class(index), series_letter(index));
}

Section error_charts_section(const Report& report) {
  const std::string by_time = chart_figure(
      error_against_time(report.measurement),
      "Lower and further left is better. The stepped line is the Pareto front: the smallest error "
      "reached within a time. Filled marks are on the front: no other render is both faster and "
      "more accurate. Hollow marks are not distinguishable from it: another render is faster and "
      "more accurate, but their intervals overlap. Faded marks are dominated: another render is "
      "clearly faster and more accurate.");
  const std::string by_samples = chart_figure(
      error_against_samples(report.measurement),
      "The slopes of straight fits are in the key above. At −0.5, the slope of independent "
      "samples, half the error takes four times the samples; at −1 twice. A line that flattens "
      "out has reached the bias of its depth or precision.");
  Section section;
  if (by_time.empty() && by_samples.empty()) return section;
  section.page_only(legend(report.measurement) + "<div class=\"charts\">\n" + by_time + by_samples +
                    "</div>\n");
  return section;
}

}  // namespace sdlc::cli
