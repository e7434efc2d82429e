#pragma once

#include <optional>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/repair/repaired_text.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

struct SceneRepairOptions {
  /// Brackets that match may be wrong all the same, one missing and one too many elsewhere.
  bool may_mismatch = false;
  /// Repairs nothing but signs and phrases, which can have been meant in one way only.
  bool is_certain = false;
};

/// `text`, which is `file`'s or a copy of the same length, with brackets and marks added where they
/// are missing, and with words, signs and phrases as they were meant, so that the rest of it can be
/// read. What was wrong is reported. nullopt if there is nothing to repair, or no telling what.
std::optional<RepairedText> repair_scene(const SourceFile& file, std::string_view text,
                                         SceneRepairOptions options, DiagnosticSink& sink);

}  // namespace sdlc::lang
