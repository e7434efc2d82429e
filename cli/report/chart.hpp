#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/report/figures.hpp"
#include "render/measure/measurement.hpp"

/// Charts on two logarithmic axes, as SVG in the page, with the colours of its style sheet.
namespace sdlc::cli {

struct ChartPoint {
  render::Measured x{}, y{};  ///< not drawn unless both are positive and finite
  render::Dominance dominance = render::Dominance::Front;  ///< the look of the mark
  std::string reading{};                                   ///< shown while the pointer is on it
};

/// Points joined by a line.
struct ChartSeries {
  std::string key{};  ///< a letter next to the last mark
  std::vector<ChartPoint> points{};
};

struct ChartAxis {
  std::string label{};
  FigureText* tick = nullptr;
};

/// A horizontal line.
struct ChartLevel {
  double y = 0;
  std::string label{};
};

struct Chart {
  std::string id;
  std::string title, description;
  ChartAxis x{}, y{};
  std::vector<ChartSeries> series{};  ///< the index is the number of the colour
  /// Corners of a falling staircase, ascending in x.
  std::vector<std::pair<double, double>> front{};
  std::optional<ChartLevel> level{};
};

/// The drawing with its title and an HTML caption; empty if no point can be drawn.
std::string chart_figure(const Chart& chart, std::string_view caption);

/// The CSS class for the colour of a series; colours repeat after the eighth.
std::string color_class(std::size_t series);

}  // namespace sdlc::cli
