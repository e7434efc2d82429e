#pragma once

#include <string>

#include "cli/report/report.hpp"

namespace sdlc::test {

/// A measurement as it comes of a small scene: four ways, 21 renders, every part of a report. The
/// figures follow from laws with a little noise, and are the same in each run.
render::Measurement sample_measurement();

/// Its report, with pictures and a comparison with an earlier one.
cli::Report sample_report(const render::Measurement& measurement);

/// The report of a measurement without anything beside it.
cli::Report bare_report(const render::Measurement& measurement);

}  // namespace sdlc::test
