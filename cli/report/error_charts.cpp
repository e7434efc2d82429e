#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/report/chart.hpp"
#include "cli/report/html.hpp"
#include "cli/report/section.hpp"

namespace sdlc::cli {
namespace {

std::string seconds_tick(double seconds) {
  return seconds > 0 && seconds < 1 ? figure(1000 * seconds, 6) + "\u00a0ms"
                                    : figure(seconds, 6) + "\u00a0s";
}
std::string samples_tick(double samples) { return figure(samples, 6); }

/// The series with the error of each point over `x` of the point.
template <typename X>
std::vector<ChartSeries> series_over(const render::Measurement& measurement, X&& x) {
  std::vector<ChartSeries> all;
  for (std::size_t i = 0; i < measurement.series.size(); ++i) {
    const render::Series& series = measurement.series[i];
    ChartSeries drawn{.style = i,
                      .key = series_key(i),
                      .name = describe_configuration(measurement, series.configuration)};
    for (const std::size_t index : series.points) {
      const render::Point& point = measurement.points[index];
      drawn.points.push_back(
          {.x = x(point),
           .y = point.error,
           .dominance = point.dominance,
           .reading = fmt::format(
               "{}, {}, error {}", count_of(static_cast<std::uint64_t>(point.samples), "sample"),
               read(point.seconds, duration).text(), read(point.error, percent).text()),
           .remark = std::string(words_of(point.dominance))});
    }
    all.push_back(std::move(drawn));
  }
  return all;
}

std::optional<ChartLevel> reference_level(const render::Measurement& measurement) {
  if (!measurement.reference) return std::nullopt;
  const render::Measured& error = measurement.reference->error;
  return ChartLevel{.y = error,
                    .label = fmt::format("the reference's own error, {}", percent(error.value))};
}

Chart error_against_time(const render::Measurement& measurement) {
  Chart chart{
      .id = "error-time",
      .title = "Error against time",
      .description =
          "The error of each render over its time in seconds, one mark per render. All figures are "
          "in the table of all renders.",
      .x = {"time of a render", seconds_tick},
      .y = {"error", percent_tick},
      .series = series_over(measurement, [](const render::Point& point) { return point.seconds; }),
      .level = reference_level(measurement)};
  for (ChartSeries& series : chart.series) series.is_joined = true;
  for (const render::Point& point : measurement.points) {
    if (point.dominance != render::Dominance::Front) continue;
    chart.front.emplace_back(point.seconds.value, point.error.value);
  }
  std::ranges::sort(chart.front);
  return chart;
}

Chart error_against_samples(const render::Measurement& measurement) {
  Chart chart{
      .id = "error-samples",
      .title = "Error against samples",
      .description =
          "The error of each render over its samples per pixel, with a straight line for "
          "each configuration with three or more renders.",
      .x = {"samples per pixel", samples_tick},
      .y = {"error", percent_tick},
      .series = series_over(measurement,
                            [](const render::Point& point) {
                              return render::Measured{.value = static_cast<double>(point.samples)};
                            }),
      .level = reference_level(measurement)};
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    if (const auto& slope = measurement.series[i].slope) chart.series[i].slope = slope->value;
  }
  return chart;
}

std::string legend(const render::Measurement& measurement) {
  std::string html = "<ul class=\"legend\">\n";
  for (std::size_t i = 0; i < measurement.series.size(); ++i) {
    const render::Series& series = measurement.series[i];
    html += fmt::format("<li>{} <b>{}</b> <span>{}<br/><small>{}</small></span></li>\n",
                        legend_sample(i), series_key(i),
                        escaped(describe_configuration(measurement, series.configuration)),
                        series.slope ? "slope " + read(*series.slope, figure).text()
                                     : std::string("no slope: fewer than three renders"));
  }
  return html + "</ul>\n";
}

/// "3 renders have no place here: their error or time is unknown."
std::string missing_points(const render::Measurement& measurement) {
  const auto count = std::ranges::count_if(measurement.points, [](const render::Point& point) {
    return !std::isfinite(point.error.value) || !std::isfinite(point.seconds.value);
  });
  if (count == 0) return "";
  return fmt::format(" {} {} missing, because error or time is unknown.",
                     count_of(static_cast<std::uint64_t>(count), "render"),
                     count == 1 ? "is" : "are");
}

std::string looks() {
  return fmt::format(
      "{} on the Pareto front: no other render is both faster and more accurate. {} not "
      "distinguishable from the front: another render is faster and more accurate, but their "
      "intervals overlap. {} dominated: another render is clearly faster and more accurate.",
      look_sample(render::Dominance::Front), look_sample(render::Dominance::NotDistinguished),
      look_sample(render::Dominance::Dominated));
}

}  // namespace

std::string series_key(std::size_t index) {
  constexpr std::size_t kLetters = 26;
  const std::string letter(1, static_cast<char>('A' + index % kLetters));
  return index < kLetters ? letter : letter + fmt::to_string(index / kLetters);
}

Section error_charts_section(const Report& report) {
  const render::Measurement& measurement = report.measurement;
  const Chart by_time = error_against_time(measurement);
  const Chart by_samples = error_against_samples(measurement);
  Section section;
  if (!can_be_drawn(by_time) && !can_be_drawn(by_samples)) return section;
  const std::string missing = missing_points(measurement);
  section.page_only(legend(measurement) + "<div class=\"charts\">\n");
  section.page_only(chart_figure(
      by_time,
      "Lower and further left is better. The stepped line is the front: the smallest error reached "
      "within a time. " +
          looks() + missing));
  section.page_only(chart_figure(
      by_samples,
      "The lines are straight fits; their slopes are in the key above. At −0.5, the slope of "
      "independent samples, half the error takes four times the samples; at −1 twice. A line that "
      "flattens out has reached the bias of its depth or precision." +
          missing));
  section.page_only("</div>\n");
  return section;
}

}  // namespace sdlc::cli
