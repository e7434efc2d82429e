#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lang/editor/navigation.hpp"
#include "lang/editor/scene_view.hpp"
#include "lang/resolve/symbol.hpp"
#include "lang/source/source.hpp"

/// Who calls a fn or makes instances of a def, and what those call themselves.
namespace sdlc::lang {

/// A fn or def, or a file: that calls what its top level calls.
struct CallItem {
  bool is_file = false;
  SymbolKind kind = SymbolKind::Fn;  ///< Fn or Def
  std::string name;                  ///< of a file: its name without the folder
  std::filesystem::path path;
  Span whole;  ///< the declaration; empty for a file
  Span where;  ///< the name in it

  friend bool operator==(const CallItem&, const CallItem&) = default;
};

/// Calls and instances between two items.
struct CallGroup {
  CallItem item;             ///< the other one
  std::vector<Span> places;  ///< the names of the callee, in the file of the caller
};

/// The fn or def that the name at the offset means.
std::optional<CallItem> call_item_at(const SceneView& view, std::uint32_t file,
                                     std::uint32_t offset);
/// The callers of a fn or def, by path and place.
std::vector<CallGroup> incoming_calls(SceneSet& scenes, const SharedSymbol& callee);
/// What an item calls, by path and place. Only calls of functions and kinds that a file declares.
std::vector<CallGroup> outgoing_calls(const SceneView& view, const CallItem& caller);

}  // namespace sdlc::lang
