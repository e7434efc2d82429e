#include <string>

#include <fmt/format.h>

#include "cli/report/figures.hpp"
#include "cli/report/html.hpp"
#include "cli/report/section.hpp"

namespace sdlc::cli {
namespace {

std::string verdict_html(render::Verdict verdict) {
  if (verdict == render::Verdict::NotDistinguished) return std::string(name_of(verdict));
  return fmt::format("<span class=\"verdict {0}\">{0}</span>", name_of(verdict));
}

/// What the exit status of --against reports; empty if nothing is worse.
std::string worse_html(const render::Comparison& against) {
  std::string what;
  if (against.worse_errors > 0) {
    what =
        fmt::format("the error of {} of {} renders", against.worse_errors, against.points.size());
  }
  if (against.time == render::Verdict::Worse) what += what.empty() ? "the times" : ", the times";
  return what.empty() ? what : fmt::format("<strong>WORSE</strong>: {}.", what);
}

}  // namespace

Section against_section(const Report& report) {
  Section section;
  if (!report.against) return section;
  const render::Comparison& against = *report.against;
  section.paragraph("Against the earlier measurement made by " + escaped(against.version) + ".");
  if (const std::string worse = worse_html(against); !worse.empty()) section.paragraph(worse);
  section.paragraph(against.time_ratio
                        ? fmt::format("A render takes <strong>{}</strong> as long as before: {}.",
                                      read(*against.time_ratio, times).text(),
                                      verdict_html(against.time))
                        : std::string("Times are not compared."));
  for (const std::string& note : against.notes) section.callout(note);
  if (against.points.empty()) {
    section.paragraph("The two have no render in common.");
    return section;
  }
  Table table("Renders in both measurements",
              "#Samples|Configuration|#Error before|#Error now|Error|-#Time before|-#Time now");
  for (const render::PointChange& point : against.points) {
    table.row({whole(point.samples),
               escaped(describe_configuration(report.measurement, point.configuration)),
               read(point.relative_error_before, percent), read(point.relative_error, percent),
               verdict_html(point.error), read(point.seconds_before, duration),
               read(point.seconds, duration)});
  }
  section.table(table);
  return section;
}

}  // namespace sdlc::cli
