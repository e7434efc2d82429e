#pragma once

#include <memory>

#include "lang/editor/scene_view.hpp"
#include "lang/object/table.hpp"
#include "lang/resolve/symbol.hpp"

namespace sdlc::lang {

/// The table that the symbol, the import of a data file, denotes; null for other symbols.
std::shared_ptr<const Table> table_of(const SceneView& view, SymbolId id);

/// The table whose rows the symbol denotes, found without an evaluation: the variable of a loop
/// over an import, or a let whose value is an element of one. Null for other symbols.
std::shared_ptr<const Table> table_of_row(const SceneView& view, SymbolId id);

}  // namespace sdlc::lang
