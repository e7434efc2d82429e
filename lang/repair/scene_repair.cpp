#include "lang/repair/scene_repair.hpp"

#include <algorithm>
#include <utility>

#include "lang/repair/brackets.hpp"
#include "lang/repair/scene_marks.hpp"
#include "lang/repair/scene_phrases.hpp"
#include "lang/repair/scene_words.hpp"
#include "lang/repair/tokens.hpp"
#include "lang/source/limits.hpp"
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

/// Faults that say less than the message about what is beside them.
void drop_lesser_faults(const TokenList& tokens, std::string_view text,
                        std::vector<BracketFault>& faults) {
  const bool is_cut_off = ends_in_comment(text);
  std::erase_if(faults, [&](const BracketFault& fault) {
    // What a comment swallowed may have closed them.
    if (fault.token == tokens.size()) return is_cut_off;
    const bool lacks_value =
        fault.kind == BracketFault::Surplus && fault.token > 0 &&
        tokens.is(fault.token, TokenClass::Close) &&
        (tokens.is(fault.token - 1, TokenClass::Label) || tokens.is(fault.token - 1, "="));
    return lacks_value;
  });
}

void repair_brackets_and_marks(const SourceFile& file, bool may_mismatch, RepairedText& repaired,
                               DiagnosticSink& sink) {
  sink.stop_if_requested();
  const TokenList tokens = scene_tokens(repaired.text());
  if (may_mismatch || !tokens.has_matching_brackets()) {
    BracketFaults faults = find_scene_bracket_faults(tokens);
    sink.stop_if_requested();
    drop_lesser_faults(tokens, repaired.text(), faults.faults);
    repair_brackets(file, tokens, faults, repaired, sink);
  }
  std::vector<std::uint32_t> uncertain;
  std::vector<Edit> edits =
      repair_marks(file, scene_tokens(repaired.text()), repaired, sink, uncertain);
  repaired.apply(std::move(edits), uncertain);
}

}  // namespace

std::optional<RepairedText> repair_scene(const SourceFile& file, std::string_view text,
                                         SceneRepairOptions options, DiagnosticSink& sink) {
  if (text.size() > kMaxRepairedText) return std::nullopt;
  RepairedText repaired(text);
  repaired.apply(repair_phrases(file, scene_tokens(text), repaired, sink));
  repaired.apply(
      repair_words(file, scene_tokens(repaired.text()), options.is_certain, repaired, sink));
  if (!options.is_certain) {
    repair_brackets_and_marks(file, options.may_mismatch, repaired, sink);
  }
  if (!repaired.is_changed()) return std::nullopt;
  return repaired;
}

}  // namespace sdlc::lang
