#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/resolve/module.hpp"
#include "lang/resolve/symbol.hpp"

namespace sdlc::lang {

/// Collects the names of a file's top level into its Module, and loads its imports. Expressions are
/// resolved later, since the order of declarations does not matter.
void collect_declarations(Modules& modules, std::uint32_t module, DiagnosticSink& sink);

/// The name and the parameters of a fn or def, without types and defaults. Reports duplicates.
Definition read_definition(ast::Node statement, DiagnosticSink& sink);

/// Whether the Module has this statement for its name; false for duplicates.
bool is_collected(const Module& module, ast::Node statement);

struct Declaration {
  std::uint32_t index;  ///< in Module::globals, functions or defs
  NodeIndex node;       ///< the statement
};
/// The value, function or kind with this name at the top level, except imports. `space`: Values,
/// Functions or Kinds.
std::optional<Declaration> find_declaration(const Module& module, NameSpace space,
                                            std::string_view name);

/// The kind of the symbol that a statement declares; nullopt for other statements.
std::optional<SymbolKind> symbol_kind_of(SyntaxKind statement) noexcept;

}  // namespace sdlc::lang
