#include "lang/editor/callee.hpp"

#include <algorithm>
#include <unordered_map>

#include "lang/ast/ast.hpp"
#include "lang/ast/statements.hpp"
#include "lang/resolve/symbol_types.hpp"
#include "lang/schema/find_kind.hpp"

namespace sdlc::lang {
namespace {

using NameMap = std::unordered_map<std::string_view, std::uint32_t>;

/// The definition of a name in a file.
SymbolId find_definition(const SceneView& view, std::uint32_t file, std::string_view name,
                         const NameMap Module::*names,
                         const std::vector<Definition> Module::*definitions) {
  const Module& module = view.module(file);
  const auto found = (module.*names).find(name);
  if (found == (module.*names).end()) return {};
  return {file, (module.*definitions)[found->second].node};
}

/// The same for a path: a member of an import if it has a dot.
SymbolId find_path(const SceneView& view, std::uint32_t file, std::string_view path,
                   const NameMap Module::*names,
                   const std::vector<Definition> Module::*definitions) {
  const std::size_t dot = path.find('.');
  if (dot == std::string_view::npos) {
    return find_definition(view, file, path, names, definitions);
  }
  const auto& imports = view.module(file).imports;
  const auto found = imports.find(path.substr(0, dot));
  if (found == imports.end() || found->second.module >= view.file_count()) return {};
  return find_definition(view, found->second.module, path.substr(dot + 1), names, definitions);
}

}  // namespace

Callee find_callee(const SceneView& view, std::uint32_t file, std::string_view path) {
  Callee callee;
  callee.function = find_path(view, file, path, &Module::function_names, &Module::functions);
  if (callee.is_known()) return callee;
  callee.builtin = find_builtin(path);
  callee.constructor = find_constructor(path);
  return callee;
}

BlockKind find_block_kind(const SceneView& view, std::uint32_t file, std::string_view path) {
  const SymbolId def = find_path(view, file, path, &Module::def_names, &Module::defs);
  if (def.is_known()) return {.def = def};
  return {.kind = find_kind(path)};
}

std::vector<BlockProperty> properties_of(const SceneView& view, const BlockKind& kind) {
  std::vector<BlockProperty> all;
  for (const SymbolId parameter : parameters_of(view, kind.def)) {
    all.push_back({.name = view.index().find(parameter)->name, .parameter = parameter});
  }
  const Kind* built_in = kind.def.is_known() ? &kind_info(ObjectKind::Group) : kind.kind;
  if (built_in == nullptr) return all;
  for (const Property& property : built_in->properties) {
    const bool is_replaced =
        std::ranges::find(all, property.name, &BlockProperty::name) != all.end();
    if (!is_replaced) all.push_back({.name = property.name, .property = &property});
  }
  return all;
}

std::vector<SymbolId> parameters_of(const SceneView& view, SymbolId owner) {
  std::vector<SymbolId> parameters;
  if (view.index().find(owner) == nullptr) return parameters;
  for (const Symbol& symbol : view.table(owner.file).parameters_of(owner.index)) {
    parameters.push_back({owner.file, symbol.node});
  }
  return parameters;
}

bool has_default(const SceneView& view, SymbolId parameter) {
  return ast::expression_of(ast::Node(view.tree(parameter.file), parameter.index)).has_value();
}

std::string_view type_name_of(const SceneView& view, SymbolId symbol) {
  const TypeInfo* type = type_of(view.index(), symbol);
  return type == nullptr ? std::string_view() : type->name;
}

std::string_view type_name_of(Type type) noexcept {
  switch (type) {
    case Type::Number:
    case Type::WholeNumber:
    case Type::Length: return "number";
    case Type::Bool: return "bool";
    case Type::String: return "string";
    case Type::Vec3: return "vec3";
    case Type::Angle: return "angle";
    case Type::Angles: return "angles";
    case Type::Color: return "color";
    case Type::Interval:
    case Type::Frames: return "interval";
    case Type::Material: return "material";
    case Type::Focus:
    case Type::Word:
    case Type::Motion: break;
  }
  return {};
}

SymbolId find_import(const SceneView& view, std::uint32_t file, std::string_view name) {
  const auto& imports = view.module(file).imports;
  const auto found = imports.find(name);
  return found == imports.end() ? SymbolId() : SymbolId{file, found->second.node};
}

}  // namespace sdlc::lang
