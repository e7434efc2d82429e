#pragma once

#include <string>
#include <string_view>

#include "cli/report/report.hpp"
#include "render/measure/measurement.hpp"

/// A measurement as data. docs/measure.md lists the fields.
namespace sdlc::cli {

std::string to_json(const Report& report);

/// The points as comma-separated values (RFC 4180): a header line, then one line per point. The
/// columns are the fields of a point in JSON: an interval is two columns, a list its length, an
/// object its numbers.
std::string to_csv(const render::Measurement& measurement);

/// The parts of an earlier report that are needed for a comparison.
struct EarlierMeasurement {
  Provenance provenance;
  render::Measurement measurement;
};

/// Reads the output of to_json. Throws std::invalid_argument with the reason if the text is
/// something else.
EarlierMeasurement read_measurement(std::string_view text);

}  // namespace sdlc::cli
