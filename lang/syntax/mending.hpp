#pragma once

#include <optional>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"
#include "lang/text/mended_text.hpp"

namespace sdlc::lang {

struct MendOptions {
  /// Brackets that match may be wrong all the same, one missing and one too many elsewhere.
  bool may_mismatch = false;
  /// Mends nothing but what can have been meant in one way only.
  bool is_certain = false;
};

/// `text`, which is `file`'s or a copy of the same length, with brackets added where they are
/// missing and blanked where they are too many, and with misspelt words of the language as they
/// were meant, so that the rest of it can be read. What was wrong is reported. Nothing where there
/// is nothing to mend, or no one can tell what.
std::optional<MendedText> mend(const SourceFile& file, std::string_view text, MendOptions options,
                               DiagnosticSink& sink);

}  // namespace sdlc::lang
