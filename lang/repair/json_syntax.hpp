#pragma once

#include <vector>

#include "lang/repair/scene_repair.hpp"
#include "lang/repair/tokens.hpp"

namespace sdlc::lang {

/// What a repaired text has in place of something that has been reported; see grammar/json.hpp.
inline constexpr char kRepairedValue = '\x1A';
inline constexpr char kRepairedMember = '\x1C';
inline constexpr char kRepairedName = '\x1D';
constexpr bool is_repair_mark(char c) noexcept {
  return c == kRepairedValue || c == kRepairedMember || c == kRepairedName;
}

/// Finds what the grammar of JSON does not get past: expressions, strings that are never closed,
/// characters without a place. Reports it, and returns the edits that replace it by these marks.
std::vector<Edit> repair_json_syntax(const RepairContext& context, const TokenList& tokens);

}  // namespace sdlc::lang
