#pragma once

#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/repair/repaired_text.hpp"
#include "lang/repair/tokens.hpp"

namespace sdlc::lang {

/// Finds phrases of other languages, such as `for (i in list) {`, `let f(x) = …` or `1, 2, 3`
/// without parentheses: several tokens that are one mistake. Reports them, and returns the edits
/// that make of each what was meant.
std::vector<Edit> repair_phrases(const SourceFile& file, const TokenList& tokens,
                                 RepairedText& text, DiagnosticSink& sink);

}  // namespace sdlc::lang
