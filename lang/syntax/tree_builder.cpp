#include "lang/syntax/tree_builder.hpp"

#include <utility>

namespace sdlc::lang {

void TreeBuilder::wrap(NodeIndex first, SyntaxKind kind) {
  nodes_.insert(first, {.begin = nodes_[first].begin, .kind = kind});
  close(first);
}

void OpenChain::break_off() {
  const bool is_error =
      builder_->is_one_node(first_) && builder_->node(first_).kind == SyntaxKind::Error;
  if (!is_error && first_ < builder_->size()) builder_->wrap(first_, SyntaxKind::Error);
}

void TreeBuilder::add_comment(Span span) {
  // After backtracking the parser reads a comment again.
  if (!comments_.empty() && span.begin < comments_.back().span.end) return;
  const std::string_view comment = text_.substr(span.begin, span.size());
  const bool is_doc = comment.starts_with("///") && !comment.starts_with("////");
  const CommentKind kind = comment.starts_with("/*") ? CommentKind::Block
                           : is_doc                  ? CommentKind::Doc
                                                     : CommentKind::Line;
  comments_.push_back({span, kind});
}

void TreeBuilder::mark_error(std::uint32_t at) {
  // After backtracking the last token may be further on.
  if (space_end_ != at && token_end_ != at) {
    const std::size_t last = text_.find_last_not_of(" \t\r\n", at == 0 ? 0 : at - 1);
    token_end_ =
        at == 0 || last == std::string_view::npos ? 0 : static_cast<std::uint32_t>(last + 1);
  }
  error_at_ = at;
  push(SyntaxKind::Error, {token_end_, token_end_});
}

void TreeBuilder::poison_last_name() {
  // The Error that marks the place follows it.
  if (nodes_.size() < 2) return;
  SyntaxNode& last = nodes_[nodes_.size() - 2];
  if (last.kind == SyntaxKind::Reference) last.kind = SyntaxKind::Error;
}

void TreeBuilder::poison_last_part(NodeIndex statement) {
  if (statement >= nodes_.size()) return;
  NodeIndex part = kNone, mark = kNone;
  const NodeIndex end = statement + nodes_[statement].extent;
  for (NodeIndex child = statement + 1; child < end; child += nodes_[child].extent) {
    part = std::exchange(mark, child);
  }
  if (part == kNone || nodes_[mark].kind != SyntaxKind::Error) return;
  const bool is_value = nodes_[part].kind > SyntaxKind::Block;
  if (is_value && nodes_[mark].begin == nodes_[part].end) nodes_[part].kind = SyntaxKind::Error;
}

void TreeBuilder::poison_since(std::uint32_t begin) {
  for (NodeIndex i = size(); i > 0 && nodes_[i - 1].begin >= begin; --i) {
    nodes_[i - 1].kind = SyntaxKind::Error;
    nodes_[i - 1].head = 0;
  }
}

void TreeBuilder::poison_last_statement() {
  if (last_statement_ == kNone || last_statement_ >= nodes_.size()) return;
  const NodeIndex end = last_statement_ + nodes_[last_statement_].extent;
  NodeIndex last = kNone;
  for (NodeIndex child = last_statement_ + 1; child < end; child += nodes_[child].extent) {
    last = child;
  }
  if (last != kNone) nodes_[last].kind = SyntaxKind::Error;
}

}  // namespace sdlc::lang
