#include "cli/report/report.hpp"

#include <array>

#include <fmt/format.h>

#include "cli/report/figures.hpp"
#include "cli/report/html.hpp"
#include "cli/report/sections.hpp"
#include "cli/report/style.hpp"

namespace sdlc::cli {
namespace {

struct Section {
  std::string_view id, heading;
  std::string (*body)(const Report&);
};

constexpr std::array kSections{
    Section{"recommendation", "Recommended settings", recommendation_section},
    Section{"charts", "Error and render time", error_charts_section},
    Section{"depth", "Depth", depth_section},
    Section{"precision", "Precision", precision_section},
    Section{"pictures", "Pictures", pictures_section},
    Section{"renders", "All renders", points_section},
    Section{"against", "Comparison with an earlier measurement", against_section},
    Section{"method", "How it was measured", method_section},
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
      count_of(static_cast<std::uint64_t>(measurement.threads), "thread"),
      duration(measurement.spent_seconds));
  if (!measurement.reference) return text + "; there is no reference.";
  return text + fmt::format(
                    "; compared with a reference of {}.",
                    count_of(static_cast<std::uint64_t>(measurement.reference->samples), "sample"));
}

}  // namespace

std::string html_report(const Report& report) {
  std::string links, sections;
  for (const Section& section : kSections) {
    const std::string body = section.body(report);
    if (body.empty()) continue;
    links += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section.id, section.heading);
    sections += fmt::format(
        "<section id=\"{0}\" aria-labelledby=\"{0}-heading\">\n<h2 id=\"{0}-heading\">{1}</h2>\n{2}"
        "</section>\n",
        section.id, section.heading, body);
  }
  return head(report) +
         fmt::format(
             "<body>\n<a class=\"skip\" href=\"#main\">Skip to the recommendation</a>\n"
             "<header>\n<p class=\"kind\">sdlc measure</p>\n<h1>{}</h1>\n<p class=\"fine\">{}</p>\n"
             "<nav aria-label=\"Sections\"><ul>\n{}</ul></nav>\n</header>\n"
             "<main id=\"main\">\n{}{}</main>\n</body>\n</html>\n",
             escaped(report.provenance.scene), subtitle(report.measurement), links,
             callouts(report), sections);
}

}  // namespace sdlc::cli
