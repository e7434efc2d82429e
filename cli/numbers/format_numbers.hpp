#pragma once

#include <cstdint>
#include <string>

/// Numbers formatted for people.
namespace sdlc::cli {

/// "0.15 ms", "850 ms", "12.3 s", "4 min 05 s", "2 h 10 min".
std::string format_seconds(double seconds);
/// A count with a metric prefix and three digits: "7.12 M".
std::string format_count(double count);
/// All digits, in groups of three: "1,000,000".
std::string format_whole(std::uint64_t number);
/// "512 B", "38.1 MiB".
std::string format_bytes(std::uint64_t bytes);
/// At most six digits, in the spelling of the language: "-0.333333", "1e9".
std::string format_rounded(double number);

}  // namespace sdlc::cli
