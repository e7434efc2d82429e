#include <fmt/format.h>

#include "cli/report/chart.hpp"
#include "cli/report/section.hpp"

namespace sdlc::cli {
namespace {

std::string chart_of(const render::Measurement& measurement) {
  Chart chart{.id = "threads",
              .title = "Speed-up against threads",
              .description = "All figures are in the table of numbers of threads.",
              .x = {"threads", figure},
              .y = {"times as fast as one thread", figure},
              .series = {{.key = "measured"}, {.key = "ideal"}}};
  for (const render::ThreadScaling& scaling : measurement.thread_scaling) {
    const render::Measured threads{.value = static_cast<double>(scaling.threads)};
    chart.series[0].points.push_back(
        {.x = threads,
         .y = scaling.speed_up,
         .reading = fmt::format("{}: {}", count_of(scaling.threads, "thread"),
                                read(scaling.speed_up, times).text())});
    chart.series[1].points.push_back(
        {.x = threads, .y = threads, .dominance = render::Dominance::Dominated});
  }
  return chart_figure(chart,
                      "Each number of threads is timed in several rounds, one after the other; the "
                      "bars are 95 % intervals of the speed-up within a round.");
}

}  // namespace

Section threads_section(const Report& report) {
  const render::Measurement& measurement = report.measurement;
  Section section;
  if (measurement.thread_scaling.empty()) return section;
  section.page_only("<div class=\"charts\">\n" + chart_of(measurement) + "</div>\n");
  Table table(fmt::format("Renders of {} with numbers of threads",
                          count_of(measurement.thread_scaling_samples, "sample")),
              "#Threads|#Time|#Speed-up|#Of the ideal");
  for (const render::ThreadScaling& scaling : measurement.thread_scaling) {
    table.row({fmt::to_string(scaling.threads), read(scaling.seconds, duration),
               read(scaling.speed_up, times), percent(scaling.speed_up.value / scaling.threads)});
  }
  section.table(table);
  if (measurement.thread_pictures_are_same) {
    section.paragraph("All of these pictures are the same, byte for byte.");
  }
  return section;
}

}  // namespace sdlc::cli
