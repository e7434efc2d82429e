#pragma once

#include <optional>
#include <string>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// Reports characters that a scene must not contain: invalid UTF-8, control characters, lone CR and
/// bidirectional controls anywhere; spaces other than space and tab outside comments and strings.
/// Returns the text with spaces in their place; nullopt if there are none.
std::optional<std::string> check_characters(const SourceFile& file, DiagnosticSink& sink);

}  // namespace sdlc::lang
