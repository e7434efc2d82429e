#include "lang/resolve/resolver.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/ast/statements.hpp"
#include "lang/resolve/lookup.hpp"

namespace sdlc::lang {

Resolver::Resolver(Modules& modules, std::uint32_t module, DiagnosticSink& sink,
                   SymbolRecorder* recorder)
    : modules_(modules),
      index_(module),
      module_(modules.module_at(module)),
      sink_(sink),
      recorder_(recorder),
      code_(module_.code),
      unknown_(modules, module, scopes_, sink) {}

void Resolver::resolve_declarations() {
  collect_declarations(modules_, index_, sink_);
  std::vector<Uses> of_globals, of_functions;
  for (Global& global : module_.globals) {
    resolve_global(global);
    of_globals.push_back(std::move(uses_));
  }
  for (Definition& function : module_.functions) {
    resolve_definition(function);
    of_functions.push_back(std::move(uses_));
  }
  for (Definition& def : module_.defs) resolve_definition(def);
  order_globals(module_, of_globals, of_functions, sink_);
}

void Resolver::resolve_global(Global& global) {
  const ast::Node statement(module_.tree, global.node);
  uses_ = {};
  scopes_.reset_frame_size();
  if (const auto type = statement.first(SyntaxKind::TypeName)) global.type = resolve_type(*type);
  const auto value = ast::expression_of(statement);
  record_rest(statement, value);
  declaring_ = global.name;
  if (value) global.value = expression(*value);
  declaring_ = {};
}

namespace {

/// Parameters are visible up to the next statement: the body may still be missing.
std::uint32_t end_of_definition(ast::Node statement) {
  const SyntaxTree& tree = statement.tree();
  const NodeIndex next = statement.index() + tree[statement.index()].extent;
  if (next == tree.nodes().size()) return static_cast<std::uint32_t>(tree.file().text().size());
  return std::max(statement.span().end, tree[next].begin - 1);
}

}  // namespace

void Resolver::resolve_definition(Definition& definition) {
  const ast::Node statement(module_.tree, definition.node);
  uses_ = {};
  scopes_.reset_frame_size();
  const Block scope(*this, end_of_definition(statement));
  for (Parameter& parameter : definition.parameters) {
    const ast::Node node(module_.tree, parameter.node);
    if (const auto type = node.first(SyntaxKind::TypeName)) parameter.type = resolve_type(*type);
    const auto value = ast::expression_of(node);
    if (value) parameter.default_value = expression(*value);
    record_rest(node, value);
    declare_local({.kind = SymbolKind::Parameter,
                   .node = node.index(),
                   .owner = definition.node,
                   .name = parameter.name,
                   .scope = {node.span().end, scope_end_}});
  }
  if (is_recording()) record_duplicate_parameters(definition);
  if (statement.is(SyntaxKind::Fn)) {
    const auto body = ast::expression_of(statement);
    record_rest(statement, body);
    if (body) definition.body = expression(*body);
  } else if (const auto body = statement.first(SyntaxKind::Block)) {
    const std::size_t mark = code_.mark();
    block(*body);
    code_.remove(mark, mark + 1);  // the number of statements
    definition.block = code_.take(mark);
  }
  if (statement.is(SyntaxKind::Def)) record_rest(statement, std::nullopt);
  definition.frame_size = scopes_.frame_size();
}

const TypeInfo* Resolver::resolve_type(ast::Node node) {
  const TypeInfo* type = find_type(node.text());
  if (is_recording()) {
    if (type == nullptr) recorder_->use_unknown(node.text(), NameSpace::Types);
    if (type != nullptr) recorder_->use_builtin(node.text(), SymbolKind::Type);
  }
  if (type != nullptr) return type;
  const std::vector<std::string_view> names = names_of(all_types());
  sink_.report(diag::unknown_type, node.location(), node.text())
      .suggest(intended_name(find_habit(HabitPlace::Type, node.text()), node.text(), names))
      .help(fmt::format("types are {}", fmt::join(names, ", ")));
  return nullptr;
}

std::optional<Declaration> Resolver::imported_declaration(const Import& import, NameSpace space,
                                                          std::span<const std::string_view> names) {
  std::optional<Declaration> found;
  const bool is_whole = names.size() == 2 || (space == NameSpace::Values && names.size() > 2);
  if (is_whole && import.module != kNothing) {
    found = find_declaration(modules_.module_at(import.module), space, names[1]);
  }
  if (is_recording()) {
    recorder_->use_own(names[0], import.node);
    if (found) {
      recorder_->use(names[1], {import.module, found->node});
    } else if (names.size() > 1) {
      recorder_->use_unknown(names[1], NameSpace::Members);
    }
  }
  return found;
}

std::uint32_t Resolver::declare_local(Symbol symbol) {
  if (!is_recording()) return scopes_.declare(symbol.name);
  symbol.hides = hidden_by(symbol.name);
  const std::uint32_t slot = scopes_.declare(symbol.name);
  recorder_->declare_local(symbol, slot);
  return slot;
}

}  // namespace sdlc::lang
