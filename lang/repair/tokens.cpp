#include "lang/repair/tokens.hpp"

#include <algorithm>
#include <utility>

#include "lang/repair/recovery.hpp"
#include "lang/repair/vocabulary.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/brackets.hpp"

namespace sdlc::lang {

TokenList::TokenList(std::string_view text, std::vector<RepairToken> tokens,
                     std::vector<Span> foreign_comments)
    : text_(text),
      tokens_(std::move(tokens)),
      foreign_comments_(std::move(foreign_comments)),
      partners_(tokens_.size()) {
  const auto size = static_cast<std::uint32_t>(text.size());
  end_ = {.begin = size, .end = size, .line = tokens_.empty() ? 0 : tokens_.back().line + 1};
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < tokens_.size(); ++i) {
    partners_[i] = static_cast<std::uint32_t>(tokens_.size());
    if (tokens_[i].kind == TokenClass::Open) open.push_back(i);
    if (tokens_[i].kind != TokenClass::Close) continue;
    const bool is_pair =
        !open.empty() && is_bracket_pair(tokens_[open.back()].bracket, tokens_[i].bracket);
    has_matching_brackets_ = has_matching_brackets_ && is_pair;
    if (open.empty()) continue;
    partners_[i] = open.back();
    partners_[open.back()] = i;
    open.pop_back();
  }
  has_matching_brackets_ = has_matching_brackets_ && open.empty();
}

bool TokenList::is_word(std::size_t i) const noexcept {
  if (!is(i, TokenClass::Value)) return false;
  const char c = text_[tokens_[i].begin];
  return is_ascii_letter(c) || c == '_' || static_cast<unsigned char>(c) >= 0x80;
}

bool TokenList::is_name(std::size_t i) const noexcept {
  return is_word(i) && !is_one_of(written(i), kReservedWords) && !is(i, "in") && !is(i, "as");
}

bool TokenList::is_number(std::size_t i) const noexcept {
  if (!is(i, TokenClass::Value)) return false;
  const char c = text_[tokens_[i].begin];
  return is_ascii_digit(c) || c == '.';
}

bool TokenList::is_string(std::size_t i) const noexcept {
  return is(i, TokenClass::Value) && text_[tokens_[i].begin] == '"';
}

std::string_view TokenList::label(std::size_t i) const noexcept {
  return written(i).substr(0, written(i).find_first_of(" \t:"));
}

bool TokenList::is_joined(std::size_t i) const noexcept {
  return i > 0 && i < size() && tokens_[i - 1].end == tokens_[i].begin;
}

bool TokenList::wants_operand(std::size_t i) const noexcept {
  const RepairToken& token = (*this)[i];
  switch (token.kind) {
    case TokenClass::Operator: return !is(i, ";");
    case TokenClass::Label: return true;
    case TokenClass::Open: return token.bracket != '{';
    case TokenClass::Value: return is_word(i) && is_one_of(written(i), kJoints);
    default: return false;
  }
}

bool TokenList::may_begin_statement(std::size_t i) const noexcept {
  if (i == 0) return true;
  const RepairToken& before = (*this)[i - 1];
  if (wants_operand(i - 1)) return false;
  return (*this)[i].is_first || before.kind == TokenClass::Comma || is(i - 1, ";") ||
         before.bracket == '{' || before.bracket == '}';
}

bool TokenList::begins_object(std::size_t i) const noexcept {
  if (!is_name(i) || is_one_of(written(i), kStatementWords)) return false;
  if (is_bracket(i + 1, '{')) return true;
  return is_name(i + 1) && is_same_line(i + 1) && is_bracket(i + 2, '{');
}

namespace {

/// Whether the `for` is one of a list: it has no block.
bool is_clause(const TokenList& tokens, std::size_t i) {
  constexpr std::size_t kFar = 100;
  int depth = 0;
  for (std::size_t n = i + 1; n < std::min(tokens.size(), i + kFar); ++n) {
    if (tokens.is_bracket(n, '{')) return false;
    if (is_one_of(tokens.written(n), kDeclarationWords)) return !tokens[i].is_first;
    depth += tokens.is(n, TokenClass::Open) - tokens.is(n, TokenClass::Close);
    if (tokens.is_bracket(n, ']') && depth < 0) return true;
  }
  return false;
}

}  // namespace

bool TokenList::is_let_of_value(std::size_t i) const noexcept {
  if (i == 0 || !is(i, "let")) return false;
  if (wants_operand(i - 1) && is_same_line(i)) return true;
  return (wants_operand(i - 1) || is(i - 1, TokenClass::Comma)) && has_in(text_, (*this)[i].begin);
}

bool TokenList::begins_statement(std::size_t i) const noexcept {
  if (!is_word(i)) return false;
  const std::string_view word = written(i);
  if (is_one_of(word, kDeclarationWords)) return !is_let_of_value(i);
  if (word == "for") {
    return (is_word(i + 1) || is_bracket(i + 1, '(')) && !is_clause(*this, i);
  }
  if (word == "if") return may_begin_statement(i) && !is_choice(i);
  const bool follows_head = i > 0 && is_word(i - 1) && is_one_of(written(i - 1), kJoints);
  const bool is_second = i > 0 && is_name(i - 1) && is_same_line(i) && may_begin_statement(i - 1);
  return begins_object(i) && !follows_head && !is_second && may_begin_statement(i);
}

/// Whether the `if` is one with `then`, a value.
bool TokenList::is_choice(std::size_t i) const noexcept {
  constexpr std::size_t kFar = 100;
  for (std::size_t n = i + 1; n < std::min(size(), i + kFar); ++n) {
    if (is(n, "then")) return true;
    if (is_bracket(n, '{') || is_one_of(written(n), kDeclarationWords)) return false;
  }
  return false;
}

bool TokenList::holds_parameters(std::size_t i) const noexcept {
  return is_bracket(i, '(') && i > 1 && is_name(i - 1) && (is(i - 2, "fn") || is(i - 2, "def"));
}

bool TokenList::holds_arguments(std::size_t i) const noexcept {
  return is_bracket(i, '(') && i > 0 && is_name(i - 1);
}

}  // namespace sdlc::lang
