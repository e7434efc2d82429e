#include "lang/repair/scene_repair.hpp"

#include <algorithm>

#include "lang/repair/brackets.hpp"
#include "lang/repair/tokens.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

bool ends_in_comment(std::string_view text) {
  TokenReader reader(text);
  Token last;
  for (Token token = reader.next(); token.kind != TokenKind::End; token = reader.next()) {
    last = token;
  }
  return last.kind == TokenKind::UnclosedComment;
}

/// Drops faults that follow from another mistake beside them.
void drop_lesser_faults(const TokenList& tokens, std::vector<BracketFault>& faults) {
  const bool is_cut_off = ends_in_comment(tokens.text());
  std::erase_if(faults, [&](const BracketFault& fault) {
    // The comment may contain the closing brackets.
    if (fault.token == tokens.size()) return is_cut_off;
    return fault.kind == BracketFault::Surplus && fault.token > 0 &&
           tokens.is(fault.token, TokenClass::Close) &&
           (tokens.is(fault.token - 1, TokenClass::Label) || tokens.is(fault.token - 1, "="));
  });
}

}  // namespace

void repair_spelling(const RepairContext& context) {
  repair_blocks(context);
  repair_values(context);
  repair_signs(context);
  repair_words(context);
  repair_statements(context);
}

void repair_structure(const RepairContext& context, bool may_mismatch) {
  context.sink.stop_if_requested();
  const TokenList tokens = scene_tokens(context.text.text());
  if (may_mismatch || !tokens.has_matching_brackets()) {
    std::vector<BracketFault> faults = find_scene_bracket_faults(tokens);
    drop_lesser_faults(tokens, faults);
    repair_brackets(context, tokens, faults);
  }
  repair_marks(context);
}

}  // namespace sdlc::lang
