#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "lang/editor/scene_view.hpp"
#include "lang/resolve/symbol_index.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

/// From a name to its declaration, and from a declaration to its uses.
namespace sdlc::lang {

/// A place in a file, apart from any scene.
struct Place {
  std::filesystem::path path;
  Span where;

  friend bool operator==(const Place&, const Place&) = default;
};

/// The target of a jump.
struct JumpTarget {
  Span origin;                 ///< what is at the offset: a name, or a path with its quotes
  std::filesystem::path path;  ///< of the target, which may not exist if the origin is a path
  Span whole;                  ///< the declaration; empty: the file
  Span where;                  ///< the name in it
};

/// Where the name at the offset is declared, or the file that an import or include names. The name
/// of an import leads to its file. nullopt for names of the language and unknown names.
std::optional<JumpTarget> definition(const SceneView& view, std::uint32_t file,
                                     std::uint32_t offset);
/// The same, but the name of an import leads to the import statement.
std::optional<JumpTarget> declaration(const SceneView& view, std::uint32_t file,
                                      std::uint32_t offset);

/// The scenes of a workspace that read a file: all that can use its names. Each has the same text
/// of every file. They need not be in memory at the same time.
class SceneSet {
 public:
  virtual ~SceneSet() = default;

  virtual std::size_t size() const = 0;
  /// Null if the scene can no longer be read. Valid until the next call.
  virtual const SceneView* scene(std::size_t index) = 0;
};

/// A symbol, apart from any scene.
struct SharedSymbol {
  std::filesystem::path path;    ///< of the file that declares it; empty for names of the language
  std::uint32_t index = 0;       ///< see SymbolId
  Span where = {};               ///< the name in the declaration
  bool is_local_to_file = true;  ///< false: other files can use it
};

/// The symbol of the name at the offset; nullopt for unknown names. If it is not local to its file,
/// its references are in all scenes that read that file.
std::optional<SharedSymbol> shared_symbol(const SceneView& view, std::uint32_t file,
                                          std::uint32_t offset);
/// The symbol in a scene; not is_known() if the scene does not read its file.
SymbolId symbol_in(const SceneView& view, const SharedSymbol& symbol);

/// Places in the files of several scenes, each once.
class PlaceSet {
 public:
  /// Adds places of a scene, which are sorted by file and place. Returns those that no scene before
  /// has added.
  std::vector<FileSpan> add(const SceneView& view, std::span<const FileSpan> places);
  /// Those in the file with this identity, sorted.
  std::span<const Span> in(const std::filesystem::path& identity) const;
  /// All, by path and place.
  std::vector<Place> all() const;

 private:
  struct File {
    std::filesystem::path path;
    std::vector<Span> places;  // sorted
  };

  std::map<std::filesystem::path, File> files_;  // by identity: two paths may be one file
};

/// The names of the symbol in all files of the scenes, each once, by path and place.
std::vector<Place> references(SceneSet& scenes, const SharedSymbol& symbol,
                              bool includes_declaration);

/// A name in a file that means the same as the name at the cursor.
struct Highlight {
  Span where;
  bool is_write = false;  ///< a declaration, or a label that gives a parameter its value
};

/// In the order of the text. Empty if there is no known name at the offset.
std::vector<Highlight> highlights(const SceneView& view, std::uint32_t file, std::uint32_t offset);

}  // namespace sdlc::lang
