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

/// Which member of an object belongs to which row of its table, as indices into the tape. An index
/// is 0 where the row has no member: the root of what is looked at stands before every member.
struct Members {
  std::array<std::uint32_t, kMaxJsonKeys> names{};

  std::uint32_t value(std::size_t row) const noexcept {
    return names[row] == 0 ? 0 : names[row] + 1;
  }
};

/// The name of a member: a view of the text, or of `buffer` where it has escapes.
std::string_view member_name(const SourceFile& file, const JsonNode& name, std::string& buffer);

/// The row with the key, tried first at `guess`: most objects list their keys in the same order.
inline std::optional<std::size_t> find_key(std::span<const JsonKey> keys, std::string_view name,
                                           std::size_t guess = 0) noexcept {
  if (guess < keys.size() && keys[guess].key == name) return guess;
  for (std::size_t row = 0; row < keys.size(); ++row) {
    if (keys[row].key == name) return row;
  }
  return std::nullopt;
}

/// Reports the key, with the one that was probably meant; returns the row of that one.
std::optional<std::size_t> diagnose_unknown_key(std::span<const JsonKey> keys,
                                                std::string_view object, std::string_view name,
                                                Location where, DiagnosticSink& sink);
void diagnose_duplicate_key(std::string_view name, Location second, Location first,
                            DiagnosticSink& sink);

/// Assigns the members of tape[object] to the rows, and reports unknown and duplicate keys. Of
/// duplicates the first counts. A member whose key is misspelt is taken for the one that was meant,
/// if that is absent: its value is checked too, and nothing is reported as missing.
Members find_members(const SourceFile& file, const Tape& tape, std::uint32_t object,
                     const JsonObject& table, DiagnosticSink& sink);

/// Whether the row has a value other than null.
inline bool has_value(const Tape& tape, const Members& members, std::size_t row) noexcept {
  const std::uint32_t value = members.value(row);
  return value != 0 && tape[value].type != JsonNodeType::Null;
}

/// Reports each required key that is absent or null: at the null, else at `where`.
void check_required(const SourceFile& file, const Tape& tape, const Members& members,
                    const JsonObject& table, Location where, DiagnosticSink& sink);

}  // namespace sdlc::lang
