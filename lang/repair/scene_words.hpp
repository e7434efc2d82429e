#pragma once

#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/repair/repaired_text.hpp"
#include "lang/repair/tokens.hpp"

namespace sdlc::lang {

/// Finds misspelt words of the language and, with `signs_only` nothing but, signs of other
/// languages. Reports them, and returns the edits that make of each what was meant.
std::vector<Edit> repair_words(const SourceFile& file, const TokenList& tokens, bool signs_only,
                               RepairedText& text, DiagnosticSink& sink);

}  // namespace sdlc::lang
