#include <fmt/format.h>

#include "cli/report/figures.hpp"
#include "cli/report/html.hpp"
#include "cli/report/section.hpp"

namespace sdlc::cli {
namespace {

/// A row of a description list.
std::string fact(std::string_view term, std::string_view html) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(term), html);
}

}  // namespace

std::string describe_reference(const render::Reference& reference) {
  std::string text =
      fmt::format("{}, {}, seed {}, rendered in {}; its own error is {}, and its mean radiance {}",
                  count_of(reference.samples, "sample"), describe(reference.configuration),
                  reference.seed, duration(reference.seconds),
                  read(reference.error, percent).text(), figure(reference.mean_radiance));
  if (reference.scarce_emitters > 0) {
    text += fmt::format("; {} reached by very few of its paths, so that light may be missing",
                        count_of(reference.scarce_emitters, "emitter"));
  }
  return text;
}

Section method_section(const Report& report) {
  const render::Measurement& measurement = report.measurement;
  std::string html =
      "<p>Each render was timed and its picture compared with one long reference. The error is the "
      "root mean square difference over all pixels and channels, in linear radiance, divided by "
      "the mean radiance: 1 % is almost invisible, 5 % is fine grain, 20 % is a draft. Each figure "
      "has a 95 % confidence interval. If the intervals of two renders overlap, this measurement "
      "cannot decide which one is better. Times are medians for building and tracing on this "
      "machine.</p>\n<dl>\n";
  html +=
      fact("Reference", measurement.reference ? escaped(describe_reference(*measurement.reference))
                                              : "none was rendered");
  html += fact("The scene's own settings",
               escaped(count_of(measurement.samples, "sample") + ", " + describe(measurement.own)));
  if (!measurement.light_choice.empty()) {
    html += fact("Light sampling auto", escaped(measurement.light_choice));
  }
  html += fact("Size", fmt::format("{} × {} pixels", measurement.width, measurement.height));
  html += fact("Seed", fmt::to_string(measurement.seed));
  html += fact("Threads", fmt::to_string(measurement.threads));
  html +=
      fact("Time spent", fmt::format("{} of a budget of {}", duration(measurement.spent_seconds),
                                     duration(measurement.budget_seconds)));
  html += fact("Reading and writing",
               fmt::format("{} for a picture of full size; part of the recommended times",
                           duration(measurement.other_seconds)));
  html += fact("Version", escaped(report.provenance.version));
  html += fact("Command", fmt::format("<code>{}</code>", escaped(report.provenance.command)));
  for (const auto& [what, value] : report.provenance.machine) html += fact(what, escaped(value));
  Section section;
  section.page_only(html + "</dl>\n");
  return section;
}

}  // namespace sdlc::cli
