#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "cli/report/html.hpp"
#include "cli/report/point_columns.hpp"

namespace sdlc::cli {
namespace {

template <typename Visitor>
void for_each_column(Visitor&& visit) {
  const auto visit_column = [&](const auto& field) {
    if constexpr (requires { field.heading; }) visit(field);
  };
  std::apply([&](const auto&... fields) { (visit_column(fields), ...); }, kMembers<render::Point>);
}

Table points_table(const render::Measurement& measurement) {
  std::string headings;
  for_each_column([&](const auto& column) {
    headings += (headings.empty() ? "" : "|") + std::string(column.heading);
  });
  Table table("All renders, by configuration and samples", headings);
  for (std::size_t i = 0; i < measurement.series.size(); ++i) {
    const render::Series& series = measurement.series[i];
    table.group(fmt::format(
        "{} {}{}", series_key(i), escaped(describe(series.configuration)),
        series.slope ? fmt::format(" <small>slope {}</small>", read(*series.slope, figure).text())
                     : ""));
    for (const std::size_t index : series.points) {
      std::vector<Cell> cells;
      for_each_column(
          [&](const auto& column) { cells.push_back(column.cell(measurement.points[index])); });
      table.row(std::move(cells));
    }
  }
  return table;
}

/// "RMSE: root mean square difference …. relMSE: …."
std::string explanations() {
  std::string text;
  for_each_column([&](const auto& column) {
    if (column.explanation.empty()) return;
    const std::string_view name = column.heading.substr(column.heading.find_first_not_of("-#"));
    text += fmt::format("{}{}: {}.", text.empty() ? "" : " ", name, column.explanation);
  });
  return text;
}

Table left_out_table(const render::Measurement& measurement) {
  Table table("What was left out", "#Samples|Configuration|Why");
  for (const render::LeftOut& left : measurement.left_out) {
    table.row({left.samples ? whole(*left.samples) : "all", escaped(describe(left.configuration)),
               escaped(left.reason)});
  }
  return table;
}

}  // namespace

std::string_view words_of(render::Dominance dominance) {
  constexpr std::array<std::string_view, 3> kTexts{"on the front", "not distinguishable",
                                                   "dominated"};
  return kTexts[static_cast<std::size_t>(dominance)];
}

Section points_section(const Report& report) {
  const render::Measurement& measurement = report.measurement;
  Section section;
  if (measurement.points.empty()) {
    section.paragraph("No render was measured.");
  } else {
    section.table(points_table(measurement));
    section.page_only(fmt::format("<p class=\"fine\">{}</p>\n", explanations()));
  }
  if (!measurement.left_out.empty()) section.table(left_out_table(measurement));
  return section;
}

}  // namespace sdlc::cli
