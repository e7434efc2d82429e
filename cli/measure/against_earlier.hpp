#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/measure/measurement_json.hpp"
#include "render/measure/against.hpp"

namespace sdlc::cli {

/// Compares a measurement of this machine with an earlier one of the same scene and size; includes
/// notes for the reader.
render::Comparison compare_with_earlier(
    const render::Measurement& measurement,
    const std::vector<std::pair<std::string, std::string>>& machine,
    const EarlierMeasurement& earlier);

/// Whether anything has become worse.
bool is_worse(const render::Comparison& comparison);

}  // namespace sdlc::cli
