#pragma once

#include <optional>
#include <string>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// Reports the characters that may not stand in a scene: bad UTF-8, controls, lone CR,
/// bidirectional controls anywhere; blanks other than space and tab outside comments and strings.
/// Where there were any, gives the text with blanks in their places, so that nothing stumbles over
/// them for a second time.
std::optional<std::string> check_characters(const SourceFile& file, DiagnosticSink& sink);

}  // namespace sdlc::lang
