#pragma once

#include <optional>
#include <string_view>

#include "lang/ast/ast.hpp"

/// Properties of statements that several phases use.
namespace sdlc::lang::ast {

/// Properties and objects are statements, too.
inline bool is_statement(SyntaxKind kind) noexcept {
  return kind >= SyntaxKind::Property && kind <= SyntaxKind::Object;
}

/// The keyword of a statement; empty for properties and objects.
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

/// The place of the keyword.
inline Location word_location(Node statement) {
  const auto size = static_cast<std::uint32_t>(statement_word(statement.kind()).size());
  return statement.tree().location({statement.span().begin, statement.span().begin + size});
}

/// The name that a declaration or `for` declares; empty if it could not be read.
inline std::string_view declared_name(Node statement) {
  const auto name = statement.first(SyntaxKind::Name);
  return name ? name->text() : std::string_view();
}

/// The end of the inside of a block or object: its closing brace, or the end of the node.
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
