#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/report/figures.hpp"
#include "render/measure/measurement.hpp"

/// Charts on two logarithmic axes, as SVG in the page: drawn with the colours of its style sheet,
/// and read without a script, as each mark shows its figures while the pointer or the focus is on
/// it.
namespace sdlc::cli {

enum class MarkLook { Filled, Hollow, Faded };

struct ChartPoint {
  render::Measured x, y;
  MarkLook look = MarkLook::Filled;
  std::string reading;  ///< the figures in words
  std::string remark;   ///< what the look means; may be empty
};

struct ChartSeries {
  std::size_t style = 0;  ///< its colour, shape and dashes, which begin anew after the eighth
  std::string key;        ///< a letter, beside the last mark; may be empty
  std::string name;
  std::vector<ChartPoint> points;
  bool is_joined = false;       ///< by lines from mark to mark
  std::optional<double> slope;  ///< of the straight line that is drawn through the marks
};

/// What is measured along an axis.
struct ChartAxis {
  std::string label;
  FigureText* tick = nullptr;
};

/// A line across, with its interval as a band.
struct ChartLevel {
  render::Measured y;
  std::string label;
};

struct Chart {
  std::string id;
  std::string title, description;
  ChartAxis x, y;
  std::vector<ChartSeries> series;
  std::vector<std::pair<double, double>> front;  ///< corners of a falling staircase, ascending in x
  std::optional<ChartLevel> level;
};

/// Whether any point has a place: both coordinates are finite.
bool can_be_drawn(const Chart& chart) noexcept;

/// Precondition: can_be_drawn(chart).
std::string draw(const Chart& chart);

/// The drawing under its title, in a frame that scrolls where the page is too narrow, above a
/// caption, which is HTML. Empty where nothing can be drawn.
std::string chart_figure(const Chart& chart, std::string_view caption);

/// The mark of a series with a piece of its line, for a legend.
std::string legend_sample(std::size_t style);
/// A mark alone, to say what a look means.
std::string look_sample(MarkLook look);

}  // namespace sdlc::cli
