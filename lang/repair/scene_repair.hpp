#pragma once

#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/repair/repaired_text.hpp"
#include "lang/repair/tokens.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// Where repairs take place: a scene or config, its text with the repairs made so far, and the sink
/// for reports.
struct RepairContext {
  const SourceFile& file;
  RepairedText& text;
  DiagnosticSink& sink;
};

/// Replaces words, signs and phrases of other languages, and misspelt keywords.
void repair_spelling(const RepairContext& context);

/// Adds missing brackets, commas and colons, and removes surplus brackets. `may_mismatch`: matching
/// brackets may be wrong too, one missing and one too many elsewhere.
void repair_structure(const RepairContext& context, bool may_mismatch);

// The rounds of these repairs. Each reports what it finds and returns the edits of the text.

/// Calls that lack their opening parenthesis: `rgb120, 140, 90)`.
std::vector<Edit> repair_calls(const RepairContext& context, const TokenList& tokens);
/// Heads of blocks, loops and functions: `for (i in list) {`, `let f(x) = …`.
std::vector<Edit> repair_blocks(const RepairContext& context, const TokenList& tokens);
/// Declarations, names and values: `let size: number = 1`, `1, 2, 3` for a point.
std::vector<Edit> repair_values(const RepairContext& context, const TokenList& tokens);
/// Operators, quotes, comments and separated units as other languages write them.
std::vector<Edit> repair_signs(const RepairContext& context, const TokenList& tokens);
/// Misspelt keywords.
std::vector<Edit> repair_words(const RepairContext& context, const TokenList& tokens);
/// Statements without a colon, and calls in place of statements.
std::vector<Edit> repair_statements(const RepairContext& context, const TokenList& tokens);
/// What is missing between values in parentheses and lists: commas, colons, the third value of a
/// point.
std::vector<Edit> repair_marks(const RepairContext& context, const TokenList& tokens);

}  // namespace sdlc::lang
