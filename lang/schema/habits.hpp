#pragma once

#include <optional>
#include <string_view>

#include "lang/schema/schema.hpp"

/// Names that people bring along from other programs and languages, and what they are called here.
namespace sdlc::lang {

/// What the writer of a name that does not exist most likely wanted.
struct Habit {
  std::string_view meant = {};  ///< the name for it here; empty where there is no single one
  std::string_view help = {};   ///< what to write, in words; empty where `meant` says it
  std::string_view in_place_of =
      {};  ///< the property that is not missing, as this one stands there
};

// What to write in the place of statements that the language has none of.
inline constexpr std::string_view kNoLoop =
    "values never change; a loop goes through a list: `for i in range(0, 10) { … }`";
inline constexpr std::string_view kOwnKind = "a kind of your own begins with `def name(…) { … }`";

std::optional<Habit> kind_habit(std::string_view name) noexcept;
/// Of a property of the kind: the keys of the JSON format among them.
std::optional<Habit> property_habit(const Kind& kind, std::string_view name) noexcept;
std::optional<Habit> function_habit(std::string_view name) noexcept;
/// Of an argument of a constructor, by the JSON format's key among others.
std::optional<Habit> argument_habit(std::string_view name) noexcept;
/// Of a value.
std::optional<Habit> name_habit(std::string_view name) noexcept;
/// Whether it is what other languages write in front of their functions of numbers: `math.sin`.
bool is_foreign_library(std::string_view name) noexcept;
std::optional<Habit> type_habit(std::string_view name) noexcept;

}  // namespace sdlc::lang
