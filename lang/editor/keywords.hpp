#pragma once

#include <span>
#include <string_view>

namespace sdlc::lang {

/// A word that is part of the syntax.
struct Keyword {
  std::string_view word;
  std::string_view form;  ///< how it is written
  std::string_view doc;
};

/// All of them: the reserved words, and `scene`, `as` and `in`, which are names elsewhere.
std::span<const Keyword> all_keywords() noexcept;
/// Null for other words.
const Keyword* find_keyword(std::string_view word) noexcept;

}  // namespace sdlc::lang
