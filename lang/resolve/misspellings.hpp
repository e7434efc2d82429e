#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/resolve/symbol_table.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// A declaration that nothing uses, and an unknown name similar to it.
struct Misspelling {
  Location declared, used;  ///< the name in the declaration, and its first use
  std::string_view name;    ///< as declared
  std::string_view meant;   ///< as used
  /// The declaration is misspelt, not the use: there are several uses, or the words of the used
  /// name occur elsewhere in the file and those of the declared name do not.
  bool is_certain = false;
};

/// The misspellings of one file.
class Misspellings {
 public:
  Misspellings(const SymbolTable& table, const StopRequest* stop);

  /// The misspelling whose use begins at this byte, or null.
  const Misspelling* find(std::uint32_t use) const;

 private:
  std::unordered_map<std::uint32_t, Misspelling> uses_;
};

}  // namespace sdlc::lang
