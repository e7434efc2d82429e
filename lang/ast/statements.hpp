#pragma once

#include <optional>
#include <string_view>
#include <vector>

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

/// The name that a declaration declares; empty if it could not be read.
inline std::string_view declared_name(Node statement) {
  const auto name = statement.first(SyntaxKind::Name);
  return name ? name->text() : std::string_view();
}

/// The names that a For or ForClause declares, in the order of the text.
struct LoopNames {
  std::vector<Node> all;
  bool has_index = false;    ///< the first is the index
  bool takes_apart = false;  ///< the others are the parts of the element

  std::size_t part_count() const noexcept { return takes_apart ? all.size() - has_index : 0; }
};

inline LoopNames names_of_loop(Node loop) {
  LoopNames names;
  const auto pattern = loop.first(SyntaxKind::Pattern);
  if (!pattern) return names;
  for (const Node part : pattern->children()) {
    names.takes_apart = part.is(SyntaxKind::RowPattern);
    names.has_index = !names.all.empty();
    if (part.is(SyntaxKind::Name)) names.all.push_back(part);
    if (!names.takes_apart) continue;
    for (const Node name : part.children()) {
      if (name.is(SyntaxKind::Name)) names.all.push_back(name);
    }
  }
  return names;
}

/// The end of the inside of a block or object: its closing brace, or the end of the node.
inline std::uint32_t end_of_inside(Node node) {
  return node.span().end - (node.text().ends_with('}') ? 1 : 0);
}

/// The expression of a let, binding, param, fn or parameter.
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
