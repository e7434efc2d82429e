#include "lang/editor/selection_ranges.hpp"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <utility>

#include "lang/ast/ast.hpp"
#include "lang/editor/bracket_pairs.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

bool encloses(Span outer, Span inner) {
  return outer.begin <= inner.begin && inner.end <= outer.end;
}

bool is_white(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

Span without_space_around(std::string_view text, Span span) {
  while (span.begin < span.end && is_white(text[span.begin])) ++span.begin;
  while (span.end > span.begin && is_white(text[span.end - 1])) --span.end;
  return span;
}

/// How well a token serves as the word at a cursor that touches it.
int rank_of_word(TokenKind kind) {
  if (is_name(kind)) return 3;
  const bool is_literal = kind == TokenKind::Number || kind == TokenKind::Color || is_string(kind);
  if (is_literal) return 2;
  return is_trivia(kind) && !is_comment(kind) ? 0 : 1;
}

/// The tokens at the offsets, which ascend: of two that touch at an offset the one that is more of
/// a word. Empty tokens where there is only space.
std::vector<Token> tokens_at(const SourceFile& file, std::span<const std::uint32_t> offsets) {
  std::vector<Token> found(offsets.size());
  std::size_t first = 0;  // offsets before it are done
  TokenReader tokens(file.text(), 0, file.format());
  for (Token token = tokens.next(); token.kind != TokenKind::End && first < offsets.size();
       token = tokens.next()) {
    while (first < offsets.size() && offsets[first] < token.span.begin) ++first;
    const int rank = rank_of_word(token.kind);
    for (std::size_t i = first; i < offsets.size() && offsets[i] <= token.span.end; ++i) {
      if (rank > rank_of_word(found[i].kind) || (rank > 0 && found[i].kind == TokenKind::End)) {
        found[i] = token;
      }
    }
  }
  return found;
}

/// The text around the offset up to spaces.
Span word_in_comment(std::string_view text, Span comment, std::uint32_t offset) {
  Span word{offset, offset};
  while (word.begin > comment.begin && !is_white(text[word.begin - 1])) --word.begin;
  while (word.end < comment.end && !is_white(text[word.end])) ++word.end;
  return word;
}

void add_token(std::vector<Span>& spans, std::string_view text, const Token& token,
               std::uint32_t offset) {
  if (token.kind == TokenKind::End) return;
  if (is_comment(token.kind)) spans.push_back(word_in_comment(text, token.span, offset));
  const bool is_quoted = token.kind == TokenKind::String && token.span.size() >= 2;
  if (is_quoted && offset > token.span.begin && offset < token.span.end) {
    spans.push_back({token.span.begin + 1, token.span.end - 1});
  }
  spans.push_back(token.span);
}

/// A cursor, and the spans around it that have been found.
struct SelectionCursor {
  std::uint32_t offset = 0;
  Token token;  ///< of the kind End where there is only space
  std::vector<Span> spans = {};

  Span anchor() const noexcept {
    return token.kind == TokenKind::End ? Span{offset, offset} : token.span;
  }
};

/// Adds the nodes around each cursor. All cursors go down the tree together, so that the children
/// of a node are visited once. `cursors`: those in the node, by their anchors.
void add_nodes(std::span<SelectionCursor> cursors, ast::Node node) {
  for (SelectionCursor& cursor : cursors) {
    cursor.spans.push_back(node.span());
    cursor.spans.push_back(node.head_span());
  }
  const auto begin_of = [](const SelectionCursor& cursor) { return cursor.anchor().begin; };
  for (const ast::Node child : node.children()) {
    if (cursors.empty()) return;
    const auto first = std::ranges::lower_bound(cursors, child.span().begin, {}, begin_of);
    const auto last = std::ranges::lower_bound(cursors, child.span().end, {}, begin_of);
    if (first < last) add_nodes({first, last}, child);
    cursors = {std::max(first, last), cursors.end()};
  }
}

void add_brackets(std::vector<Span>& spans, std::string_view text,
                  const std::vector<BracketPair>& pairs, Span anchor) {
  for (std::uint32_t i = innermost_pair(pairs, anchor); i != BracketPair::kNone;
       i = pairs[i].parent) {
    if (!pairs[i].is_closed()) continue;
    spans.push_back(without_space_around(text, pairs[i].inside()));
    spans.push_back(pairs[i].outside());
  }
}

/// The chain of those that contain the anchor, each in the next one.
std::vector<Span> nested(std::vector<Span> spans, Span anchor) {
  std::ranges::sort(spans, {}, &Span::size);
  std::vector<Span> chain;
  for (const Span span : spans) {
    const Span last = chain.empty() ? anchor : chain.back();
    const bool grows = span.size() > (chain.empty() ? 0 : last.size());
    if (grows && encloses(span, last)) chain.push_back(span);
  }
  return chain;
}

}  // namespace

std::vector<std::vector<Span>> selection_ranges(const SourceFile& file, const SyntaxTree* tree,
                                                std::span<const std::uint32_t> offsets) {
  const std::string_view text = file.text();
  const auto size = static_cast<std::uint32_t>(text.size());
  std::vector<std::size_t> order(offsets.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [&](std::size_t i) { return offsets[i]; });
  std::vector<std::uint32_t> ascending;
  for (const std::size_t i : order) ascending.push_back(std::min(offsets[i], size));

  const std::vector<Token> tokens = tokens_at(file, ascending);
  std::vector<SelectionCursor> cursors;
  for (std::size_t i = 0; i < order.size(); ++i) {
    cursors.push_back({.offset = ascending[i], .token = tokens[i]});
  }
  if (tree != nullptr) add_nodes(cursors, ast::Node(*tree, 0));
  const std::vector<BracketPair> pairs = bracket_pairs(text, file.format());
  std::vector<std::vector<Span>> ranges(offsets.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    SelectionCursor& cursor = cursors[i];
    cursor.spans.push_back({0, size});
    add_token(cursor.spans, text, cursor.token, cursor.offset);
    add_brackets(cursor.spans, text, pairs, cursor.anchor());
    ranges[order[i]] = nested(std::move(cursor.spans), {cursor.offset, cursor.offset});
  }
  return ranges;
}

}  // namespace sdlc::lang
