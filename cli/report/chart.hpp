#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/report/figures.hpp"
#include "render/measure/measurement.hpp"

/// Charts on two logarithmic axes, as SVG in the page: drawn in the colours of its style sheet, and
/// usable without a script, because each mark shows its figures while the pointer or the focus is
/// on it.
namespace sdlc::cli {

struct ChartPoint {
  render::Measured x{}, y{};
  render::Dominance dominance = render::Dominance::Front;  ///< the look of the mark
  std::string reading{};                                   ///< the figures in words
  std::string remark{};                                    ///< may be empty
};

struct ChartSeries {
  std::size_t style = 0;  ///< index of colour, shape and dashes, which repeat after the eighth
  std::string key{};      ///< a letter next to the last mark; may be empty
  std::string name{};
  std::vector<ChartPoint> points{};
  bool is_joined = false;         ///< by lines from mark to mark
  std::optional<double> slope{};  ///< of the straight line through the marks
};

/// The quantity along an axis.
struct ChartAxis {
  std::string label{};
  FigureText* tick = nullptr;
};

/// A horizontal line, with its interval as a band.
struct ChartLevel {
  render::Measured y;
  std::string label;
};

struct Chart {
  std::string id;
  std::string title, description;
  ChartAxis x{}, y{};
  std::vector<ChartSeries> series{};
  std::vector<std::pair<double, double>>
      front{};  ///< corners of a falling staircase, ascending in x
  std::optional<ChartLevel> level{};
};

/// Whether any point can be drawn: both coordinates are finite.
bool can_be_drawn(const Chart& chart) noexcept;

/// Precondition: can_be_drawn(chart).
std::string draw(const Chart& chart);

/// The drawing with its title and an HTML caption, in a frame that scrolls if the page is too
/// narrow. Empty if nothing can be drawn.
std::string chart_figure(const Chart& chart, std::string_view caption);

/// The mark of a series with a piece of its line, for a legend.
std::string legend_sample(std::size_t style);
/// A single mark, to explain its look.
std::string look_sample(render::Dominance dominance);

}  // namespace sdlc::cli
