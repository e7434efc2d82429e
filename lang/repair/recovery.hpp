#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"

/// Panic-mode recovery: where to continue after a mistake.
namespace sdlc::lang {

struct RecoveryOptions {
  std::uint32_t open = 0;   ///< brackets of the broken statement that are open at the beginning
  bool open_block = false;  ///< a block is open too, inside those
  /// Looks further ahead, to distinguish a bracket that is never closed from one closed later.
  bool is_patient = true;
  std::uint32_t indent = 0;  ///< of the broken statement; 0 if it is not `is_patient`
};

/// From `from` on, the first place for a statement to begin: the block's `}`, a comma of the block,
/// a line that starts with a statement word, `name:`, `name {` or `name name {`; else the end.
/// Balanced brackets are skipped.
std::uint32_t next_statement(std::string_view text, std::uint32_t from, RecoveryOptions options);

/// Whether the token at `at` looks like the first of a statement.
bool looks_like_statement(std::string_view text, std::uint32_t at);

/// Whether the name at `at` looks like the kind of an object, whose block follows.
bool looks_like_object(std::string_view text, std::uint32_t at);

/// Whether the `let` at `at`, the first word of its line, is the beginning of a value: its `in`
/// follows before another statement, as far as a short look shows.
bool has_in(std::string_view text, std::uint32_t at);

/// `span` without the white space at its ends.
Span trim(std::string_view text, Span span) noexcept;

}  // namespace sdlc::lang
