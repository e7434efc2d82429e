#pragma once

#include <optional>
#include <string_view>

#include "lang/ast/ast.hpp"

/// What several phases ask of statements.
namespace sdlc::lang::ast {

/// The word that a statement other than a property or object begins with.
inline std::string_view statement_word(SyntaxKind kind) noexcept {
  switch (kind) {
    case SyntaxKind::Import: return "import";
    case SyntaxKind::Include: return "include";
    case SyntaxKind::Param: return "param";
    case SyntaxKind::Let: return "let";
    case SyntaxKind::Fn: return "fn";
    case SyntaxKind::Def: return "def";
    case SyntaxKind::Assert: return "assert";
    case SyntaxKind::For: return "for";
    case SyntaxKind::If: return "if";
    default: return "";
  }
}

/// Where that word stands.
inline Location word_location(Node statement) {
  const auto size = static_cast<std::uint32_t>(statement_word(statement.kind()).size());
  return statement.tree().location({statement.span().begin, statement.span().begin + size});
}

/// The name that a declaration or a `for` gives; empty where it could not be read.
inline std::string_view declared_name(Node statement) {
  const auto name = statement.first(SyntaxKind::Name);
  return name ? name->text() : std::string_view();
}

/// Where the inside of a block or an object ends: at its closing brace, if it has one.
inline std::uint32_t end_of_inside(Node node) {
  return node.span().end - (node.text().ends_with('}') ? 1 : 0);
}

/// The expression of a let, param, fn or parameter.
inline std::optional<Node> expression_of(Node node) {
  std::optional<Node> found;
  for (const Node child : node.children()) {
    const bool is_other = child.is(SyntaxKind::Name) || child.is(SyntaxKind::TypeName) ||
                          child.is(SyntaxKind::Parameter);
    if (!is_other) found = child;
  }
  return found;
}

}  // namespace sdlc::lang::ast
