#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lang/resolve/symbol.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

/// The outlines of files, as editors show them.
namespace sdlc::lang {

/// What a symbol is shown as.
enum class SymbolIcon : std::uint8_t {
  Let,
  Param,
  Import,
  Function,
  Kind,
  Object,
  // In configs
  Array,
  Number,
  String,
  Bool,
  Null,
};

/// Of a symbol that a file declares.
SymbolIcon icon_of(SymbolKind kind) noexcept;

/// An entry of an outline.
struct DocumentSymbol {
  std::string name;    ///< never empty, without line ends
  std::string detail;  ///< the beginning of its text: a value, the parameters, the kind
  SymbolIcon icon = SymbolIcon::Let;
  bool has_own_name = true;  ///< false for an object without one, which has the name of its kind
  std::uint32_t depth = 0;   ///< number of entries around it: those before it with smaller depths
  Span whole;                ///< in that of the entry around it
  Span where;                ///< the name, in `whole`
};

/// Maximum entries of an outline.
inline constexpr std::size_t kMaxDocumentSymbols = 10'000;

/// The declarations and objects of a scene, in the order of the text. Of too many, objects without
/// names are omitted first.
std::vector<DocumentSymbol> document_symbols(const SyntaxTree& tree,
                                             std::size_t max_count = kMaxDocumentSymbols);
/// The members of a JSON config and the elements of its lists, three levels deep.
std::vector<DocumentSymbol> config_symbols(std::string_view text,
                                           std::size_t max_count = kMaxDocumentSymbols);

/// The beginning of a text on one line, with single spaces.
std::string excerpt_of(std::string_view text);

}  // namespace sdlc::lang
