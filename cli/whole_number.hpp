#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "cli/command_line.hpp"

namespace sdlc::cli {

/// The range of a flag's value, inclusive.
struct WholeNumbers {
  std::uint64_t lowest = 0, highest = UINT64_MAX;
};

/// Parses decimal digits. Throws ArgumentError.
std::uint64_t parse_whole_number(const std::string& flag, const std::string& text,
                                 WholeNumbers range);

/// Adds a flag whose value is a whole number, which is passed to `take`.
Option add_whole_number(Command& command, const std::string& flag, WholeNumbers range,
                        std::function<void(std::uint64_t)> take, const std::string& doc);

}  // namespace sdlc::cli
