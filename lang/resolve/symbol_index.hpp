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
  std::uint32_t file = 0;  ///< index of the module
  Span span;

  friend bool operator==(const FileSpan&, const FileSpan&) = default;
};

/// The result of a rename: the places to replace, or the reason why it is refused.
struct Rename {
  enum class Refusal : std::uint8_t {
    None,
    NotDeclared,  ///< the symbol is unknown or built in
    InvalidName,  ///< the new name is not a valid name
    Conflict,     ///< a name would refer to another symbol
  };

  Refusal refusal = Refusal::None;
  std::vector<FileSpan> places = {};      ///< all occurrences, the declaration included
  std::optional<FileSpan> conflict = {};  ///< of the other name; nullopt: it is built in
};

/// The names of all files of a program, for editors: definitions, references, completion, rename.
/// The modules must outlive the index and must not change.
class SymbolIndex {
 public:
  /// Loads all files that the program can include, and records the names of every file. Errors go
  /// to `sink`: files that are loaded here are not reported again by an evaluation.
  SymbolIndex(Modules& modules, DiagnosticSink& sink);

  std::uint32_t file_count() const { return static_cast<std::uint32_t>(tables_.size()); }
  const SymbolTable& table(std::uint32_t file) const { return tables_[file]; }

  /// The symbol of the name at the offset; not is_known() if there is none.
  SymbolId at(std::uint32_t file, std::uint32_t offset) const;
  /// The symbol if a file declares it, else null.
  const Symbol* find(SymbolId id) const;
  /// All occurrences in all files, the declaration included, sorted by file and place.
  std::vector<FileSpan> references(SymbolId id) const;
  /// The values, functions and kinds that the imported file declares.
  std::vector<SymbolId> members(SymbolId import) const;
  /// The doc comment of a declaration, or the description of a built-in name.
  std::string documentation(SymbolId id) const;
  /// The places to replace to rename the symbol. Refused if that changes what the program means.
  Rename rename(SymbolId id, std::string_view new_name) const;

 private:
  std::optional<FileSpan> find_conflict(SymbolId id, std::string_view new_name) const;

  Modules& modules_;
  std::vector<SymbolTable> tables_;
};

}  // namespace sdlc::lang
