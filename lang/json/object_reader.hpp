#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/json/tape.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {

inline constexpr std::size_t kMaxJsonKeys = 16;

/// Errors after which the rest of a config is not checked: a text that is no config may have 10^8.
inline constexpr std::size_t kMaxConfigErrors = 4'000'000;

/// For each row of an object's table the tape index of the member's name; 0 if there is none, which
/// is the index of the first node of a part and never that of a member of an object.
struct Members {
  std::array<std::uint32_t, kMaxJsonKeys> names{};

  /// The index of the value; 0 if there is none or it is null.
  std::uint32_t value(const Tape& tape, std::size_t row) const noexcept {
    const std::uint32_t value = names[row] + 1;
    return names[row] == 0 || tape[value].type == JsonNodeType::Null ? 0 : value;
  }
};

/// The row of the key. Tries `guess` first: most objects list their keys in the order of the table.
inline std::optional<std::size_t> find_key(std::span<const JsonKey> keys, std::string_view name,
                                           std::size_t guess = 0) noexcept {
  if (guess < keys.size() && keys[guess].key == name) return guess;
  for (std::size_t row = 0; row < keys.size(); ++row) {
    if (keys[row].key == name) return row;
  }
  return std::nullopt;
}

/// Reports the key and suggests the intended one; returns the row of the intended one.
std::optional<std::size_t> diagnose_unknown_key(std::span<const JsonKey> keys,
                                                std::string_view object, std::string_view name,
                                                Location where, DiagnosticSink& sink);
void diagnose_duplicate_key(std::string_view name, Location second, Location first,
                            DiagnosticSink& sink);

/// Assigns the members of tape[object] to the rows of the table. Reports unknown, duplicate and
/// missing keys, a missing one at its null or else at `where`. The first of duplicates counts. A
/// member with a misspelt key counts as the intended one if that is absent.
Members find_members(const SourceFile& file, const Tape& tape, std::uint32_t object,
                     const JsonObject& table, Location where, DiagnosticSink& sink);

}  // namespace sdlc::lang
