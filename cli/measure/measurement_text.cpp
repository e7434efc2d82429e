#include "cli/measure/measurement_text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "cli/report/figures.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::cli {
namespace {

using render::Measured;
using render::Measurement;

/// Replaces no-break spaces, which are only for HTML.
std::string plain(std::string text) {
  constexpr std::string_view kNoBreak = "\u00a0";
  for (std::size_t at = text.find(kNoBreak); at != std::string::npos; at = text.find(kNoBreak)) {
    text.replace(at, kNoBreak.size(), " ");
  }
  return text;
}

std::string reading(const Measured& measured, FigureText* as) {
  return plain(read(measured, as).text());
}

/// Rows of cells, in columns as wide as necessary; the first row is the header.
class Table {
 public:
  using Row = std::vector<std::string>;

  void add(Row row) { rows_.push_back(std::move(row)); }

  std::string text() const {
    std::vector<std::size_t> widths;
    for (const Row& row : rows_) {
      widths.resize(std::max(widths.size(), row.size()));
      for (std::size_t i = 0; i < row.size(); ++i) {
        widths[i] = std::max(widths[i], lang::count_code_points(row[i]));
      }
    }
    std::string text;
    for (const Row& row : rows_) {
      std::string line;
      for (std::size_t i = 0; i < row.size(); ++i) {
        line += "  " + row[i] + std::string(widths[i] - lang::count_code_points(row[i]), ' ');
      }
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + "\n";
    }
    return text;
  }

 private:
  std::vector<Row> rows_;
};

std::string points_text(const Measurement& measurement) {
  constexpr std::array<const char*, 3> kDominance{"on the front", "not distinguishable", ""};
  Table table;
  table.add({"samples", "time", "error", "FLIP", "configuration", ""});
  for (const render::Series& series : measurement.series) {
    for (const std::size_t i : series.points) {
      const render::Point& point = measurement.points[i];
      table.add({fmt::to_string(point.samples), reading(point.seconds, duration),
                 reading(point.error, percent), figure(point.flip, 2),
                 plain(describe_configuration(measurement, point.configuration)),
                 kDominance[static_cast<std::size_t>(point.dominance)]});
    }
  }
  return table.text();
}

std::string slopes_text(const Measurement& measurement) {
  std::string text;
  const auto exponent = [](double value) { return figure(value, 2); };
  for (const render::Series& series : measurement.series) {
    if (!series.slope) continue;
    text += fmt::format("  {}: error proportional to samples to the power of {}\n",
                        describe_configuration(measurement, series.configuration),
                        reading(*series.slope, exponent));
  }
  return text;
}

std::string depths_text(const Measurement& measurement) {
  if (measurement.depths.empty()) return {};
  std::string text =
      fmt::format("\nDepth: light lost, relative to depth {}{}\n", measurement.depths.back().depth,
                  measurement.depths_have_converged ? "" : "; a lower bound");
  Table table;
  for (const render::DepthLoss& depth : measurement.depths) {
    table.add({fmt::format("depth {}", depth.depth), reading(depth.loss, percent),
               plain(fmt::format("{} the time", times(depth.seconds))),
               depth.depth == measurement.own.depth ? "the scene's own" : ""});
  }
  return text + table.text();
}

std::string precision_text(const Measurement& measurement) {
  if (!measurement.precision) return {};
  const render::PrecisionDifference& precision = *measurement.precision;
  if (!precision.refusal.empty()) {
    return fmt::format(
        "\n"
        "Precision: {} is used; {} is not possible: {}\n",
        name_of(precision.taken), name_of(precision.other), precision.refusal);
  }
  return plain(fmt::format("\nPrecision: the mean in {} minus that in {} is {}; {} takes {}\n",
                           name_of(precision.taken), name_of(precision.other),
                           reading(precision.mean_difference, percent), name_of(precision.other),
                           times(precision.seconds)));
}

std::string against_text(const Report& report) {
  if (!report.against) return {};
  const render::Comparison& against = *report.against;
  constexpr std::array<const char*, 3> kVerdicts{"not distinguished", "better", "WORSE"};
  std::string text = fmt::format("\nAgainst {}\n", against.earlier);
  Table table;
  table.add({"samples", "error before", "error now", "", "configuration"});
  for (const render::PointChange& point : against.points) {
    table.add({fmt::to_string(point.samples), reading(point.error_before, percent),
               reading(point.error_after, percent),
               kVerdicts[static_cast<std::size_t>(point.error)],
               plain(describe_configuration(report.measurement, point.configuration))});
  }
  if (!against.points.empty()) text += table.text();
  if (against.time_ratio) {
    text +=
        fmt::format("  times, now relative to then: {}: {}\n", reading(*against.time_ratio, times),
                    kVerdicts[static_cast<std::size_t>(against.time)]);
  }
  for (const std::string& note : against.notes) text += fmt::format("  {}\n", note);
  return text;
}

std::string left_out_text(const Measurement& measurement) {
  if (measurement.left_out.empty()) return {};
  std::string text = "\nLeft out\n";
  for (const render::LeftOut& left_out : measurement.left_out) {
    const std::string samples =
        left_out.samples > 0 ? fmt::format("{} samples, ", left_out.samples) : std::string();
    text += fmt::format("  {}{}: {}\n", samples, describe_configuration(left_out.configuration),
                        left_out.reason);
  }
  return text;
}

std::string recommendation_text(const Measurement& measurement, const std::string& what,
                                const render::Recommendation& recommendation) {
  return plain(
      fmt::format("{}: {}, about {}; {} {}\n", what,
                  render_flags(measurement, recommendation.configuration, recommendation.samples),
                  reading(recommendation.seconds, duration),
                  recommendation.is_measured ? "error" : "estimated error",
                  reading(recommendation.error, percent)));
}

/// The last part of the output: the recommendations.
std::string recommendations_text(const Measurement& measurement) {
  std::string text;
  if (measurement.as_it_is) {
    text += recommendation_text(measurement, "as it is", *measurement.as_it_is);
  }
  for (const render::Recommendation& recommendation : measurement.recommendations) {
    const std::string what = recommendation.goal > 0
                                 ? fmt::format("for {}", percent(recommendation.goal))
                                 : std::string("without noise");
    text += recommendation_text(measurement, what, recommendation);
  }
  if (measurement.recommendations.empty()) {
    text += "no recommendation: too little was measured\n";
  }
  return text;
}

}  // namespace

std::string to_text(const Report& report) {
  const Measurement& measurement = report.measurement;
  std::string text = fmt::format("{}, {} × {} pixels", report.provenance.scene, measurement.width,
                                 measurement.height);
  if (measurement.width != measurement.full_width ||
      measurement.height != measurement.full_height) {
    text += fmt::format(" (instead of {} × {}, for which the time was too short)",
                        measurement.full_width, measurement.full_height);
  }
  text += "\n";
  if (measurement.reference) {
    const render::Reference& reference = *measurement.reference;
    text += fmt::format("reference: {} samples, {}, error {}\n", reference.samples,
                        plain(describe_configuration(reference.configuration)),
                        reading(reference.error, percent));
  }
  text += "\n" + points_text(measurement);
  const std::string slopes = slopes_text(measurement);
  if (!slopes.empty()) text += "\n" + slopes;
  text += depths_text(measurement);
  text += precision_text(measurement);
  text += left_out_text(measurement);
  text += against_text(report);
  for (const std::string& note : report.notes) text += fmt::format("\nnote: {}", note);
  if (!report.notes.empty()) text += "\n";
  text += "\n" + recommendations_text(measurement);
  return text;
}

}  // namespace sdlc::cli
