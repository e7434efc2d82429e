#include "cli/report/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "cli/report/axis.hpp"
#include "cli/report/html.hpp"

namespace sdlc::cli {
namespace {

// In units of the drawing, which is as wide as its column.
constexpr double kWidth = 600, kHeight = 390;
constexpr double kLeft = 72, kRight = kWidth - 24, kTop = 34, kBottom = kHeight - 50;

bool is_drawable(const ChartPoint& point) {
  const auto is_positive = [](double value) { return value > 0 && std::isfinite(value); };
  return is_positive(point.x.value) && is_positive(point.y.value);
}

/// The points that cannot be drawn are removed.
Chart drawable(Chart chart) {
  for (ChartSeries& series : chart.series) std::erase_if(series.points, std::not_fn(is_drawable));
  return chart;
}

LogAxis axis_over(const Chart& chart, render::Measured ChartPoint::*coordinate) {
  std::vector<double> values;
  for (const ChartSeries& series : chart.series) {
    for (const ChartPoint& point : series.points) values.push_back((point.*coordinate).value);
  }
  if (chart.level && coordinate == &ChartPoint::y) values.push_back(chart.level->y);
  return LogAxis(values);
}

/// Maps coordinates to the drawing.
struct Plot {
  LogAxis x_axis, y_axis;

  double x(double value) const { return kLeft + (kRight - kLeft) * x_axis.share(value); }
  double y(double value) const { return kBottom - (kBottom - kTop) * y_axis.share(value); }
};

std::string line(std::string_view css, double x1, double y1, double x2, double y2) {
  return fmt::format("<path class=\"{}\" d=\"M{:.1f},{:.1f}L{:.1f},{:.1f}\"/>\n", css, x1, y1, x2,
                     y2);
}

/// `anchor`: "start", "middle" or "end".
std::string label(std::string_view css, double x, double y, std::string_view anchor,
                  std::string_view text) {
  return fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n",
                     css, x, y, anchor, escaped(text));
}

std::string draw_grid(const Plot& plot, const Chart& chart) {
  constexpr std::size_t kMaxAcross = 8, kMaxUp = 9;
  std::string svg;
  for (const double value : plot.x_axis.ticks(kMaxAcross)) {
    svg += line("grid", plot.x(value), kTop, plot.x(value), kBottom);
    svg += label("tick", plot.x(value), kBottom + 18, "middle", chart.x.tick(value));
  }
  for (const double value : plot.y_axis.ticks(kMaxUp)) {
    svg += line("grid", kLeft, plot.y(value), kRight, plot.y(value));
    svg += label("tick", kLeft - 8, plot.y(value) + 4, "end", chart.y.tick(value));
  }
  svg += label("axis", (kLeft + kRight) / 2, kHeight - 10, "middle", chart.x.label);
  return svg + label("axis", 12, kTop - 12, "start", chart.y.label);
}

std::string draw_level(const Plot& plot, const ChartLevel& level) {
  return line("level", kLeft, plot.y(level.y), kRight, plot.y(level.y)) +
         label("note", kLeft + 6, plot.y(level.y) - 5, "start", level.label);
}

std::string draw_front(const Plot& plot, const Chart& chart) {
  if (chart.front.empty()) return "";
  std::string path = fmt::format("M{:.1f},{:.1f}", plot.x(chart.front.front().first), kTop);
  for (const auto& [x, y] : chart.front) {
    path += fmt::format("H{:.1f}V{:.1f}", plot.x(x), plot.y(y));
  }
  return fmt::format("<path class=\"front\" d=\"{}H{:.1f}\"/>\n", path, kRight);
}

/// Error bars, up to the frame.
std::string draw_bars(const Plot& plot, const ChartPoint& point) {
  std::string path;
  if (has_interval(point.y)) {
    path += fmt::format("M{:.1f},{:.1f}V{:.1f}", plot.x(point.x.value),
                        plot.y(point.y.interval.from), plot.y(point.y.interval.to));
  }
  if (has_interval(point.x)) {
    path += fmt::format("M{:.1f},{:.1f}H{:.1f}", plot.x(point.x.interval.from),
                        plot.y(point.y.value), plot.x(point.x.interval.to));
  }
  return path.empty() ? path : fmt::format("<path class=\"bar\" d=\"{}\"/>", path);
}

std::string draw_point(const Plot& plot, const ChartPoint& point) {
  constexpr std::array<std::string_view, 3> kClasses{"filled", "hollow", "faded"};
  const bool is_dominated = point.dominance == render::Dominance::Dominated;
  return fmt::format(
      "<g class=\"point {}\"><title>{}</title>{}<circle class=\"mark\" cx=\"{:.1f}\" "
      "cy=\"{:.1f}\" r=\"{}\"/></g>\n",
      kClasses[static_cast<std::size_t>(point.dominance)], escaped(point.reading),
      draw_bars(plot, point), plot.x(point.x.value), plot.y(point.y.value), is_dominated ? 3.6 : 5);
}

std::string draw_series(const Plot& plot, const ChartSeries& series, std::size_t index) {
  std::string path, marks;
  for (const ChartPoint& point : series.points) {
    path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "M" : "L", plot.x(point.x.value),
                        plot.y(point.y.value));
    marks += draw_point(plot, point);
  }
  return fmt::format("<g class=\"{}\"><path class=\"line\" d=\"{}\"/>\n{}</g>\n",
                     color_class(index), path, marks);
}

