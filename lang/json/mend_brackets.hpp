#pragma once

#include <optional>
#include <string>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"
#include "lang/text/mended_text.hpp"

namespace sdlc::lang {

/// The text of the file, or `mended` which has its size, with brackets added where they are missing
/// and blanked where they are too many; what was wrong is reported. Nothing where the brackets
/// match or no one can tell. Where brackets are just of the wrong kind they are replaced in
/// `mended`.
std::optional<MendedText> mend_brackets(const SourceFile& file, std::optional<std::string>& mended,
                                        DiagnosticSink& sink);

}  // namespace sdlc::lang
