#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"

/// Where to go on behind a mistake, found by looking at the text alone.
namespace sdlc::lang {

struct RecoveryOptions {
  std::uint32_t open = 0;   ///< brackets of the broken statement that are open at the beginning
  bool open_block = false;  ///< a block is open too, inside those
  /// Looks further ahead, to tell a bracket that is never closed from one that is closed later.
  bool is_patient = true;
};

/// From `from` on, the first place for a statement to begin: the block's `}`, a comma of the block,
/// a line that starts with a statement word, `name:`, `name {` or `name name {`; else the end.
/// Balanced brackets are skipped.
std::uint32_t next_statement(std::string_view text, std::uint32_t from, RecoveryOptions options);

/// Whether the token at `at` looks like the first of a statement.
bool looks_like_statement(std::string_view text, std::uint32_t at);

/// `span` without the blanks at its ends.
Span trim(std::string_view text, Span span) noexcept;

/// A block that is not closed where its indentation says that it ends.
struct MissingBrace {
  std::uint32_t opener = 0;
  std::optional<Span> before;          ///< the first token of the first line not indented deeper
  std::optional<std::size_t> mend_at;  ///< a blank, or the text's end, that could be the brace
  std::size_t count = 1;               ///< braces missing there
};

/// Precondition: the text ends in a block.
MissingBrace find_missing_brace(std::string_view text);
void report_missing_brace(const SourceFile& file, const MissingBrace& missing,
                          DiagnosticSink& sink);

}  // namespace sdlc::lang
