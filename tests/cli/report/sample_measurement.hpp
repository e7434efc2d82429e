#pragma once

#include <string>

#include "cli/report/report.hpp"

namespace sdlc::test {

/// A realistic measurement of a small scene: four configurations, 21 renders, every part of a
/// report. The figures follow formulas with a little deterministic noise.
render::Measurement sample_measurement();

/// Its report, with pictures and a comparison with an earlier one.
cli::Report sample_report(const render::Measurement& measurement);

/// The report of a measurement without any additions.
cli::Report bare_report(const render::Measurement& measurement);

}  // namespace sdlc::test
