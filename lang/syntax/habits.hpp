#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace sdlc::lang {

/// What people write from habit, from other languages or from word processors.
struct Habit {
  std::string_view text;
  std::string_view replacement;  ///< what the language writes; empty with `deletes` false: see help
  std::string_view help;
  bool deletes = false;
};

inline constexpr auto kHabits = std::to_array<Habit>({
    {"&&", "and", "write `and`"},
    {"||", "or", "write `or`"},
    {"!==", "!=", "write `!=`"},
    {"===", "==", "write `==`"},
    {"!", "not ", "write `not`"},
    {"=>", "", "a function is `fn f(x) = …`; at least is written `>=`"},
    {"=<", "<=", "write `<=`"},
    {"<>", "!=", "write `!=`"},
    {"**", "^", "write `^`"},
    {"++", "", "values never change"},
    {"+=", "", "values never change"},
    {"%", "", "write `mod(a, b)`"},
    {"?", "", "write `if … then … else …`"},
    {";", "", "a statement ends by itself", true},
    {"°", "deg", "write `deg`"},
    {"−", "-", "this is the minus of a word processor"},
    {"–", "-", "this is a dash"},
    {"×", "*", "write `*`"},
    {"·", "*", "write `*`"},
    {"÷", "/", "write `/`"},
    {"≤", "<=", "write `<=`"},
    {"≥", ">=", "write `>=`"},
    {"≠", "!=", "write `!=`"},
    {"…", "..", "write `..`"},
    {"“", "\"", "these are the quotes of a word processor"},
    {"”", "\"", "these are the quotes of a word processor"},
    {"„", "\"", "these are the quotes of a word processor"},
    {"‘", "\"", "these are the quotes of a word processor"},
    {"’", "\"", "these are the quotes of a word processor"},
});

/// The habit that is written exactly so; null where there is none.
inline const Habit* find_habit(std::string_view text) noexcept {
  const auto found = std::find_if(kHabits.begin(), kHabits.end(),
                                  [&](const Habit& habit) { return habit.text == text; });
  return found == kHabits.end() ? nullptr : &*found;
}

}  // namespace sdlc::lang
