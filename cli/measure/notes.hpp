#pragma once

#include <string>
#include <vector>

#include "render/measure/measurement.hpp"

namespace sdlc::cli {

/// What a reader has to know before anything that a measurement says, in sentences.
std::vector<std::string> notes_of(const render::Measurement& measurement);

}  // namespace sdlc::cli
