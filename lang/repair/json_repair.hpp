#pragma once

#include <optional>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/repair/repaired_text.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The config with brackets added where they are missing and removed where they are too many, and
/// with marks of json_syntax.hpp in place of what no grammar of JSON gets past. What was wrong is
/// reported. nullopt if there is nothing to repair, and for texts too long to be written by hand.
std::optional<RepairedText> repair_json(const SourceFile& file, DiagnosticSink& sink);

}  // namespace sdlc::lang