/// The letters of the series next to their last marks, moved apart if they overlap.
std::string draw_keys(const Plot& plot, const Chart& chart) {
  struct Key {
    double x, y;
    std::string_view text;
  };
  std::vector<Key> keys;
  for (const ChartSeries& series : chart.series) {
    if (series.points.empty()) continue;
    const ChartPoint& last = series.points.back();
    keys.push_back({plot.x(last.x.value) + 9, plot.y(last.y.value) + 4, series.key});
  }
  std::ranges::sort(keys, {}, &Key::y);
  constexpr double kKeyWidth = 14, kKeyHeight = 13;
  std::string svg;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const bool is_beside = std::abs(keys[k].x - keys[i].x) >= kKeyWidth;
      if (!is_beside) keys[i].y = std::max(keys[i].y, keys[k].y + kKeyHeight);
    }
    svg += label("key", keys[i].x, keys[i].y, "start", keys[i].text);
  }
  return svg;
}

std::string draw(const Chart& chart) {
  const Plot plot{axis_over(chart, &ChartPoint::x), axis_over(chart, &ChartPoint::y)};
  std::string svg = fmt::format(
      "<svg class=\"chart\" viewBox=\"0 0 {0} {1}\" role=\"img\" aria-labelledby=\"{2}-title\" "
      "aria-describedby=\"{2}-desc\">\n<title id=\"{2}-title\">{3}</title>\n"
      "<desc id=\"{2}-desc\">{4}</desc>\n",
      kWidth, kHeight, chart.id, escaped(chart.title), escaped(chart.description));
  svg += draw_grid(plot, chart);
  if (chart.level) svg += draw_level(plot, *chart.level);
  svg += draw_front(plot, chart);
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    if (!chart.series[i].points.empty()) svg += draw_series(plot, chart.series[i], i);
  }
  return svg + draw_keys(plot, chart) + "</svg>\n";
}

}  // namespace

std::string chart_figure(const Chart& chart, std::string_view caption) {
  const Chart shown = drawable(chart);
  if (std::ranges::all_of(shown.series, &std::vector<ChartPoint>::empty, &ChartSeries::points)) {
    return "";
  }
  return fmt::format(
      "<figure class=\"plot\"><h3>{0}</h3>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" "
      "aria-label=\"Chart: {0}\">{1}</div>\n<figcaption>{2}</figcaption></figure>\n",
      escaped(chart.title), draw(shown), caption);
}

std::string color_class(std::size_t series) {
  constexpr std::size_t kColors = 8;
  return fmt::format("s{}", series % kColors);
}

}  // namespace sdlc::cli
