#pragma once

#include <string>

namespace sdlc::cli {

/// Parses a share: a number above 0 and at most 1, or at most 100 with a `%`. Throws
/// ArgumentError.
double parse_share(const std::string& flag, const std::string& text);

/// Parses a ratio: a finite number from 0 on, or a percentage with `%`. Throws ArgumentError.
double parse_ratio(const std::string& flag, const std::string& text);

/// Parses a duration in seconds: a number with a unit, `ms`, `s`, `min` or `h`; above 0 and finite.
/// Throws ArgumentError.
double parse_duration(const std::string& flag, const std::string& text);

/// Parses a finite number of at least `min`. Throws ArgumentError.
double parse_number(const std::string& flag, const std::string& text, double min);

/// The same for any finite number.
double parse_signed_number(const std::string& flag, const std::string& text);

/// The same for a finite number above 0.
double parse_positive_number(const std::string& flag, const std::string& text);

}  // namespace sdlc::cli
