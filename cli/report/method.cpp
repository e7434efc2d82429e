#include <fmt/format.h>

#include "cli/report/figures.hpp"
#include "cli/report/html.hpp"
#include "cli/report/section.hpp"

namespace sdlc::cli {
namespace {

/// A list of terms and their descriptions.
class Facts {
 public:
  void add(std::string_view term, std::string_view html) {
    out_ += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(term), html);
  }
  std::string finish() const { return "<dl>\n" + out_ + "</dl>\n"; }

 private:
  std::string out_;
};

}  // namespace

std::string describe_reference(const render::Reference& reference) {
  std::string text = fmt::format(
      "{}, {}, seed {}, rendered in {}; its own error is {}, and its mean radiance {}",
      count_of(static_cast<std::uint64_t>(reference.samples), "sample"),
      describe_configuration(reference.configuration), reference.seed, duration(reference.seconds),
      read(reference.error, percent).text(), figure(reference.mean_radiance));
  if (reference.scarce_emitters > 0) {
    text += fmt::format("; {} reached by very few of its paths, so that light may be missing",
                        count_of(reference.scarce_emitters, "emitter"));
  }
  return text;
}

Section method_section(const Report& report) {
  const render::Measurement& measurement = report.measurement;
  Facts facts;
  facts.add("Reference", measurement.reference ? escaped(describe_reference(*measurement.reference))
                                               : std::string("none was rendered"));
  facts.add("The scene's own settings",
            escaped(fmt::format(
                "{}, {}", count_of(static_cast<std::uint64_t>(measurement.own_samples), "sample"),
                describe_configuration(measurement.own))));
  facts.add("Size", fmt::format("{} × {} pixels", measurement.width, measurement.height));
  facts.add("Seed", fmt::to_string(measurement.seed));
  facts.add("Threads", fmt::to_string(measurement.threads));
  facts.add("Time spent", fmt::format("{} of a budget of {}", duration(measurement.spent_seconds),
                                      duration(measurement.budget_seconds)));
  facts.add("Reading and writing",
            fmt::format("{} for a picture of full size; part of the recommended times",
                        duration(measurement.other_seconds)));
  facts.add("Version", escaped(report.provenance.version));
  facts.add("Command", fmt::format("<code>{}</code>", escaped(report.provenance.command)));
  std::string html =
      "<p>Each render was timed and its picture compared with one long reference. The error is the "
      "root mean square difference over all pixels and channels, in linear radiance, divided by "
      "the mean radiance: 1 % is almost invisible, 5 % is fine grain, 20 % is a draft. Each figure "
      "has a 95 % confidence interval: of a hundred such intervals about ninety-five cover the "
      "true value. If the intervals of two renders overlap, this measurement cannot decide which "
      "one is better, and says so. Times are medians for building and tracing on this "
      "machine.</p>\n";
  html += facts.finish();
  if (!report.provenance.machine.empty()) {
    Facts machine;
    for (const auto& [what, value] : report.provenance.machine) machine.add(what, escaped(value));
    html += "<h3>The machine</h3>\n" + machine.finish();
  }
  Section section;
  section.page_only(html);
  return section;
}

}  // namespace sdlc::cli
