#include "cli/report/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "cli/report/axis.hpp"
#include "cli/report/html.hpp"
#include "cli/report/marks.hpp"

namespace sdlc::cli {
namespace {

// In units of the drawing, which is as wide as its column.
constexpr double kWidth = 600, kHeight = 420;
constexpr double kLeft = 72, kRight = 24, kTop = 66, kBottom = 50;
constexpr double kRadius = 5, kTargetRadius = 11;
constexpr double kZeroLane = 22;  // below the plot, for values that a logarithmic axis cannot show

bool has_place(const ChartPoint& point) noexcept {
  return std::isfinite(point.x.value) && std::isfinite(point.y.value);
}

/// Ends farther than this factor from their value would compress everything else.
constexpr double kFarthestEnd = 10;

/// Collects the values that the axis has to cover: the value and its ends.
void collect(const render::Measured& measured, std::vector<double>& values) {
  values.push_back(measured.value);
  if (!has_interval(measured)) return;
  values.push_back(std::max(measured.interval.from, measured.value / kFarthestEnd));
  values.push_back(std::min(measured.interval.to, measured.value * kFarthestEnd));
}

LogAxis axis_over(const Chart& chart, render::Measured ChartPoint::*coordinate,
                  const std::optional<ChartLevel>& level) {
  std::vector<double> values;
  for (const ChartSeries& series : chart.series) {
    for (const ChartPoint& point : series.points) {
      if (has_place(point)) collect(point.*coordinate, values);
    }
  }
  // A level far below is left out, because it would compress everything else into the upper half.
  constexpr double kWorthShowing = 20;
  double smallest = std::numeric_limits<double>::infinity();
  for (const double value : values) {
    if (value > 0) smallest = std::min(smallest, value);
  }
  if (level && level->y.value * kWorthShowing > smallest) collect(level->y, values);
  return LogAxis::covering(values);
}

/// The plot's rectangle and the mapping of coordinates to it.
class Plot {
 public:
  explicit Plot(const Chart& chart)
      : x_(axis_over(chart, &ChartPoint::x, {})),
        y_(axis_over(chart, &ChartPoint::y, chart.level)) {
    for (const ChartSeries& series : chart.series) {
      for (const ChartPoint& point : series.points) {
        has_zeros_ = has_zeros_ || (has_place(point) && !(point.y.value > 0));
      }
    }
  }

  const LogAxis& x_axis() const noexcept { return x_; }
  const LogAxis& y_axis() const noexcept { return y_; }

  double left() const noexcept { return kLeft; }
  double right() const noexcept { return kWidth - kRight; }
  double top() const noexcept { return kTop; }
  double bottom() const noexcept { return kHeight - kBottom - (has_zeros_ ? kZeroLane : 0); }
  /// The lower edge of the frame, including the lane of zeros.
  double floor() const noexcept { return kHeight - kBottom; }
  bool has_zeros() const noexcept { return has_zeros_; }

  double x(double value) const noexcept { return left() + (right() - left()) * x_.share(value); }
  /// 0 is in the centre of the lane.
  double y(double value) const noexcept {
    if (!(value > 0) && has_zeros_) return (bottom() + floor()) / 2;
    return bottom() + (top() - bottom()) * y_.share(value);
  }

