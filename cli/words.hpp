#pragma once

#include <span>
#include <string_view>

namespace sdlc::cli {

/// " (did you mean `x`?)", or empty.
std::string did_you_mean(std::string_view name, std::span<const std::string_view> candidates);

}  // namespace sdlc::cli
