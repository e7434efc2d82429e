#include "lang/resolve/declarations.hpp"

#include <optional>
#include <string_view>
#include <unordered_map>

#include "lang/ast/statements.hpp"

namespace sdlc::lang {
namespace {

template <typename Map>
const typename Map::mapped_type* find(const Map& map, std::string_view name) {
  const auto found = map.find(name);
  return found == map.end() ? nullptr : &found->second;
}

/// The statement that declares the name in the name space of this kind of statement, if any.
std::optional<NodeIndex> declaration_of(const Module& module, SyntaxKind kind,
                                        std::string_view name) {
  switch (kind) {
    case SyntaxKind::Let:
    case SyntaxKind::Param:
    case SyntaxKind::Import:
      if (const Import* import = find(module.imports, name)) return import->node;
      if (const auto* i = find(module.global_names, name)) return module.globals[*i].node;
      return std::nullopt;
    case SyntaxKind::Fn:
      if (const auto* i = find(module.function_names, name)) return module.functions[*i].node;
      return std::nullopt;
    case SyntaxKind::Def:
      if (const auto* i = find(module.def_names, name)) return module.defs[*i].node;
      return std::nullopt;
    default: return std::nullopt;
  }
}

/// The word of messages about duplicates.
std::string_view describe_declaration(SyntaxKind kind) {
  return kind == SyntaxKind::Fn ? "function" : kind == SyntaxKind::Def ? "kind" : "value";
}

bool is_declaration(SyntaxKind kind) {
  return kind == SyntaxKind::Let || kind == SyntaxKind::Param || kind == SyntaxKind::Import ||
         kind == SyntaxKind::Fn || kind == SyntaxKind::Def;
}

void collect(Modules& modules, std::uint32_t index, ast::Node statement, ast::Node name,
             DiagnosticSink& sink) {
  Module& module = modules.module_at(index);
  const auto number = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
  switch (statement.kind()) {
    case SyntaxKind::Import: {
      const auto file = statement.first(SyntaxKind::String);
      if (!file) return;
      const std::uint32_t loaded = modules.load(index, *file, false, sink);
      module.imports.emplace(name.text(), Import{.module = loaded, .node = statement.index()});
      return;
    }
    case SyntaxKind::Fn:
      module.function_names.emplace(name.text(), number(module.functions));
      module.functions.push_back(read_definition(statement, sink));
      return;
    case SyntaxKind::Def:
      module.def_names.emplace(name.text(), number(module.defs));
      module.defs.push_back(read_definition(statement, sink));
      return;
    default:
      module.global_names.emplace(name.text(), number(module.globals));
      module.globals.push_back({.name = name.text(),
                                .node = statement.index(),
                                .is_param = statement.is(SyntaxKind::Param)});
      return;
  }
}

/// Whether something is wrong between the name and the end of the parameters.
bool has_broken_parameters(ast::Node statement) {
  std::uint32_t end = statement.span().begin;
  std::optional<Span> error;
  for (const ast::Node child : statement.children()) {
    if (child.is(SyntaxKind::Name) || child.is(SyntaxKind::Parameter)) {
      if (child.is_broken()) return true;
      end = child.span().end;
    } else if (error) {
      return true;  // the body follows the error, which is among the parameters
    } else if (child.is(SyntaxKind::Error)) {
      error = child.span();
    }
  }
  if (!error) return false;
  return statement.tree().text({end, error->begin}).find(')') == std::string_view::npos;
}

}  // namespace

void collect_declarations(Modules& modules, std::uint32_t index, DiagnosticSink& sink) {
  const Module& module = modules.module_at(index);
  for (const ast::Node statement : ast::Node(module.tree, 0).children()) {
    sink.stop_if_requested();
    const auto name = statement.first(SyntaxKind::Name);
    if (!is_declaration(statement.kind()) || !name || name->span().size() == 0) continue;
    const auto first = declaration_of(module, statement.kind(), name->text());
    if (!first) {
      collect(modules, index, statement, *name, sink);
      continue;
    }
    const auto first_name = ast::Node(module.tree, *first).first(SyntaxKind::Name);
    sink.report(diag::duplicate, name->location(), describe_declaration(statement.kind()),
                name->text())
        .label(first_name->location(), "first declared here");
  }
}

Definition read_definition(ast::Node statement, DiagnosticSink& sink) {
  Definition definition;
  definition.name = ast::declared_name(statement);
  definition.node = statement.index();
  definition.is_broken = has_broken_parameters(statement);
  std::unordered_map<std::string_view, Location> declared;
  for (const ast::Node child : statement.children()) {
    if (!child.is(SyntaxKind::Parameter)) continue;
    const auto [same, is_new] = declared.try_emplace(child.head(), child.head_location());
    if (!is_new) {
      sink.report(diag::duplicate, child.head_location(), "parameter", child.head())
          .label(same->second, "first declared here");
      continue;
    }
    const bool is_placement =
        child.head() == "translate" || child.head() == "rotate" || child.head() == "scale";
    if (statement.is(SyntaxKind::Def) && is_placement) {
      sink.report(diag::placement_parameter, child.head_location(), child.head());
    }
    definition.parameters.push_back({.name = child.head(),
                                     .node = child.index(),
                                     .has_default = ast::expression_of(child).has_value()});
  }
  return definition;
}

bool is_collected(const Module& module, ast::Node statement) {
  return declaration_of(module, statement.kind(), ast::declared_name(statement)) ==
         statement.index();
}

}  // namespace sdlc::lang
