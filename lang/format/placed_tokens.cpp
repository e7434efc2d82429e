#include "lang/format/placed_tokens.hpp"

#include <algorithm>

namespace sdlc::lang {

void PlacedTokens::seek(std::uint32_t at) {
  reader_.seek(at);
  comments_.clear();
  next_comment_ = 0;
  read_gap();
  if (at == 0 && has_comments()) comments_[0].breaks_before = 1;
}

std::uint32_t PlacedTokens::seek_line(std::uint32_t at) {
  seek(at);
  while (has_comments() && !peek_comment().has_own_line()) take_comment();
  return has_comments() ? peek_comment().span.begin : token_.span.begin;
}

/// Reads the trivia that follows and the token after it.
void PlacedTokens::read_gap() {
  const std::size_t before = comments_.size();
  const auto end_line = [&] {
    if (comments_.size() > before) comments_.back().ends_line = true;
  };
  std::uint32_t breaks = 0;
  Token token = reader_.next_in_line();
  for (; is_trivia(token.kind); token = reader_.next_in_line()) {
    if (token.kind == TokenKind::LineEnd) {
      ++breaks;
      end_line();
    } else {
      const bool follows_line = !comments_.empty() && comments_.back().ends_line;
      comments_.push_back({.span = token.span,
                           .is_block = token.kind == TokenKind::BlockComment,
                           .breaks_before = follows_line ? std::max(breaks, 1u) : breaks});
      breaks = 0;
    }
  }
  if (token.kind == TokenKind::End) end_line();
  token_ = {.span = token.span, .breaks_before = breaks};
}

std::size_t PlacedTokens::count_trailing_comments() const noexcept {
  std::size_t count = 0;
  while (next_comment_ + count < comments_.size() && !comment(count).has_own_line()) ++count;
  return count;
}

bool PlacedTokens::ends_with_line_end() const noexcept {
  return has_comments() && comments_.back().ends_line;
}

bool PlacedTokens::is_broken_ahead() const noexcept {
  if (token_.breaks_before > 0) return true;
  for (std::size_t i = next_comment_; i < comments_.size(); ++i) {
    if (comments_[i].has_own_line() || comments_[i].ends_line) return true;
  }
  return false;
}

PlacedToken PlacedTokens::take() {
  const PlacedToken taken = token_;
  comments_.clear();
  next_comment_ = 0;
  read_gap();
  return taken;
}

PlacedToken PlacedTokens::lift() {
  const PlacedToken taken = token_;
  const std::size_t before = comments_.size();
  read_gap();
  const bool has_more = comments_.size() > before;
  const std::uint32_t breaks = has_more ? comments_[before].breaks_before : token_.breaks_before;
  if (before > 0 && breaks > 0) comments_[before - 1].ends_line = true;
  return taken;
}

}  // namespace sdlc::lang
