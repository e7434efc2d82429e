#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lang/syntax/foreign_phrases.hpp"
#include "lang/syntax/vocabulary.hpp"
#include "lang/token/name_characters.hpp"

namespace sdlc::lang {

/// Goes through a list of tokens and makes another of them, with what it tells of the changes.
class TokenEditor {
 protected:
  TokenEditor(std::string_view text, std::vector<LayoutToken>& tokens) : text_(text), in_(tokens) {}

  /// The tokens become what was made of them.
  ForeignPhrases finish() {
    in_ = std::move(out_);
    return std::move(result_);
  }

  // Tokens, of which there may be none

  const LayoutToken* near(std::size_t i) const { return i < in_.size() ? &in_[i] : nullptr; }
  const LayoutToken* before() const { return at_ > 0 ? near(at_ - 1) : nullptr; }
  std::string_view written(const LayoutToken* token) const {
    return token == nullptr ? std::string_view()
                            : text_.substr(token->begin, token->end - token->begin);
  }
  std::string_view written(std::size_t i) const { return written(near(i)); }
  char first(std::size_t i) const { return i < in_.size() ? text_[in_[i].begin] : '\0'; }
  bool is(std::size_t i, LayoutKind kind) const { return i < in_.size() && in_[i].kind == kind; }
  bool is_bracket(std::size_t i, char bracket) const {
    return i < in_.size() && in_[i].bracket == bracket;
  }
  bool is_word(std::size_t i) const { return is(i, LayoutKind::Value) && is_letter(first(i)); }
  bool is_name(std::size_t i) const { return is_word(i) && !is_one_of(written(i), kReservedWords); }
  bool is_string(std::size_t i) const { return is(i, LayoutKind::Value) && first(i) == '"'; }
  bool is_number(std::size_t i) const {
    return is(i, LayoutKind::Value) && (is_digit(first(i)) || first(i) == '.');
  }
  bool is_behind(std::size_t i) const { return i < in_.size() && !in_[i].is_first; }
  bool is_joined(std::size_t i) const {
    return i > 0 && i < in_.size() && in_[i - 1].end == in_[i].begin;
  }
  static Span span_of(const LayoutToken& token) { return {token.begin, token.end}; }
  Span span_of(std::size_t first, std::size_t last) const {
    return {in_[first].begin, in_[last].end};
  }
  std::string_view text(Span span) const { return text_.substr(span.begin, span.size()); }

  /// Whether a statement may begin at this token.
  bool may_begin() const {
    const LayoutToken* token = before();
    return token == nullptr || in_[at_].is_first || token->kind == LayoutKind::Comma ||
           token->bracket == '{' || token->bracket == '}' || written(token) == ";";
  }
  bool awaits_value() const {
    const LayoutToken* token = before();
    if (token == nullptr) return false;
    return token->kind == LayoutKind::Label || token->kind == LayoutKind::Operator ||
           token->kind == LayoutKind::Comma || token->bracket == '(' || token->bracket == '[' ||
           is_one_of(written(token), kJoints);
  }

  /// The token with the bracket that matches the one at `open`; the number of tokens if none does.
  std::size_t closing_of(std::size_t open) const { return closings_[open]; }

  void match_brackets() {
    closings_.assign(in_.size(), in_.size());
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < in_.size(); ++i) {
      if (in_[i].kind == LayoutKind::Open) open.push_back(i);
      if (in_[i].kind != LayoutKind::Close || open.empty()) continue;
      closings_[open.back()] = i;
      open.pop_back();
    }
  }

  // What becomes of them

  void emit(const LayoutToken& token, bool is_told) {
    if (token.kind == LayoutKind::Open) open_ += token.bracket;
    if (token.kind == LayoutKind::Close && !open_.empty()) open_.pop_back();
    out_.push_back(token);
    result_.is_told.push_back(is_told);
  }
  void keep() { emit(in_[at_], false); }
  bool meant_as(std::string_view meant) {
    LayoutToken token = in_[at_];
    token.meant = meant;
    emit(token, true);
    return true;
  }
  /// Nothing stands here. Behind a word a value follows; a comma may stand behind any.
  bool blank() {
    LayoutToken token = in_[at_];
    token.kind = is_word(at_) ? LayoutKind::Operator : LayoutKind::Comma;
    token.bracket = '\0';
    token.meant = " ";
    emit(token, true);
    return true;
  }
  bool bracket(LayoutKind kind, char bracket, std::string_view meant) {
    LayoutToken token = in_[at_];
    token.kind = kind;
    token.bracket = bracket;
    token.meant = meant;
    emit(token, true);
    return true;
  }
  bool closing() { return bracket(LayoutKind::Close, ')', ")"); }
  void add(const LayoutToken& beside, std::uint32_t at, LayoutKind kind, std::string_view meant) {
    emit({.begin = at,
          .end = at,
          .line = beside.line,
          .indent = beside.indent,
          .kind = kind,
          .bracket = kind == LayoutKind::Comma ? '\0' : meant[0],
          .meant = meant},
         true);
  }
  ForeignPhrase& tell(ForeignPhrase::Kind kind, Span span, std::string message, std::string help) {
    result_.phrases.push_back(
        {.kind = kind, .span = span, .message = std::move(message), .help = std::move(help)});
    return result_.phrases.back();
  }
  std::string_view store(std::string word) { return result_.words.emplace_back(std::move(word)); }

  std::string_view text_;
  std::vector<LayoutToken>& in_;
  std::vector<LayoutToken> out_;
  std::size_t at_ = 0;  ///< the token that is looked at
  std::string open_;    ///< the brackets around it
  ForeignPhrases result_;

 private:
  std::vector<std::size_t> closings_;  ///< of each opening bracket, as closing_of gives them
};

}  // namespace sdlc::lang
