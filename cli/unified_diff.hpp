#pragma once

#include <string>
#include <string_view>

namespace sdlc::cli {

/// What turns one text into another, in the unified format that `patch` and `git apply` read, with
/// three lines around each change; empty where the texts are the same. Time is linear in texts that
/// have most of their lines once, as a file and its formatted form do; it need not be the shortest
/// of all.
std::string unified_diff(std::string_view name, std::string_view before, std::string_view after);

}  // namespace sdlc::cli
