#pragma once

#include <optional>
#include <string_view>

#include "lang/schema/schema.hpp"

/// Names, words and signs that people bring along from other languages and programs, and what to
/// write instead: one table.
namespace sdlc::lang {

/// Where in a text a habit shows.
enum class HabitPlace : std::uint8_t {
  Sign,            ///< an operator or a mark
  ValueWord,       ///< a word that declares a value: `var x = …`
  FunctionWord,    ///< a word that declares a function: `function f(…)`
  DefinitionWord,  ///< a word that declares a kind of object: `define f(…) {`
  LoopWord,        ///< `foreach x in …`
  StatementWord,   ///< a word that begins a statement without a counterpart
  ElseIf,          ///< one word for `else if`
  Unit,            ///< after a number
  Kind,            ///< of an object
  CameraProperty,
  SphereProperty,
  RenderProperty,
  BackgroundProperty,
  GroupProperty,  ///< of user-defined kinds too
  AnimationProperty,
  Callee,    ///< the name of a function
  Argument,  ///< of a material
  Type,      ///< of a parameter
  Name,      ///< of a value
  Library,   ///< before the name of a function: `math.sin`
};

/// The likely intention.
struct Habit {
  std::string_view meant = {};        ///< what to write instead; empty if there is no single answer
  std::string_view help = {};         ///< what to do, in words; empty if `meant` says it
  std::string_view in_place_of = {};  ///< the property that is not missing if this one is given

  friend bool operator==(const Habit&, const Habit&) = default;
};

inline constexpr std::string_view kNoLoop =
    "values never change; a loop goes through a list: `for i in range(0, 10) { … }`";
inline constexpr std::string_view kNameLetters =
    "names consist of the letters a to z and A to Z, digits and `_`";
inline constexpr std::string_view kFunction = "a function is one expression: `fn f(x) = …`";

std::optional<Habit> find_habit(HabitPlace place, std::string_view written) noexcept;
/// The longest sign of another language at the beginning of `text`; empty if there is none.
std::string_view foreign_sign_at(std::string_view text) noexcept;
/// Whether the text is that of a colour without its `#`.
bool is_color_without_sign(std::string_view text) noexcept;
/// Of a property of the kind, by the keys of the JSON format too.
std::optional<Habit> property_habit(const Kind& kind, std::string_view name) noexcept;

}  // namespace sdlc::lang
