#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/numbers/format_numbers.hpp"
#include "cli/report/figures.hpp"
#include "cli/report/html.hpp"
#include "cli/report/sections.hpp"

namespace sdlc::cli {
namespace {

std::string_view class_of(render::Verdict verdict) {
  static constexpr std::array<std::string_view, 3> kClasses{"same", "better", "worse"};
  return kClasses[static_cast<std::size_t>(verdict)];
}

}  // namespace

std::string against_section(const Report& report) {
  if (!report.against) return "";
  const render::Comparison& against = *report.against;
  std::string html =
      fmt::format("<p>The earlier measurement was made by {}.</p>\n", escaped(against.earlier));
  html += against.time_ratio
              ? fmt::format("<p>A render takes <strong>{}</strong> as long as before: {}.</p>\n",
                            read(*against.time_ratio, times).text(), name_of(against.time))
              : std::string("<p>Times are not compared.</p>\n");
  for (const std::string& note : against.notes) {
    html += callout(note);
  }
  if (against.points.empty()) return html + "<p>The two have no render in common.</p>\n";
  HtmlTable table("Renders in both measurements",
                  "#Samples|Configuration|#Error before|#Error now|Error|#Time before|#Time now");
  for (const render::PointChange& change : against.points) {
    const Reading error_before = read(change.error_before, percent),
                  error_after = read(change.error_after, percent),
                  seconds_before = read(change.seconds_before, duration),
                  seconds_after = read(change.seconds_after, duration);
    table.row()
        .cell(format_whole(static_cast<std::uint64_t>(change.samples)))
        .cell(escaped(describe_configuration(report.measurement, change.configuration)))
        .cell(error_before.value, error_before.interval)
        .cell(error_after.value, error_after.interval)
        .cell(fmt::format("<span class=\"verdict {}\">{}</span>", class_of(change.error),
                          name_of(change.error)))
        .cell(seconds_before.value, seconds_before.interval)
        .cell(seconds_after.value, seconds_after.interval);
  }
  return html + std::move(table).finish();
}

}  // namespace sdlc::cli
