#include "lang/repair/scene_repair.hpp"

#include <algorithm>
#include <utility>

#include "lang/repair/brackets.hpp"
#include "lang/repair/tokens.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

bool ends_in_comment(const RepairedText& text) {
  TokenReader reader(std::string_view(text.text()).substr(0, text.part().end), text.part().begin);
  Token last;
  for (Token token = reader.next(); token.kind != TokenKind::End; token = reader.next()) {
    last = token;
  }
  return last.kind == TokenKind::UnclosedComment;
}

/// Drops faults that follow from another mistake beside them.
void drop_lesser_faults(const RepairedText& text, const TokenList& tokens,
                        std::vector<BracketFault>& faults) {
  const bool is_cut_off = ends_in_comment(text);
  std::erase_if(faults, [&](const BracketFault& fault) {
    // The comment may contain the closing brackets.
    if (fault.token == tokens.size()) return is_cut_off;
    return fault.kind == BracketFault::Surplus && fault.token > 0 &&
           tokens.is(fault.token, TokenClass::Close) &&
           (tokens.is(fault.token - 1, TokenClass::Label) || tokens.is(fault.token - 1, "="));
  });
}

/// Makes the edits of a round and reads the tokens again if there are any.
void apply(std::vector<Edit> edits, RepairedText& text, TokenList& tokens) {
  if (edits.empty()) return;
  text.apply(std::move(edits));
  tokens = scene_tokens(text);
}

}  // namespace

void repair_spelling(const RepairContext& context) {
  TokenList tokens = scene_tokens(context.text);
  for (const auto round : {repair_calls, repair_blocks, repair_values, repair_signs, repair_words,
                           repair_statements}) {
    apply(round(context, tokens), context.text, tokens);
  }
}

void repair_structure(const RepairContext& context, bool may_mismatch) {
  context.sink.stop_if_requested();
  TokenList tokens = scene_tokens(context.text);
  if (may_mismatch || !tokens.has_matching_brackets()) {
    std::vector<BracketFault> faults = find_scene_bracket_faults(tokens);
    drop_lesser_faults(context.text, tokens, faults);
    apply(repair_brackets(context, tokens, faults), context.text, tokens);
  }
  context.text.apply(repair_marks(context, tokens));
}

}  // namespace sdlc::lang
