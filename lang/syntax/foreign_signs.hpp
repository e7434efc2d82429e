#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace sdlc::lang {

/// A sign that people write from habit, of another language or of a word processor.
struct ForeignSign {
  std::string_view text;
  std::string_view replacement;  ///< what the language writes; empty with `deletes` false: see help
  std::string_view help;         ///< empty where the replacement says it all
  bool deletes = false;
};

inline constexpr auto kForeignSigns = std::to_array<ForeignSign>({
    {"<!--", "", "comments are `// …` and `/* … */`"},
    {"-->", "", "comments are `// …` and `/* … */`"},
    {"&&", "and", ""},
    {"||", "or", ""},
    {"!==", "!=", ""},
    {"===", "==", ""},
    {"!", "not ", ""},
    {"=>", "", "a function is `fn f(x) = …`; at least is written `>=`"},
    {"->", "", "the type of a result goes without saying: `fn f(x) = …`"},
    {"=<", "<=", ""},
    {"<>", "!=", ""},
    {"**", "^", ""},
    {"++", "", "values never change"},
    {"+=", "", "values never change"},
    {"%", "", "write `mod(a, b)`"},
    {"?", "", "write `if … then … else …`"},
    {";", "", "a statement ends by itself", true},
    {"°", "deg", ""},
    {"−", "-", "this is the minus of a word processor"},
    {"–", "-", "this is a dash"},
    {"×", "*", ""},
    {"·", "*", ""},
    {"÷", "/", ""},
    {"≤", "<=", ""},
    {"≥", ">=", ""},
    {"≠", "!=", ""},
    {"…", "..", ""},
    {"“", "\"", "these are the quotes of a word processor"},
    {"”", "\"", "these are the quotes of a word processor"},
    {"„", "\"", "these are the quotes of a word processor"},
    {"‘", "\"", "these are the quotes of a word processor"},
    {"’", "\"", "these are the quotes of a word processor"},
});

/// The sign that is written exactly so; null where there is none.
inline const ForeignSign* find_foreign_sign(std::string_view text) noexcept {
  const auto found = std::find_if(kForeignSigns.begin(), kForeignSigns.end(),
                                  [&](const ForeignSign& sign) { return sign.text == text; });
  return found == kForeignSigns.end() ? nullptr : &*found;
}

}  // namespace sdlc::lang
