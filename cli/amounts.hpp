#pragma once

#include <string>

namespace sdlc::cli {

/// The share that the text is: a number above 0 and at most 1, or with a `%` behind it at most 100.
/// Throws CLI::ValidationError, which names the flag.
double parse_share(const std::string& flag, const std::string& text);

/// The ratio that the text is: a finite number from 0 on, or with a `%` behind it that many
/// hundredths. Throws CLI::ValidationError, which names the flag.
double parse_ratio(const std::string& flag, const std::string& text);

/// The seconds that the text is: a number with its unit, `ms`, `s`, `min` or `h`; above 0 and
/// finite. Throws CLI::ValidationError, which names the flag.
double parse_duration(const std::string& flag, const std::string& text);

/// The number that the text is: finite and not below `min`. Throws CLI::ValidationError, which
/// names the flag.
double parse_number(const std::string& flag, const std::string& text, double min);

/// The same of any finite number.
double parse_signed_number(const std::string& flag, const std::string& text);

/// The same of a finite number above 0.
double parse_positive_number(const std::string& flag, const std::string& text);

}  // namespace sdlc::cli
