#pragma once

#include <cstdint>
#include <vector>

#include "lang/repair/scene_repair.hpp"
#include "lang/repair/tokens.hpp"

/// Which bracket is missing, one too many or of the wrong kind in a text whose brackets do not
/// match. One scan with a stack; where more than one place is possible, lines and indentation
/// decide: indented text belongs to the block before it, and a bracket that is the first of its
/// line closes one of a line with the same indentation.
namespace sdlc::lang {

struct BracketFault {
  enum Kind : std::uint8_t {
    MissingOpen,   ///< before `token`
    MissingClose,  ///< before `token`
    Surplus,       ///< `token` itself
    Replaced,      ///< `token` is where `bracket` should be
    Swapped,       ///< `token` and the next
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  Kind kind;
  char bracket;                   ///< the missing or surplus bracket
  std::uint32_t token;            ///< the number of tokens: the end of the text
  std::uint32_t partner = kNone;  ///< the other bracket of the pair, if the text has it
};

/// In the order of their tokens.
std::vector<BracketFault> find_scene_bracket_faults(const TokenList& tokens);
std::vector<BracketFault> find_json_bracket_faults(const TokenList& tokens);

/// Reports the faults; the edits remove them.
std::vector<Edit> repair_brackets(const RepairContext& context, const TokenList& tokens,
                                  const std::vector<BracketFault>& faults);

}  // namespace sdlc::lang
