#include "lang/resolve/declarations.hpp"

#include <optional>
#include <string_view>
#include <unordered_map>

#include "lang/ast/statements.hpp"
#include "lang/resolve/lookup.hpp"

namespace sdlc::lang {
namespace {

/// What messages about duplicates call it.
std::string_view describe_declaration(SyntaxKind kind) {
  return kind == SyntaxKind::Fn ? "function" : kind == SyntaxKind::Def ? "kind" : "value";
}

/// The first statement that declares the name in the name space of this kind of symbol, if any.
std::optional<NodeIndex> first_declaration(const Module& module, SymbolKind kind,
                                           std::string_view name) {
  const NameSpace space = name_space_of(kind);
  if (space == NameSpace::Values) {
    if (const Import* import = find_in(module.imports, name)) return import->node;
  }
  const auto found = find_declaration(module, space, name);
  return found ? std::optional(found->node) : std::nullopt;
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
      if (loaded >= kTables && loaded != kNothing) {
        module.global_names.emplace(name.text(), number(module.globals));
        module.globals.push_back(
            {.name = name.text(), .node = statement.index(), .table = modules.table_at(loaded)});
        return;
      }
      module.imports.emplace(name.text(), Import{.module = loaded, .node = statement.index()});
      return;
    }
    case SyntaxKind::Fn:
      module.function_names.emplace(name.text(), number(module.functions));
      module.functions.push_back(read_definition(statement, sink));
      module.functions.back().module = index;
      return;
    case SyntaxKind::Def:
      module.def_names.emplace(name.text(), number(module.defs));
      module.defs.push_back(read_definition(statement, sink));
      module.defs.back().module = index;
      return;
    default:
      module.global_names.emplace(name.text(), number(module.globals));
      module.globals.push_back({.name = name.text(),
                                .node = statement.index(),
                                .is_param = statement.is(SyntaxKind::Param)});
      return;
  }
}

/// Whether there is an error between the name and the end of the parameters.
bool has_broken_parameters(ast::Node statement) {
  std::uint32_t end = statement.span().begin;
  std::optional<Span> error;
  for (const ast::Node child : statement.children()) {
    if (child.is(SyntaxKind::Name) || child.is(SyntaxKind::Parameter)) {
      if (child.is_broken()) return true;
      end = child.span().end;
    } else if (error) {
      return true;  // the body follows the error, so this is among the parameters
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
    const auto kind = symbol_kind_of(statement.kind());
    if (!kind || kind == SymbolKind::Object || !name || name->span().size() == 0) continue;
    const auto first = first_declaration(module, *kind, name->text());
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
  const auto kind = symbol_kind_of(statement.kind());
  return kind &&
         first_declaration(module, *kind, ast::declared_name(statement)) == statement.index();
}

std::optional<Declaration> find_declaration(const Module& module, NameSpace space,
                                            std::string_view name) {
  const auto find = [&](const auto& names, const auto& list) -> std::optional<Declaration> {
    const std::uint32_t* index = find_in(names, name);
    if (index == nullptr) return std::nullopt;
    return Declaration{.index = *index, .node = list[*index].node};
  };
  switch (space) {
    case NameSpace::Functions: return find(module.function_names, module.functions);
    case NameSpace::Kinds: return find(module.def_names, module.defs);
    default: return find(module.global_names, module.globals);
  }
}

std::optional<SymbolKind> symbol_kind_of(SyntaxKind statement) noexcept {
  switch (statement) {
    case SyntaxKind::Let: return SymbolKind::Let;
    case SyntaxKind::Param: return SymbolKind::Param;
    case SyntaxKind::Import: return SymbolKind::Import;
    case SyntaxKind::Fn: return SymbolKind::Fn;
    case SyntaxKind::Def: return SymbolKind::Def;
    case SyntaxKind::Object: return SymbolKind::Object;
    default: return std::nullopt;
  }
}

}  // namespace sdlc::lang
