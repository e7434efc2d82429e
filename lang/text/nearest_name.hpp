#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sdlc::lang {

/// The candidate nearest to `name`, for "did you mean": the one with the smallest
/// Damerau-Levenshtein distance (case ignored), if that is at most a third of the longer length, or
/// 1 among few candidates; or one that `name` abbreviates or extends. Ties go to the earlier
/// candidate; `name` itself is excluded.
std::optional<std::string_view> nearest_name(std::string_view name,
                                             std::span<const std::string_view> candidates);

/// " (did you mean `x`?)", or empty.
std::string did_you_mean(std::string_view name, std::span<const std::string_view> candidates);

}  // namespace sdlc::lang
