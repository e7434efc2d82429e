#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace sdlc::cli {

/// The range of a flag's value, inclusive.
struct WholeNumbers {
  std::uint64_t lowest = 0, highest = UINT64_MAX;
};

/// Parses decimal digits. Throws CLI::ValidationError, which names the flag.
std::uint64_t parse_whole_number(const std::string& flag, const std::string& text,
                                 WholeNumbers range);

/// Adds a flag whose value is a whole number, which is passed to `take`.
CLI::Option* add_whole_number(CLI::App& command, const std::string& flag, WholeNumbers range,
                              std::function<void(std::uint64_t)> take, const std::string& doc);

}  // namespace sdlc::cli
