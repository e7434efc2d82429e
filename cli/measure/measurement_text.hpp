#pragma once

#include <string>

#include "cli/report/report.hpp"

namespace sdlc::cli {

/// A report for a terminal, with the recommendations last, where they stay visible.
std::string to_text(const Report& report);

}  // namespace sdlc::cli
