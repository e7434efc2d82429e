#include <string>
#include <string_view>

#include <fmt/format.h>

#include "cli/report/figures.hpp"
#include "cli/report/html.hpp"
#include "cli/report/section.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::cli {
namespace {

/// Whether float and double differ, according to the interval.
std::string_view verdict_of(const render::Measured& difference) {
  if (!has_interval(difference)) return "it may be chance";
  const auto [from, to] = difference.interval;
  return from <= 0 && to >= 0 ? "not distinguished" : "a significant difference";
}

}  // namespace

Section precision_section(const Report& report) {
  Section section;
  if (!report.measurement.precision) return section;
  const render::PrecisionDifference& precision = *report.measurement.precision;
  const std::string taken(name_of(precision.taken)), other(name_of(precision.other));
  if (!precision.refusal) {
    section.paragraph(fmt::format(
        "Along the same paths, {} minus {}: {} of the mean radiance: <strong>{}</strong>. The "
        "two pictures differ by {} (root mean square, like an error), mostly where rounding made "
        "single paths diverge. A render in {} takes {} the time.",
        taken, other, read(precision.mean_difference, percent).text(),
        verdict_of(precision.mean_difference), percent(precision.rms_difference), other,
        times(precision.relative_seconds)));
  } else {
    section.paragraph(fmt::format("The difference between {} and {} was not measured: {}.", taken,
                                  other, escaped(*precision.refusal)));
  }
  if (!precision.bound.empty()) {
    section.paragraph(
        fmt::format("By default the scene is traced in {}: {}.", taken, escaped(precision.bound)));
  }
  return section;
}

}  // namespace sdlc::cli
