#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>

#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

/// A declaration that nothing uses under the name that it has, while a name very much like it is
/// used and nothing declares that.
struct Misspelling {
  Location declared, used;  ///< the name in the declaration, and where it is used first
  std::string_view name;    ///< as it is declared
  std::string_view meant;   ///< as it is used
  /// It is the declaration that is misspelt, not the use: several places agree upon the name, or
  /// its parts are words of the file and those of the declared one are not.
  bool is_certain = false;
};

/// A look at a whole file for those who have come upon an unknown name.
class Misspellings {
 public:
  explicit Misspellings(const SyntaxTree& tree);

  /// What is meant by the unknown name whose use begins at this byte; null: nothing is known.
  const Misspelling* find(std::uint32_t use) const;

 private:
  std::unordered_map<std::uint32_t, Misspelling> uses_;
};

}  // namespace sdlc::lang
