#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lang/editor/navigation.hpp"
#include "lang/editor/scene_view.hpp"
#include "lang/source/source.hpp"

/// Renames over all files that use a name. A rename keeps what every scene means, or is refused.
namespace sdlc::lang {

/// The name that a rename would change, or why it cannot be renamed.
struct RenameTarget {
  Span where;           ///< the name at the cursor; empty if there is none
  std::string refusal;  ///< a sentence; empty if it can be renamed
};

RenameTarget prepare_rename(const SceneView& view, std::uint32_t file, std::uint32_t offset);

struct RenameOptions {
  /// Files outside of these folders are not changed, unless they are open. Empty: no restriction.
  std::vector<std::filesystem::path> folders = {};
};

/// The places to replace by the new name, or the reason why nothing can be replaced.
struct RenamePlan {
  std::string refusal;            ///< a sentence; empty if the rename is possible
  std::optional<Place> conflict;  ///< where the refusal comes from
  std::vector<Place> places;      ///< by path and place
};

/// `scenes`: of a symbol that is local to its file, one is enough. Every scene is resolved again
/// with the new texts, and the rename is refused if a name would mean something else.
RenamePlan plan_rename(SceneSet& scenes, const SharedSymbol& symbol, std::string_view new_name,
                       const RenameOptions& options = {});

}  // namespace sdlc::lang
