#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::lang {

/// Selects diagnostics by codes (`E104`) or prefixes of codes (`E1`). If several match, the longest
/// decides.
struct CodeFilter {
  std::vector<std::string> selected;  ///< empty: all
  std::vector<std::string> ignored;

  /// nullopt if neither list matches the code.
  std::optional<bool> answer(std::string_view code) const;
  bool wants(std::string_view code) const { return answer(code).value_or(true); }
  bool wants(const DiagnosticInfo& info) const { return wants(info.code); }
};

/// Returns the code or prefix in upper case. Throws std::invalid_argument, with a message for the
/// user, if it matches no diagnostic.
std::string parse_code(std::string text);

}  // namespace sdlc::lang
