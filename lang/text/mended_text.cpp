#include "lang/text/mended_text.hpp"

#include <algorithm>

#include "lang/text/brackets.hpp"

namespace sdlc::lang {
namespace {

/// Whether what stands in front of the token is a name that has run together with the first of
/// several parameters.
bool is_merged(const LayoutToken& token) {
  return token.kind == LayoutKind::Comma || token.kind == LayoutKind::Close ||
         token.kind == LayoutKind::Operator;
}

}  // namespace

bool has_matching_brackets(std::span<const LayoutToken> tokens) {
  std::string open;
  for (const LayoutToken& token : tokens) {
    if (token.kind == LayoutKind::Open) open += token.bracket;
    if (token.kind != LayoutKind::Close) continue;
    if (open.empty() || !is_bracket_pair(open.back(), token.bracket)) return false;
    open.pop_back();
  }
  return open.empty();
}

MendedText::MendedText(std::string_view source, std::span<const LayoutToken> tokens,
                       const BracketRepair& repair)
    : source_(source), tokens_(tokens) {
  auto fault = repair.faults.begin();
  auto uncertain_token = repair.uncertain.begin();
  for (std::uint32_t token = 0; token <= tokens.size(); ++token) {
    for (; fault != repair.faults.end() && fault->token == token; ++fault) repair_bracket(*fault);
    if (token == tokens.size()) break;
    copy_to(tokens[token].begin);
    if (!tokens[token].meant.empty() && copied_ == tokens[token].begin) correct(tokens[token]);
    if (uncertain_token != repair.uncertain.end() && *uncertain_token == token) {
      uncertain_.push_back(static_cast<std::uint32_t>(text_.size()));
      ++uncertain_token;
    }
  }
  copy_to(static_cast<std::uint32_t>(source.size()));
  tokens_ = {};  // they need not live as long
}

void MendedText::copy_to(std::uint32_t end) {
  if (end <= copied_) return;
  text_ += source_.substr(copied_, end - copied_);
  copied_ = end;
}

void MendedText::add(std::string_view what) {
  for (const char c : what) {
    added_.push_back(static_cast<std::uint32_t>(text_.size()));
    text_ += c;
  }
}

/// The word with what it has too little added, or what it has too much blanked.
void MendedText::correct(const LayoutToken& token) {
  const std::size_t size = token.end - token.begin;
  text_ += token.meant.substr(0, size);
  if (token.meant.size() < size) text_.append(size - token.meant.size(), ' ');
  if (token.meant.size() > size) add(token.meant.substr(size));
  copied_ = token.end;
}

void MendedText::repair_bracket(const BracketFault& fault) {
  const LayoutToken* token = fault.token < tokens_.size() ? &tokens_[fault.token] : nullptr;
  const LayoutToken* last = fault.token > 0 ? &tokens_[fault.token - 1] : nullptr;
  if (fault.kind == BracketFault::Surplus) {
    copy_to(token->begin);
    text_.append(token->end - token->begin, ' ');  // one that was only added has no length
    copied_ = token->end;
    return;
  }
  if (fault.kind == BracketFault::Swapped) {
    const LayoutToken& next = tokens_[fault.token + 1];
    copy_to(token->begin);
    text_ += source_.substr(next.begin, next.end - next.begin);
    text_ += source_.substr(token->end, next.begin - token->end);
    text_ += source_.substr(token->begin, token->end - token->begin);
    copied_ = next.end;
    return;
  }
  if (fault.kind == BracketFault::MissingMark || fault.kind == BracketFault::MissingThird) {
    copy_to(last->end);
    add(fault.kind == BracketFault::MissingThird ? ", 0" : std::string_view(&fault.bracket, 1));
    return;
  }
  const bool opens_parenthesis = fault.kind == BracketFault::MissingOpen && fault.bracket == '(';
  if (opens_parenthesis && last != nullptr && is_merged(*token)) {
    copy_to(last->begin);
    add("f(");
    return;
  }
  const bool is_behind_last = fault.kind == BracketFault::MissingClose || fault.bracket == '{' ||
                              (opens_parenthesis && last != nullptr && last->is_callable);
  copy_to(is_behind_last && last != nullptr ? last->end : token->begin);
  // What was run together with the bracket's content has no name of its own left.
  if (opens_parenthesis && !is_behind_last && token->kind == LayoutKind::Label) add("f");
  add(std::string_view(&fault.bracket, 1));
}

std::uint32_t MendedText::in_source(std::uint32_t at) const noexcept {
  const auto added = std::lower_bound(added_.begin(), added_.end(), at);
  return at - static_cast<std::uint32_t>(added - added_.begin());
}

bool MendedText::is_added(std::uint32_t at) const noexcept {
  return std::binary_search(added_.begin(), added_.end(), at);
}

bool MendedText::is_uncertain(std::uint32_t at) const noexcept {
  return is_added(at) || std::binary_search(uncertain_.begin(), uncertain_.end(), at);
}

}  // namespace sdlc::lang
