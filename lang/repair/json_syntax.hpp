#pragma once

#include <vector>

#include "lang/repair/scene_repair.hpp"
#include "lang/repair/tokens.hpp"

namespace sdlc::lang {

/// Marks in a repaired text in place of reported mistakes; see grammar/json.hpp.
inline constexpr char kRepairedValue = '\x1A';
inline constexpr char kRepairedMember = '\x1C';
inline constexpr char kRepairedName = '\x1D';
constexpr bool is_repair_mark(char c) noexcept {
  return c == kRepairedValue || c == kRepairedMember || c == kRepairedName;
}

/// Reports text that the grammar does not accept (expressions, unclosed strings, misplaced
/// characters), and returns the edits that replace it by these marks.
std::vector<Edit> repair_json_syntax(const RepairContext& context, const TokenList& tokens);

}  // namespace sdlc::lang
