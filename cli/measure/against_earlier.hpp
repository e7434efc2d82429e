#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/measure/measurement_json.hpp"
#include "render/measure/against.hpp"

namespace sdlc::cli {

/// A measurement of this machine held against an earlier one of the same scene and size, with what
/// a reader has to know of it.
render::Comparison compare_with_earlier(
    const render::Measurement& measurement,
    const std::vector<std::pair<std::string, std::string>>& machine,
    const EarlierMeasurement& earlier);

/// Whether anything has become worse.
bool is_worse(const render::Comparison& comparison);

}  // namespace sdlc::cli
