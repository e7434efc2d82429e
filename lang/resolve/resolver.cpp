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
      unknown_(modules, module, {scopes_, functions_, kinds_}, sink) {}

void Resolver::resolve_declarations() {
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
  if (global.table != nullptr) {
    global.value = code_.add_constant(statement, ListValue(global.table));
    return;
  }
  scopes_.reset_frame_size();
  if (const auto type = statement.first(SyntaxKind::TypeName)) global.type = resolve_type(*type);
  const auto value = ast::expression_of(statement);
  record_rest(statement, value);
  declaring_ = global.name;
  if (value) global.value = expression(*value);
  declaring_ = {};
  global.frame_size = scopes_.frame_size();
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
    // Defaults are evaluated after the arguments of later parameters.
    scopes_.reserve(static_cast<std::uint32_t>(definition.parameters.size()));
    if (value) parameter.default_value = expression(*value);
    scopes_.reserve(0);
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

void Resolver::local_definition(ast::Node statement) {
  const bool is_function = statement.is(SyntaxKind::Fn);
  const NameSpace space = is_function ? NameSpace::Functions : NameSpace::Kinds;
  Scopes& names = is_function ? functions_ : kinds_;
  const std::string_view name = ast::declared_name(statement);
  const auto known = !name.empty() ? names.find(name) : std::nullopt;
  const bool is_duplicate = known && names.is_innermost(*known);
  if (is_duplicate) {
    sink_.report(diag::duplicate, statement.first(SyntaxKind::Name)->location(),
                 describe(*symbol_kind_of(statement.kind())), name);
  }
  if (is_recording() && !name.empty()) {
    recorder_->declare({.kind = *symbol_kind_of(statement.kind()),
                        .is_local = true,
                        .is_duplicate = is_duplicate,
                        .node = statement.index(),
                        .name = name,
                        .scope = {statement.span().begin, scope_end_},
                        .hides = is_duplicate ? kNothing : hidden_definition(space, name)});
  }
  Definition& definition = code_.code().definitions.emplace_back(read_definition(statement, sink_));
  definition.module = index_;
  definition.index = static_cast<std::uint32_t>(code_.code().definitions.size() - 1);
  definition.is_open = true;
  const std::uint32_t index = names.declare(name);
  auto& locals = is_function ? local_functions_ : local_kinds_;
  locals.resize(index);
  locals.push_back(&definition);
  Definition* const outer = std::exchange(definition_, &definition);
  {
    const Scopes::Frame frame(scopes_);
    definition.frame = scopes_.frame();
    resolve_definition(definition);
  }
  definition_ = outer;
  definition.is_open = false;
}

const Definition* Resolver::find_local(NameSpace space, std::string_view name) const {
  const bool is_function = space == NameSpace::Functions;
  const auto index = (is_function ? functions_ : kinds_).find(name);
  return index ? (is_function ? local_functions_ : local_kinds_)[*index] : nullptr;
}

void Resolver::use_outer(OuterLocal local) {
  constexpr std::size_t kMaxOuter = 64;  // with more, instances are not memoized
  if (definition_ == nullptr || local.frame >= definition_->frame) return;
  auto& known = definition_->outer;
  if (std::ranges::count(known, local) > 0) return;
  if (known.size() == kMaxOuter) {
    definition_->reads_more_outer = true;
  } else {
    known.push_back(local);
  }
}

void Resolver::use_definition(const Definition& used) {
  if (definition_ == nullptr || &used == definition_) return;
  if (used.is_open || used.reads_more_outer) definition_->reads_more_outer = true;
  for (const OuterLocal local : used.outer) use_outer(local);
}

std::array<std::uint32_t, 2> Resolver::local_callee(const Definition& definition) const {
  return {scopes_.frame() + 1 - definition.frame, definition.index};
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
  if (is_recording()) symbol.hides = hidden_by(symbol.name);
  const std::uint32_t index = scopes_.declare(symbol.name);
  if (is_recording()) recorder_->declare_local(symbol, index);
  return scopes_[index].slot;
}

}  // namespace sdlc::lang
