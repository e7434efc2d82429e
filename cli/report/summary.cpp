#include <algorithm>
#include <cstddef>
#include <string>

#include <fmt/format.h>

#include "cli/report/figures.hpp"
#include "cli/report/html.hpp"
#include "cli/report/section.hpp"

namespace sdlc::cli {
namespace {

std::string flags_element(const render::Recommendation& choice) {
  return fmt::format("<code>{}</code>", escaped(choice.flags));
}

Table recommendation_table(const render::Measurement& measurement) {
  Table table("Recommended settings, for each goal", "Goal|Flags|#Error|#Time|Known");
  for (const render::Recommendation& choice : measurement.recommendations) {
    table.row({percent(choice.goal.value_or(0)), flags_element(choice),
               read(choice.relative_error, percent), read(choice.seconds, duration),
               choice.is_measured ? "measured" : "by the line"});
  }
  return table;
}

}  // namespace

Section callouts(const Report& report) {
  Section section;
  for (const std::string& note : report.notes) section.callout(note);
  return section;
}

Section recommendation_section(const Report& report) {
  const render::Measurement& measurement = report.measurement;
  Section section;
  section.page_only("<div class=\"beside\"><div>\n");
  if (measurement.recommendations.empty()) {
    section.paragraph("No recommendation: too little was measured.", "lead");
  } else {
    const auto& all = measurement.recommendations;
    const auto main = std::ranges::find(all, true, &render::Recommendation::is_main);
    const render::Recommendation& choice = main == all.end() ? all.front() : *main;
    section.paragraph(
        fmt::format("{}: {}, about {}; error {}.",
                    choice.goal ? fmt::format("For an error of {}", percent(*choice.goal))
                                : std::string("For a picture without noise"),
                    flags_element(choice), read(choice.seconds, duration).text(),
                    read(choice.relative_error, percent).text()),
        "lead");
    section.paragraph(fmt::format(
        "Add the flags to <code>sdlc render</code>. {}",
        choice.is_measured ? "Exactly this render was measured."
                           : "It was not rendered here: its figures follow from the renders of "
                             "that configuration."));
    if (measurement.as_it_is) {
      const render::Recommendation& own = *measurement.as_it_is;
      section.paragraph(fmt::format(
          "The scene's own settings, with {} samples: about {}; error {}.", own.samples,
          read(own.seconds, duration).text(), read(own.relative_error, percent).text()));
    }
    section.table(recommendation_table(measurement));
    section.page_only(
        "<p class=\"fine\">Measured: rendered with these samples. By the line: predicted from the "
        "straight line through the renders of that configuration.</p>\n");
  }
  section.page_only("</div>\n");
  if (const std::string picture = picture_element(report.picture); !picture.empty()) {
    section.page_only(
        fmt::format("<figure class=\"reference\">{}<figcaption>{}</figcaption></figure>\n", picture,
                    escaped(report.picture.title)));
  }
  section.page_only("</div>\n");
  return section;
}

}  // namespace sdlc::cli
