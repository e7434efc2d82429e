#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/resolve/symbol.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

/// The amount of detail that is recorded.
enum class SymbolDetail : std::uint8_t {
  Declared,  ///< symbols that files declare, their occurrences, `time`, and unknown names
  All,       ///< also labels of objects, properties, words, and built-in names
};

/// The symbols that one file declares, and the meaning of each name in its text. The tree must
/// outlive the table.
class SymbolTable {
 public:
  /// `symbols` sorted by node, `occurrences` by place.
  SymbolTable(const SyntaxTree& tree, std::uint32_t file, std::vector<Symbol> symbols,
              std::vector<Occurrence> occurrences, std::vector<UnknownName> unknown)
      : tree_(&tree),
        file_(file),
        symbols_(std::move(symbols)),
        occurrences_(std::move(occurrences)),
        unknown_(std::move(unknown)) {}

  const SyntaxTree& tree() const noexcept { return *tree_; }
  std::uint32_t file() const noexcept { return file_; }
  /// Sorted by node, which is the order of the text.
  std::span<const Symbol> symbols() const noexcept { return symbols_; }
  /// Sorted by place, declarations included; no two overlap.
  std::span<const Occurrence> occurrences() const noexcept { return occurrences_; }
  std::span<const UnknownName> unknown() const noexcept { return unknown_; }

  SymbolId id_of(const Symbol& symbol) const noexcept { return {file_, symbol.node}; }
  /// The symbol that the node declares, or null.
  const Symbol* find(NodeIndex node) const noexcept;
  /// The occurrence at the offset, its end included; or null.
  const Occurrence* at(std::uint32_t offset) const noexcept;
  /// The number of uses of each symbol. Uses of a fn or def in its own body count only if
  /// `counts_recursion`. `stop` may be null.
  std::vector<std::uint32_t> count_uses(bool counts_recursion, const StopRequest* stop) const;
  /// The symbols of a name space that are visible at the offset, inner scopes first; hidden ones
  /// are omitted.
  std::vector<const Symbol*> visible(std::uint32_t offset, NameSpace space) const;
  /// The parameters of a fn or def.
  std::vector<Symbol> parameters_of(NodeIndex owner) const;
  /// The text of the `///` comments before the declaration, without the slashes.
  std::string documentation_of(const Symbol& symbol) const;

 private:
  const SyntaxTree* tree_;
  std::uint32_t file_;
  std::vector<Symbol> symbols_;
  std::vector<Occurrence> occurrences_;
  std::vector<UnknownName> unknown_;
};

}  // namespace sdlc::lang
