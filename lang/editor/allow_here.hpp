#pragma once

#include <cstdint>
#include <optional>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/editor/text_edits.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::lang {

/// The edit that allows the warning at offset `at` with a comment (docs/lint.md, "Allowances"). The
/// comment is for the innermost statement around `at` that begins or ends a line. The edit adds the
/// code to the comment that the statement has already; otherwise it inserts a comment on a line of
/// its own before the statement, or else after it. If the statement is between others on its line,
/// the edit breaks the line, so that the comment is not about the others. nullopt for errors, for
/// findings about allowances, and outside of statements and scenes.
std::optional<TextEdit> allow_here(const Document& file, const DiagnosticInfo& info,
                                   std::uint32_t at);

}  // namespace sdlc::lang
