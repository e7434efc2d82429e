#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/report/figures.hpp"
#include "cli/report/html.hpp"
#include "cli/report/sections.hpp"

namespace sdlc::cli {
namespace {

/// The flags as typed; a line may only break between flags.
std::string flags_element(const render::Measurement& measurement,
                          const render::Recommendation& choice) {
  const std::string flags = render_flags(measurement, choice.configuration, choice.samples);
  std::string html;
  for (std::size_t begin = 0; begin < flags.size();) {
    const std::size_t end = std::min(flags.find(" --", begin), flags.size());
    html += fmt::format("{}<span class=\"flag\">{}</span>", begin == 0 ? "" : " ",
                        escaped(flags.substr(begin, end - begin)));
    begin = end + 1;
  }
  return fmt::format("<code>{}</code>", html);
}

std::string lead(const render::Measurement& measurement, const render::Recommendation& choice) {
  const std::string how =
      choice.is_measured
          ? "Exactly this render was measured."
          : "It was not rendered here: its figures follow from the renders of that configuration.";
  return fmt::format(
      "<p class=\"lead\">{}: {}, about {}; error {}.</p>\n"
      "<p>Add the flags to <code>sdlc render</code>. {}</p>\n",
      choice.goal > 0 ? fmt::format("For an error of {}", percent(choice.goal))
                      : std::string("The picture has no noise"),
      flags_element(measurement, choice), read(choice.seconds, duration).text(),
      read(choice.error, percent).text(), how);
}

/// The scene's current settings, if they were measured.
std::string as_it_is(const render::Measurement& measurement) {
  if (!measurement.as_it_is) return {};
  const render::Recommendation& render = *measurement.as_it_is;
  return fmt::format("<p>The scene's own settings, with {} samples: about {}; error {}.</p>\n",
                     render.samples, read(render.seconds, duration).text(),
                     read(render.error, percent).text());
}

std::string recommendation_table(const render::Measurement& measurement) {
  HtmlTable table("Recommended settings, for each goal", "Goal|Flags|#Error|#Time|Known");
  for (const render::Recommendation& choice : measurement.recommendations) {
    const Reading error = read(choice.error, percent), seconds = read(choice.seconds, duration);
    table.row()
        .cell(percent(choice.goal))
        .cell(flags_element(measurement, choice))
        .cell(error.value, error.interval)
        .cell(seconds.value, seconds.interval)
        .cell(choice.is_measured ? "measured" : "by the line");
  }
  return std::move(table).finish() +
         "<p class=\"fine\">Measured: rendered with these samples. By the line: predicted from the "
         "straight line through the renders of that configuration.</p>\n";
}

}  // namespace

std::string callout(std::string_view text) {
  return fmt::format("<p class=\"callout\"><strong>Note:</strong> {}</p>\n", escaped(text));
}

std::string callouts(const Report& report) {
  const render::Measurement& measurement = report.measurement;
  std::string html;
  for (const std::string& note : report.notes) html += callout(note);
  if (!measurement.is_complete) {
    html += callout("interrupted: some planned renders are missing.");
  }
  if (measurement.width != measurement.full_width ||
      measurement.height != measurement.full_height) {
    html += callout(fmt::format(
        "measured at {} × {} pixels, while the scene has {} × {}: errors are about the same, times "
        "grow with the number of pixels.",
        measurement.width, measurement.height, measurement.full_width, measurement.full_height));
  }
  return html;
}

std::string recommendation_section(const Report& report) {
  const render::Measurement& measurement = report.measurement;
  std::string html = "<div class=\"beside\"><div>\n";
  if (measurement.recommendations.empty()) {
    html += "<p class=\"lead\">No recommendation: too little was measured.</p>\n";
  } else {
    const std::size_t main =
        std::min(measurement.main_recommendation, measurement.recommendations.size() - 1);
    html += lead(measurement, measurement.recommendations[main]);
    html += as_it_is(measurement);
    html += recommendation_table(measurement);
  }
  html += "</div>\n";
  if (const std::string picture = picture_element(report.picture); !picture.empty()) {
    html += fmt::format("<figure class=\"reference\">{}<figcaption>{}</figcaption></figure>\n",
                        picture, escaped(report.picture.title));
  }
  return html + "</div>\n";
}

}  // namespace sdlc::cli
