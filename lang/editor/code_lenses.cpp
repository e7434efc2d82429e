#include "lang/editor/code_lenses.hpp"

#include <optional>

#include "lang/ast/ast.hpp"
#include "lang/schema/find_kind.hpp"

namespace sdlc::lang {
namespace {

/// Whether the file defines a kind of this name, which hides the built-in one.
const Kind* builtin_kind(const Module& module, ast::Object object) {
  return module.def_names.contains(object.kind()) ? nullptr : find_kind(object.kind());
}

bool is_picture(const Module& module, ast::Node statement) {
  switch (statement.kind()) {
    case SyntaxKind::For:
    case SyntaxKind::If:
    case SyntaxKind::Include: return true;
    case SyntaxKind::Object: {
      const Kind* kind = builtin_kind(module, {statement});
      return kind == nullptr || !kind->is_setting || kind->id == ObjectKind::Camera;
    }
    default: return false;
  }
}

Span first_word(ast::Node statement) {
  const Span span = statement.span();
  return statement.is(SyntaxKind::Object) ? statement.head_span() : Span{span.begin, span.begin};
}

}  // namespace

std::vector<RenderLens> render_lenses(const SceneView& view, std::uint32_t file) {
  const Module& module = view.module(file);
  std::vector<RenderLens> lenses;
  std::optional<Span> first;
  for (const ast::Node statement : ast::Node(module.tree, 0).children()) {
    if (!first && is_picture(module, statement)) first = first_word(statement);
    if (!statement.is(SyntaxKind::Object)) continue;
    const ast::Object object{statement};
    const Kind* kind = builtin_kind(module, object);
    const auto name = object.name();
    const bool is_named = name && name->span().size() > 0;
    if (kind == nullptr || kind->id != ObjectKind::Camera || !is_named) continue;
    lenses.push_back({{statement.span().begin, name->span().end}, std::string(name->text())});
  }
  if (lenses.empty() && first) lenses.push_back({*first, {}});
  return lenses;
}

}  // namespace sdlc::lang