 private:
  LogAxis x_, y_;
  bool has_zeros_ = false;
};

std::string line(std::string_view of, double x1, double y1, double x2, double y2) {
  return fmt::format(
      "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", of, x1, y1,
      x2, y2);
}

/// `anchor`: "start", "middle" or "end".
std::string label(std::string_view of, double x, double y, std::string_view anchor,
                  std::string_view text) {
  return fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n",
                     of, x, y, anchor, escaped(text));
}

std::string draw_grid(const Plot& plot, const Chart& chart) {
  constexpr std::size_t kMaxAcross = 8, kMaxUp = 9;
  constexpr double kGap = 8, kBelow = 18;
  std::string svg;
  for (const Tick& tick : plot.x_axis().ticks(kMaxAcross)) {
    const double x = plot.x(tick.value);
    svg += line(tick.is_labelled ? "major" : "minor", x, plot.top(), x, plot.floor());
    if (!tick.is_labelled) continue;
    svg += label("tick", x, plot.floor() + kBelow, "middle", chart.x.tick(tick.value));
  }
  for (const Tick& tick : plot.y_axis().ticks(kMaxUp)) {
    const double y = plot.y(tick.value);
    svg += line(tick.is_labelled ? "major" : "minor", plot.left(), y, plot.right(), y);
    if (!tick.is_labelled) continue;
    svg += label("tick", plot.left() - kGap, y + 4, "end", chart.y.tick(tick.value));
  }
  if (plot.has_zeros()) {
    svg += line("break", plot.left(), plot.bottom(), plot.right(), plot.bottom());
    svg += label("tick", plot.left() - kGap, plot.y(0) + 4, "end", chart.y.tick(0));
  }
  svg += fmt::format(
      "<rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
      plot.left(), plot.top(), plot.right() - plot.left(), plot.floor() - plot.top());
  svg += label("axis", (plot.left() + plot.right()) / 2, kHeight - 10, "middle", chart.x.label);
  return svg + label("axis", plot.left() - kGap - 52, plot.top() - 12, "start", chart.y.label);
}

std::string draw_level(const Plot& plot, const ChartLevel& level) {
  const double value = level.y.value;
  if (!(value >= plot.y_axis().from() && value <= plot.y_axis().to())) return "";
  std::string svg;
  double above = plot.y(value);
  if (has_interval(level.y)) {
    above = plot.y(level.y.interval.to);
    svg += fmt::format(
        "<rect class=\"band\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
        plot.left(), above, plot.right() - plot.left(), plot.y(level.y.interval.from) - above);
  }
  svg += line("level", plot.left(), plot.y(value), plot.right(), plot.y(value));
  return svg + label("note", plot.left() + 6, above - 5, "start", level.label);
}

std::string draw_front(const Plot& plot, const Chart& chart) {
  std::string path;
  double last_y = plot.top();
  for (const auto& [x, y] : chart.front) {
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    path += fmt::format("{}{:.1f},{:.1f}V{:.1f}", path.empty() ? "M" : "L", plot.x(x), last_y,
                        plot.y(y));
    last_y = plot.y(y);
  }
  if (path.empty()) return path;
  return fmt::format("<path class=\"front\" d=\"{}H{:.1f}\"/>\n", path, plot.right());
}

/// From mark to mark, or a straight line with the slope through the centre of the marks in
/// logarithms.
std::string draw_line(const Plot& plot, const ChartSeries& series) {
  std::string path;
  if (series.is_joined) {
    for (const ChartPoint& point : series.points) {
      if (!has_place(point)) continue;
      path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "M" : "L", plot.x(point.x.value),
                          plot.y(point.y.value));
    }
  } else if (series.slope && std::isfinite(*series.slope)) {
    double sum_x = 0, sum_y = 0, from = 0, to = 0;
    int count = 0;
    for (const ChartPoint& point : series.points) {
      const double x = point.x.value, y = point.y.value;
      if (!has_place(point) || !(x > 0) || !(y > 0)) continue;
      sum_x += std::log(x);
      sum_y += std::log(y);
      from = count == 0 ? x : std::min(from, x);
      to = std::max(to, x);
      ++count;
    }
    const auto at = [&](double x) {
      return std::exp(sum_y / count + *series.slope * (std::log(x) - sum_x / count));
    };
    if (count > 0) {
      path = fmt::format("M{:.1f},{:.1f}L{:.1f},{:.1f}", plot.x(from), plot.y(at(from)), plot.x(to),
                         plot.y(at(to)));
    }
  }
  if (path.empty()) return path;
  return fmt::format("<path class=\"line s{}\" stroke-dasharray=\"{}\" d=\"{}\"/>\n",
                     series.style % kSeriesStyles, dashes(series.style), path);
}

/// An error bar along one axis; without a cap where the interval extends beyond the plot.
std::string draw_bar(const Plot& plot, const ChartPoint& point) {
  constexpr double kCap = 3.5;
  std::string path;
  const double x = plot.x(point.x.value), y = plot.y(point.y.value);
  const auto is_within = [](const LogAxis& axis, double value) {
    return value >= axis.from() && value <= axis.to();
  };
  if (has_interval(point.y)) {
    const auto [from, to] = point.y.interval;
    const double low = from > 0 ? plot.y(from) : plot.floor(), high = plot.y(to);
    path += fmt::format("M{:.1f},{:.1f}V{:.1f}", x, low, high);
    for (const double end : {from, to}) {
      if (!is_within(plot.y_axis(), end)) continue;
      path += fmt::format("M{:.1f},{:.1f}h{:.1f}", x - kCap, plot.y(end), 2 * kCap);
    }
  }
  if (has_interval(point.x)) {
    const auto [from, to] = point.x.interval;
    path += fmt::format("M{:.1f},{:.1f}H{:.1f}", plot.x(from), y, plot.x(to));
    for (const double end : {from, to}) {
      if (!is_within(plot.x_axis(), end)) continue;
      path += fmt::format("M{:.1f},{:.1f}v{:.1f}", plot.x(end), y - kCap, 2 * kCap);
    }
  }
  return path.empty() ? path : fmt::format("<path class=\"bar\" d=\"{}\"/>", path);
}

std::string_view class_of(render::Dominance dominance) {
  constexpr std::array<std::string_view, 3> kClasses{"filled", "hollow", "faded"};
  return kClasses[static_cast<std::size_t>(dominance)];
}

double radius_of(render::Dominance dominance) {
  return dominance == render::Dominance::Dominated ? 3.6 : kRadius;
}

