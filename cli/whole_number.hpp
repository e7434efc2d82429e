#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace sdlc::cli {

/// Which whole numbers a flag takes, both ends included.
struct WholeNumbers {
  std::uint64_t lowest = 0, highest = UINT64_MAX;
};

/// The number that the text is, in decimal digits alone. Throws CLI::ValidationError, which names
/// the flag.
std::uint64_t parse_whole_number(const std::string& flag, const std::string& text,
                                 WholeNumbers range);

/// Adds a flag whose value is a whole number; `take` is called with it.
CLI::Option* add_whole_number(CLI::App& command, const std::string& flag, WholeNumbers range,
                              std::function<void(std::uint64_t)> take, const std::string& doc);

}  // namespace sdlc::cli
