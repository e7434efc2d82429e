#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command_line.hpp"
#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::cli {

/// Selects diagnostics by codes (`E104`) or prefixes of codes (`E1`). If several match, the longest
/// decides.
struct CodeFilter {
  std::vector<std::string> selected;  ///< empty: all
  std::vector<std::string> ignored;

  /// nullopt if neither list matches the code.
  std::optional<bool> answer(std::string_view code) const;
  bool wants(std::string_view code) const { return answer(code).value_or(true); }
  bool wants(const lang::DiagnosticInfo& info) const { return wants(info.code); }
};

/// Returns the code or prefix in upper case. Throws std::invalid_argument, with a message for the
/// user, if it matches no diagnostic.
std::string parse_code(std::string text);

/// --select and --ignore: comma-separated lists, which may be repeated. A code that matches no
/// diagnostic is rejected.
void add_code_filter(Command& command, CodeFilter& filter);

}  // namespace sdlc::cli