/// The figures of a point are above the plot, where they hide no other.
std::string draw_reading(const ChartSeries& series, const ChartPoint& point,
                         std::string_view title) {
  const std::string key = series.key.empty() ? "" : series.key + "\u2002";
  return fmt::format("<g class=\"reading\" aria-hidden=\"true\"><rect width=\"{}\" height=\"40\"/>",
                     kWidth) +
         label("name", 4, 15, "start", key + std::string(title)) +
         label("figures", 4, 33, "start", point.reading) + "</g>";
}

std::string draw_point(const Plot& plot, const ChartSeries& series, const ChartPoint& point) {
  const std::string title =
      point.remark.empty() ? series.name : fmt::format("{} · {}", series.name, point.remark);
  return fmt::format("<g class=\"point s{} {}\" tabindex=\"0\" role=\"img\" aria-label=\"{}: {}\">",
                     series.style % kSeriesStyles, class_of(point.dominance), escaped(title),
                     escaped(point.reading)) +
         draw_bar(plot, point) +
         fmt::format(
             "<g transform=\"translate({:.1f} {:.1f})\"><circle class=\"target\" r=\"{}\"/>"
             "<path class=\"mark\" d=\"{}\"/></g>\n",
             plot.x(point.x.value), plot.y(point.y.value), kTargetRadius,
             mark_outline(series.style, radius_of(point.dominance))) +
         draw_reading(series, point, title) + "</g>\n";
}

/// The letters of the series next to their last marks, moved apart if they overlap.
std::string draw_keys(const Plot& plot, const Chart& chart) {
  struct Key {
    double x, y;
    std::string_view text;
  };
  std::vector<Key> keys;
  for (const ChartSeries& series : chart.series) {
    const auto last = std::ranges::find_if(series.points.rbegin(), series.points.rend(), has_place);
    if (series.key.empty() || last == series.points.rend()) continue;
    keys.push_back({plot.x(last->x.value) + 9, plot.y(last->y.value) + 4, series.key});
  }
  std::ranges::sort(keys, {}, &Key::y);
  constexpr double kWide = 14, kHigh = 13;
  std::string svg;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (std::abs(keys[k].x - keys[i].x) < kWide && keys[i].y - keys[k].y < kHigh) {
        keys[i].y = keys[k].y + kHigh;
      }
    }
    svg += label("key", keys[i].x, keys[i].y, "start", keys[i].text);
  }
  return svg;
}

}  // namespace

bool can_be_drawn(const Chart& chart) noexcept {
  return std::ranges::any_of(chart.series, [](const ChartSeries& series) {
    return std::ranges::any_of(series.points, has_place);
  });
}

std::string draw(const Chart& chart) {
  const Plot plot(chart);
  std::string svg = fmt::format(
      "<svg class=\"chart\" viewBox=\"0 0 {} {}\" role=\"group\" aria-labelledby=\"{}-title\" "
      "aria-describedby=\"{}-desc\">\n<title id=\"{}-title\">{}</title>\n<desc id=\"{}-desc\">{}"
      "</desc>\n",
      kWidth, kHeight, chart.id, chart.id, chart.id, escaped(chart.title), chart.id,
      escaped(chart.description));
  svg += draw_grid(plot, chart);
  svg += label("hint", 4, 15, "start", "Point at a mark, or focus it with Tab, for its figures.");
  if (chart.level) svg += draw_level(plot, *chart.level);
  svg += draw_front(plot, chart);
  for (const ChartSeries& series : chart.series) svg += draw_line(plot, series);
  svg += draw_keys(plot, chart);
  for (const ChartSeries& series : chart.series) {
    for (const ChartPoint& point : series.points) {
      if (has_place(point)) svg += draw_point(plot, series, point);
    }
  }
  return svg + "</svg>\n";
}

std::string chart_figure(const Chart& chart, std::string_view caption) {
  if (!can_be_drawn(chart)) return "";
  return fmt::format(
      "<figure class=\"plot\"><h3>{0}</h3>\n<a class=\"skip\" href=\"#{1}-end\">Skip the marks of "
      "this chart</a>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Chart: "
      "{0}\">"
      "{2}</div>\n<figcaption id=\"{1}-end\">{3}</figcaption></figure>\n",
      escaped(chart.title), chart.id, draw(chart), caption);
}

std::string legend_sample(std::size_t style) {
  return fmt::format(
      "<svg class=\"sample s{}\" viewBox=\"0 0 44 16\" aria-hidden=\"true\"><path class=\"line\" "
      "stroke-dasharray=\"{}\" d=\"M1,8H43\"/><path class=\"mark\" transform=\"translate(22 8)\" "
      "d=\"{}\"/></svg>",
      style % kSeriesStyles, dashes(style), mark_outline(style, kRadius));
}

std::string look_sample(render::Dominance dominance) {
  return fmt::format(
      "<svg class=\"sample look s0\" viewBox=\"0 0 16 16\" aria-hidden=\"true\"><g class=\"{}\">"
      "<path class=\"mark\" transform=\"translate(8 8)\" d=\"{}\"/></g></svg>",
      class_of(dominance), mark_outline(0, radius_of(dominance)));
}

}  // namespace sdlc::cli
