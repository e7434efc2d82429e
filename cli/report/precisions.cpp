#include <string>
#include <string_view>

#include <fmt/format.h>

#include "cli/report/figures.hpp"
#include "cli/report/html.hpp"
#include "cli/report/sections.hpp"
#include "render/scene/precision.hpp"

namespace sdlc::cli {
namespace {

/// Whether float and double differ, according to the interval.
std::string_view verdict_of(const render::Measured& difference) {
  if (!has_interval(difference)) return "it may be chance";
  const auto [from, to] = difference.interval;
  return from <= 0 && to >= 0 ? "not distinguished" : "a significant difference";
}

std::string capitalized(std::string_view word) {
  std::string text(word);
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] += 'A' - 'a';
  return text;
}

}  // namespace

std::string precision_section(const Report& report) {
  if (!report.measurement.precision) return "";
  const render::PrecisionDifference& precision = *report.measurement.precision;
  const std::string taken(name_of(precision.taken)), other(name_of(precision.other));
  std::string html;
  if (precision.refusal.empty()) {
    html = fmt::format(
        "<p>Along the same paths, {} minus {}: {} of the mean radiance: <strong>{}</strong>. The "
        "two pictures differ by {} (root mean square, like an error), mostly where rounding made "
        "single paths diverge. {} takes {} the time.</p>\n",
        taken, other, read(precision.mean_difference, percent).text(),
        verdict_of(precision.mean_difference), percent(precision.rms_difference),
        capitalized(other), times(precision.seconds));
  } else {
    html = fmt::format("<p>{} was not compared with {}: {}.</p>\n", capitalized(taken), other,
                       escaped(precision.refusal));
  }
  if (!precision.bound.empty()) {
    html += fmt::format("<p>By default the scene is traced in {}: {}.</p>\n", taken,
                        escaped(precision.bound));
  }
  return html;
}

}  // namespace sdlc::cli
