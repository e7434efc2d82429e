#include "lang/editor/bracket_pairs.hpp"

#include <algorithm>

#include "lang/text/brackets.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

/// The pairs that are open at a place.
class OpenPairs {
 public:
  explicit OpenPairs(std::string_view text) : text_(text) {}

  void open(std::uint32_t at) {
    pairs_.push_back({.open = at, .parent = innermost_});
    innermost_ = static_cast<std::uint32_t>(pairs_.size() - 1);
  }

  /// `line`: where the line of the bracket begins.
  void close(std::uint32_t at, std::uint32_t line) {
    std::uint32_t found = innermost_;
    while (found != BracketPair::kNone && !is_bracket_pair(text_[pairs_[found].open], text_[at])) {
      found = pairs_[found].parent;
    }
    if (found == BracketPair::kNone) return;
    pairs_[found].close = at;
    pairs_[found].spans_lines = line > pairs_[found].open;
    innermost_ = pairs_[found].parent;
  }

  std::vector<BracketPair> take() { return std::move(pairs_); }

 private:
  std::string_view text_;
  std::vector<BracketPair> pairs_;
  std::uint32_t innermost_ = BracketPair::kNone;
};

}  // namespace

std::vector<BracketPair> bracket_pairs(std::string_view text, SourceFormat format) {
  OpenPairs pairs(text);
  TokenReader tokens(text, 0, format);
  std::uint32_t line = 0;
  for (Token token = tokens.next(); token.kind != TokenKind::End; token = tokens.next()) {
    const bool ends_line = token.kind == TokenKind::LineEnd ||
                           (token.kind == TokenKind::BlockComment &&
                            tokens.text(token).find('\n') != std::string_view::npos);
    if (ends_line) line = token.span.end;
    if (token.kind == TokenKind::Open) pairs.open(token.span.begin);
    if (token.kind == TokenKind::Close) pairs.close(token.span.begin, line);
  }
  return pairs.take();
}

std::uint32_t innermost_pair(const std::vector<BracketPair>& pairs, Span span) noexcept {
  const auto after = std::ranges::upper_bound(pairs, span.begin, {}, &BracketPair::open);
  if (after == pairs.begin()) return BracketPair::kNone;
  auto found = static_cast<std::uint32_t>(after - pairs.begin() - 1);
  while (found != BracketPair::kNone &&
         (!pairs[found].is_closed() || pairs[found].outside().end < span.end)) {
    found = pairs[found].parent;
  }
  return found;
}

}  // namespace sdlc::lang
