#include <algorithm>

#include "lang/syntax/scan.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

Span PieceReader::next_leaf(NodeIndex& node) {
  for (; node_ < tree_->nodes().size(); ++node_) {
    const SyntaxNode& candidate = (*tree_)[node_];
    const Span span = candidate.extent == 1
                          ? candidate.span()
                          : Span{candidate.begin, candidate.begin + candidate.head};
    if (span.size() > 0 && span.begin >= at_) {
      node = node_;
      return span;
    }
  }
  const auto end = static_cast<std::uint32_t>(tree_->file().text().size());
  return {end, end};
}

bool PieceReader::next(Piece& piece) {
  const std::string_view text = tree_->file().text();
  if (at_ >= text.size()) return false;

  NodeIndex node = 0;
  const Span leaf = next_leaf(node);
  const auto comments = tree_->comments();
  while (comment_ < comments.size() && comments[comment_].span.begin < at_) ++comment_;
  const auto take = [&](std::uint32_t end, PieceKind kind) {
    piece = {.span = {at_, end}, .kind = kind, .node = kind == PieceKind::Leaf ? node : 0};
    at_ = end;
    return true;
  };

  if (leaf.begin == at_ && leaf.size() > 0) {
    const bool is_error = (*tree_)[node].kind == SyntaxKind::Error;
    return take(leaf.end, is_error ? PieceKind::Skipped : PieceKind::Leaf);
  }
  if (comment_ < comments.size() && comments[comment_].span.begin == at_) {
    return take(comments[comment_].span.end, PieceKind::Comment);
  }

  std::uint32_t end = at_;
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (end < leaf.begin && is_blank(text[end])) ++end;
  if (end > at_) return take(end, PieceKind::Blank);
  end = end_of_identifier(text, at_);
  if (end > at_) return take(std::min(end, leaf.begin), PieceKind::Word);
  const bool is_mark =
      std::string_view("{}()[]:,=.+-*/^<>!").find(text[at_]) != std::string_view::npos;
  const bool is_byte_order_mark = at_ == 0 && text.starts_with("\xEF\xBB\xBF");
  if (is_byte_order_mark) return take(3, PieceKind::Blank);
  return take(at_ + 1, is_mark ? PieceKind::Punctuation : PieceKind::Skipped);
}

}  // namespace sdlc::lang
