#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

/// The words of the language, for code that works on tokens.
namespace sdlc::lang {

template <std::size_t kFirst, std::size_t kSecond>
constexpr std::array<std::string_view, kFirst + kSecond> joined(
    const std::array<std::string_view, kFirst>& first,
    const std::array<std::string_view, kSecond>& second) {
  std::array<std::string_view, kFirst + kSecond> both;
  std::copy(second.begin(), second.end(), std::copy(first.begin(), first.end(), both.begin()));
  return both;
}

template <std::size_t kSize>
constexpr bool is_one_of(std::string_view word, const std::array<std::string_view, kSize>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

inline constexpr auto kUnits =
    std::to_array<std::string_view>({"deg", "rad", "turn", "mm", "cm", "m", "km", "ms", "s", "%"});

inline constexpr auto kDeclarationWords =
    std::to_array<std::string_view>({"let", "fn", "def", "param", "import", "include", "assert"});
/// The first words of statements other than objects and properties.
inline constexpr auto kStatementWords =
    joined(kDeclarationWords, std::to_array<std::string_view>({"for", "if"}));

/// Words that continue the expression before them.
inline constexpr auto kLinkWords = std::to_array<std::string_view>({"and", "or", "then", "else"});
/// Words after which an expression must follow.
inline constexpr auto kJoints =
    joined(kLinkWords, std::to_array<std::string_view>({"not", "in", "if", "as"}));

/// Words that cannot be names.
inline constexpr auto kReservedWords = joined(
    joined(kStatementWords, kLinkWords), std::to_array<std::string_view>({"not", "true", "false"}));
/// Words of the language in certain places, and names in all others.
inline constexpr auto kContextualWords = std::to_array<std::string_view>({"scene", "as", "in"});

}  // namespace sdlc::lang
