#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sdlc::cli {

/// The machine properties that affect times: "processor", "cores", "memory", "system", as far as
/// they are known.
std::vector<std::pair<std::string, std::string>> describe_machine();

}  // namespace sdlc::cli
