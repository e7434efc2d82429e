#include "cli/report/report.hpp"

#include <array>

#include <fmt/format.h>

#include "cli/report/figures.hpp"
#include "cli/report/html.hpp"
#include "cli/report/section.hpp"
#include "cli/report/style.hpp"

namespace sdlc::cli {
namespace {

struct Part {
  std::string_view id, heading;
  Section (*section)(const Report&);
};

/// In the order of the page.
constexpr std::array kParts{
    Part{"recommendation", "Recommended settings", recommendation_section},
    Part{"charts", "Error and render time", error_charts_section},
    Part{"depth", "Depth", depth_section},
    Part{"precision", "Precision", precision_section},
    Part{"threads", "Threads", threads_section},
    Part{"pictures", "Pictures", pictures_section},
    Part{"renders", "All renders", points_section},
    Part{"against", "Comparison with an earlier measurement", against_section},
    Part{"method", "How it was measured", method_section},
};

/// Nothing is loaded, and no script runs, whatever a scene is called.
constexpr std::string_view kPolicy = "default-src 'none'; img-src data:; style-src 'unsafe-inline'";

std::string head(const Report& report) {
  return fmt::format(
      "<!DOCTYPE html>\n"
      "<html lang=\"en\">\n"
      "<head>\n"
      "<meta charset=\"utf-8\"/>\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<meta name=\"color-scheme\" content=\"light dark\"/>\n"
      "<link rel=\"icon\" href=\"data:,\"/>\n"
      "<title>{}: error and render time</title>\n"
      "<style>\n"
      "{}</style>\n"
      "</head>\n",
      kPolicy, escaped(report.provenance.scene), style_sheet());
}

/// "6 renders in 2 configurations; compared with …"
std::string subtitle(const render::Measurement& measurement) {
  std::string text = fmt::format(
      "{} in {}, {} × {} pixels, {}, {}", count_of(measurement.points.size(), "render"),
      count_of(measurement.series.size(), "configuration"), measurement.width, measurement.height,
      count_of(measurement.threads, "thread"), duration(measurement.spent_seconds));
  if (!measurement.reference) return text + "; there is no reference.";
  return text + fmt::format("; compared with a reference of {}.",
                            count_of(measurement.reference->samples, "sample"));
}

}  // namespace

std::string html_report(const Report& report) {
  std::string links, sections;
  for (const auto& [id, heading, section] : kParts) {
    const std::string html = section(report).html();
    if (html.empty()) continue;
    links += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", id, heading);
    sections += fmt::format(
        "<section id=\"{0}\" aria-labelledby=\"{0}-heading\">\n<h2 id=\"{0}-heading\">{1}</h2>\n{2}"
        "</section>\n",
        id, heading, html);
  }
  return head(report) + fmt::format(
                            "<body>\n<header>\n<p class=\"kind\">sdlc measure</p>\n<h1>{}</h1>\n<p "
                            "class=\"fine\">{}</p>\n"
                            "<nav aria-label=\"Sections\"><ul>\n{}</ul></nav>\n</header>\n"
                            "<main>\n{}{}</main>\n</body>\n</html>\n",
                            escaped(report.provenance.scene), subtitle(report.measurement), links,
                            callouts(report).html(), sections);
}

std::string text_report(const Report& report) {
  const render::Measurement& measurement = report.measurement;
  std::string text = fmt::format("{}, {} × {} pixels\n", report.provenance.scene, measurement.width,
                                 measurement.height);
  if (measurement.reference) {
    text += plain_text("reference: " + describe_reference(*measurement.reference)) + "\n";
  }
  if (!measurement.light_choice.empty()) {
    text += fmt::format("light sampling auto: {}\n", measurement.light_choice);
  }
  // The recommendation is last, where it stays visible.
  constexpr std::array kSections{points_section,        depth_section,   precision_section,
                                 threads_section,       against_section, callouts,
                                 recommendation_section};
  for (const auto& section : kSections) {
    if (const std::string part = section(report).text(); !part.empty()) text += "\n" + part;
  }
  return text;
}

}  // namespace sdlc::cli
