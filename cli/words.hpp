#pragma once

#include <span>
#include <string_view>

#include <CLI/CLI.hpp>

namespace sdlc::cli {

/// Accepts one of `words`, which must outlive the validator; the error suggests the nearest word.
CLI::Validator one_of(std::span<const std::string_view> words);

/// " (did you mean `x`?)", or empty.
std::string did_you_mean(std::string_view name, std::span<const std::string_view> candidates);

}  // namespace sdlc::cli
