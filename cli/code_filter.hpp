#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::cli {

/// Which diagnostics are wanted, by codes (`E104`) or the beginnings of codes (`E1`). Of several
/// that fit a code the longest decides.
struct CodeFilter {
  std::vector<std::string> selected;  ///< empty: all
  std::vector<std::string> ignored;

  /// Nothing where neither list says anything about the code.
  std::optional<bool> answer(std::string_view code) const;
  bool wants(std::string_view code) const { return answer(code).value_or(true); }
  bool wants(const lang::DiagnosticInfo& info) const { return wants(info.code); }
};

/// The code or beginning of a code, in upper case. Throws std::invalid_argument, with a message for
/// the user, where it fits no diagnostic.
std::string parse_code(std::string text);

/// --select and --ignore: lists with commas, which may be repeated. A code that fits no diagnostic
/// is refused.
void add_code_filter(CLI::App& command, CodeFilter& filter);

}  // namespace sdlc::cli
