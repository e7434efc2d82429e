#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sdlc::cli {

/// What times depend on: "processor", "cores", "memory", "system", as far as the system tells.
std::vector<std::pair<std::string, std::string>> describe_machine();

}  // namespace sdlc::cli
