#pragma once

#include <optional>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/repair/repaired_text.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The config with missing brackets added, surplus ones removed, and the marks of json_syntax.hpp
/// in place of text that the grammar does not accept. Mistakes are reported. nullopt if there is
/// nothing to repair, or if the text is longer than kMaxRepairedText.
std::optional<RepairedText> repair_json(const SourceFile& file, DiagnosticSink& sink);

}  // namespace sdlc::lang
