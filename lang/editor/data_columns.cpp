#include "lang/editor/data_columns.hpp"

#include <optional>

#include "lang/ast/statements.hpp"

namespace sdlc::lang {

std::shared_ptr<const Table> table_of(const SceneView& view, SymbolId id) {
  const Symbol* symbol = view.index().find(id);
  if (symbol == nullptr || symbol->kind != SymbolKind::Import) return nullptr;
  const Module& module = view.module(id.file);
  const auto found = module.global_names.find(symbol->name);
  if (found == module.global_names.end()) return nullptr;
  const Global& global = module.globals[found->second];
  return global.node == symbol->node ? global.table : nullptr;
}

std::shared_ptr<const Table> table_of_row(const SceneView& view, SymbolId id) {
  const Symbol* symbol = view.index().find(id);
  if (symbol == nullptr) return nullptr;
  const ast::Node statement(view.tree(id.file), symbol->node);
  std::optional<ast::Node> list;
  if (symbol->kind == SymbolKind::LoopVariable) {
    const ast::Node loop(view.tree(id.file), symbol->owner);
    const ast::LoopNames names = ast::names_of_loop(loop);
    const bool is_element =
        !names.all.empty() && !names.takes_apart && names.all.back().index() == symbol->node;
    if (is_element) list = loop.child(1);
  } else if (symbol->kind == SymbolKind::Let) {
    const auto value = ast::expression_of(statement);
    const auto index = value && value->is(SyntaxKind::Postfix) ? value->child(1) : std::nullopt;
    if (index && index->is(SyntaxKind::Index) && !value->child(2)) list = value->child(0);
  }
  if (!list || !list->is(SyntaxKind::Reference)) return nullptr;
  const Occurrence* name = view.table(id.file).at(list->span().end);
  return name == nullptr ? nullptr : table_of(view, name->symbol);
}

}  // namespace sdlc::lang
