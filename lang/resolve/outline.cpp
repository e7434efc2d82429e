#include "lang/resolve/outline.hpp"

#include "lang/ast/ast.hpp"
#include "lang/resolve/declarations.hpp"

namespace sdlc::lang {
namespace {

void add_items(std::vector<OutlineItem>& items, ast::Node parent, std::uint32_t depth) {
  for (const ast::Node node : parent.children()) {
    const auto kind = symbol_kind_of(node.kind());
    const auto name = node.first(SyntaxKind::Name);
    const bool is_object = node.is(SyntaxKind::Object);
    const bool is_item = kind && (name || is_object);
    if (is_item) {
      items.push_back({.kind = *kind,
                       .name = name ? name->text() : node.head(),
                       .object_kind = is_object ? node.head() : std::string_view(),
                       .whole = node.span(),
                       .where = name ? name->span() : node.head_span(),
                       .depth = depth});
    }
    const bool contains_statements = is_object || node.is(SyntaxKind::Def) ||
                                     node.is(SyntaxKind::For) || node.is(SyntaxKind::If) ||
                                     node.is(SyntaxKind::Block) || node.is(SyntaxKind::Error);
    if (contains_statements) add_items(items, node, depth + (is_item ? 1 : 0));
  }
}

}  // namespace

std::vector<OutlineItem> outline_of(const SyntaxTree& tree) {
  std::vector<OutlineItem> items;
  add_items(items, ast::Node(tree, 0), 0);
  return items;
}

}  // namespace sdlc::lang
