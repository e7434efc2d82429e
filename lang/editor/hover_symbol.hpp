#pragma once

#include <cstdint>

#include "lang/editor/cursor.hpp"
#include "lang/editor/hover_text.hpp"
#include "lang/editor/scene_view.hpp"
#include "lang/editor/values.hpp"
#include "lang/resolve/symbol.hpp"

namespace sdlc::lang {

/// Adds the declaration, the description and the value of a symbol. `cursor`: of its name in
/// `file`.
void describe_symbol(SceneView& view, std::uint32_t file, const Cursor& cursor, SymbolId symbol,
                     Values& values, HoverText& text);

}  // namespace sdlc::lang
