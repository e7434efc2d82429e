#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "lang/editor/scene_view.hpp"
#include "lang/resolve/symbol.hpp"
#include "lang/schema/schema.hpp"
#include "lang/value/builtins.hpp"
#include "lang/value/constructors.hpp"

namespace sdlc::lang {

/// What a path before `(` refers to; all null or unknown if there is no such function.
struct Callee {
  const Builtin* builtin = nullptr;
  const Constructor* constructor = nullptr;
  SymbolId function = {};  ///< a fn

  bool is_known() const noexcept {
    return builtin != nullptr || constructor != nullptr || function.is_known();
  }
};
Callee find_callee(const SceneView& view, std::uint32_t file, std::string_view path);

/// What a path before `{` refers to: a built-in kind or a def.
struct BlockKind {
  const Kind* kind = nullptr;
  SymbolId def = {};
};
BlockKind find_block_kind(const SceneView& view, std::uint32_t file, std::string_view path);

/// A property that a block accepts: `property` is null for a parameter of a def.
struct BlockProperty {
  std::string_view name;
  const Property* property = nullptr;
  SymbolId parameter = {};
};
/// All of them; of a def its parameters first, then the properties of a group.
std::vector<BlockProperty> properties_of(const SceneView& view, const BlockKind& kind);

/// The parameters of a fn or def.
std::vector<SymbolId> parameters_of(const SceneView& view, SymbolId owner);
/// Whether the parameter has a default value.
bool has_default(const SceneView& view, SymbolId parameter);
/// The type as in types.hpp; empty if it is not known.
std::string_view type_name_of(const SceneView& view, SymbolId symbol);
/// The type in types.hpp of the values of a property; empty for words and motions.
std::string_view type_name_of(Type type) noexcept;
/// The import with this name at the top level of the file; not is_known() if there is none.
SymbolId find_import(const SceneView& view, std::uint32_t file, std::string_view name);

}  // namespace sdlc::lang
