#pragma once

#include <string>
#include <vector>

#include "cli/measure/measurement_data.hpp"
#include "render/measure/against.hpp"

/// What a reader has to know before reading a measurement, as sentences.
namespace sdlc::cli {

std::vector<std::string> notes_of(const render::Measurement& measurement);

/// Compares a measurement with an earlier one of the same scene and size, with notes.
render::Comparison compare_with_earlier(const render::Measurement& measurement,
                                        const Provenance& provenance,
                                        const EarlierMeasurement& earlier);

}  // namespace sdlc::cli
