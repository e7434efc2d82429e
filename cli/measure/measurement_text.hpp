#pragma once

#include <string>

#include "cli/report/report.hpp"

namespace sdlc::cli {

/// What a report says, for a terminal: the recommendations last, where they are seen.
std::string to_text(const Report& report);

}  // namespace sdlc::cli
