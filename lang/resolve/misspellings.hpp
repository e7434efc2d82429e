#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/resolve/symbol_table.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// A declaration that nothing uses, and an unknown name very much like it.
struct Misspelling {
  Location declared, used;  ///< the name in the declaration, and where it is used first
  std::string_view name;    ///< as it is declared
  std::string_view meant;   ///< as it is used
  /// The declaration is misspelt, not the use: several uses agree on the name, or its parts are
  /// words of the file and those of the declared one are not.
  bool is_certain = false;
};

/// The misspellings of one file.
class Misspellings {
 public:
  Misspellings(const SymbolTable& table, const StopRequest* stop);

  /// The misspelling of the unknown name that begins at this byte, or null.
  const Misspelling* find(std::uint32_t use) const;

 private:
  std::unordered_map<std::uint32_t, Misspelling> uses_;
};

}  // namespace sdlc::lang
