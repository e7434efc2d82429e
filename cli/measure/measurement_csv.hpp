#pragma once

#include <string>

#include "render/measure/measurement.hpp"

namespace sdlc::cli {

/// The points as comma-separated values (RFC 4180): a header line, then one line per point.
std::string to_csv(const render::Measurement& measurement);

}  // namespace sdlc::cli
