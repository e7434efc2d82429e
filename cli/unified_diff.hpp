#pragma once

#include <string>
#include <string_view>

namespace sdlc::cli {

/// The difference of two texts in the unified format that `patch` and `git apply` read, with three
/// lines of context; empty if they are equal. Linear time for texts whose lines are mostly unique,
/// such as a file and its formatted form; the result need not be minimal.
std::string unified_diff(std::string_view name, std::string_view before, std::string_view after);

}  // namespace sdlc::cli
