#pragma once

#include <cstdint>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/repair/repaired_text.hpp"
#include "lang/repair/tokens.hpp"

namespace sdlc::lang {

/// Finds what is missing between the values in parentheses and lists: commas, colons, and the third
/// value of a point. Reports it, and returns the edits that add it. `uncertain` gets the places of
/// the brackets that close around a mistake.
std::vector<Edit> repair_marks(const SourceFile& file, const TokenList& tokens, RepairedText& text,
                               DiagnosticSink& sink, std::vector<std::uint32_t>& uncertain);

}  // namespace sdlc::lang
