#include "lang/repair/scene_round.hpp"

#include <fmt/format.h>

#include "lang/repair/vocabulary.hpp"

namespace sdlc::lang {

DiagnosticBuilder SceneRound::expected(Span span, std::string_view what) {
  return report(diag::expected, span, fmt::format("{}, found `{}`", what, text_of(span)));
}

void SceneRound::note_statement() {
  const std::string_view word = tokens_.written(i_);
  if (tokens_.begins_object(i_) && tokens_.may_begin_statement(i_)) {
    next_block_ = word == "group" ? Inside::Group : Inside::Object;
  }
  if (tokens_.is_let_of_value(i_)) {
    is_let_ = true;
  } else if (word == "in" || (tokens_[i_].is_first && tokens_.begins_statement(i_))) {
    is_let_ = false;
  }
  const bool declares = tokens_.is_word(i_) && is_one_of(word, kDeclarationWords);
  if (declares && !tokens_.is_let_of_value(i_)) {
    while (!in_block()) inside_.pop_back();  // never closed
    is_condition_ = word == "assert";
    next_block_ = Inside::Block;
  } else if (word == "if") {
    is_condition_ = true;
  } else if (word == "then" || tokens_.is_bracket(i_, '{')) {
    is_condition_ = false;
  }
}

void SceneRound::follow_brackets() {
  const RepairToken& token = tokens_[i_];
  if (token.bracket == '{') {
    inside_.push_back(next_block_);
    next_block_ = Inside::Block;
  } else if (token.kind == TokenClass::Open) {
    inside_.push_back(tokens_.holds_parameters(i_)          ? Inside::Parameters
                      : tokens_.holds_arguments(i_)         ? Inside::Arguments
                      : i_ > 0 && tokens_.is(i_ - 1, "for") ? Inside::Loop
                                                            : Inside::Value);
  } else if (token.bracket == '}') {
    while (!in_block()) inside_.pop_back();
    if (!inside_.empty()) inside_.pop_back();
  } else if (token.kind == TokenClass::Close && !in_block()) {
    inside_.pop_back();
  } else if (token.kind == TokenClass::Comma && in_block() && !in_object()) {
    is_condition_ = false;
  }
}

}  // namespace sdlc::lang
