#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lang/resolve/module.hpp"
#include "lang/resolve/symbol.hpp"
#include "lang/resolve/symbol_table.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// A place in one of a program's files.
struct FileSpan {
  std::uint32_t file = 0;  ///< the module
  Span span;

  friend bool operator==(const FileSpan&, const FileSpan&) = default;
};

/// What a rename has to replace.
struct Rename {
  enum class Refusal : std::uint8_t {
    None,
    NotDeclared,  ///< an unknown name, or one of the language
    NoName,       ///< the new name is none
    Conflict,     ///< a name would change its meaning
  };

  Refusal refusal = Refusal::None;
  std::vector<FileSpan> places = {};      ///< the name in its declaration, and all its uses
  std::optional<FileSpan> conflict = {};  ///< a name that is in the way, if it is written
};

/// The names of all files of a program, for an editor: what is at a place, where else it occurs,
/// what is visible there. The modules must outlive the index and stay as they are.
class SymbolIndex {
 public:
  /// Records the names of every file that has been loaded.
  explicit SymbolIndex(Modules& modules, const StopRequest* stop = nullptr);

  std::uint32_t file_count() const { return static_cast<std::uint32_t>(tables_.size()); }
  const SymbolTable& table(std::uint32_t file) const { return tables_[file]; }

  /// The symbol of the name at an offset, or an unknown one.
  SymbolId at(std::uint32_t file, std::uint32_t offset) const;
  /// The symbol if a file declares it, else null.
  const Symbol* find(SymbolId id) const;
  /// Every occurrence in all files, the declaration included; by file, then by place.
  std::vector<FileSpan> references(SymbolId id) const;
  /// The values, functions and kinds of the file that an import names.
  std::vector<SymbolId> members(SymbolId import) const;
  /// The doc comment of a declaration, or the description of a name of the language.
  std::string documentation(SymbolId id) const;
  /// What to replace so that the symbol has the new name and the program its old meaning.
  Rename rename(SymbolId id, std::string_view new_name) const;

 private:
  std::optional<FileSpan> find_conflict(SymbolId id, std::string_view new_name) const;

  Modules& modules_;
  std::vector<SymbolTable> tables_;
};

}  // namespace sdlc::lang
