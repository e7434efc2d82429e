#pragma once

#include <string>
#include <vector>

#include "render/measure/measurement.hpp"

namespace sdlc::cli {

/// Warnings that a reader has to know before reading a measurement, as sentences.
std::vector<std::string> notes_of(const render::Measurement& measurement);

}  // namespace sdlc::cli
