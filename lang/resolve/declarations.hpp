#pragma once

#include <cstdint>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/resolve/module.hpp"

namespace sdlc::lang {

/// Collects the names of a file's top level into its Module, and loads what it imports. Nothing is
/// resolved yet: the order of declarations does not matter (ruling 9).
void collect_declarations(Modules& modules, std::uint32_t module, DiagnosticSink& sink);

/// The name and the parameters of a fn or def.
Definition read_definition(ast::Node statement, DiagnosticSink& sink);

/// Whether the statement is the one that the Module has for its name, and not a duplicate.
bool is_collected(const Module& module, ast::Node statement);

}  // namespace sdlc::lang
