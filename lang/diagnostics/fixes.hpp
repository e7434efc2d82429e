#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::lang {

/// A text after fixes.
struct FixedText {
  std::string text;
  std::size_t applied = 0;  ///< diagnostics whose fixes were applied
};

/// The diagnostics whose fixes can be applied to `file` together, by place: those of one diagnostic
/// all or none. Where fixes touch each other the first in the text is taken; what is reported about
/// the result shows whether the other is still needed. Unsafe ones only if asked for.
std::vector<const Diagnostic*> select_fixes(const SourceFile& file,
                                            std::span<const Diagnostic* const> diagnostics,
                                            bool applies_unsafe);

/// The text of `file` with all fixes of `selected` applied, a subset of what select_fixes() gave.
std::string fixed_text(const SourceFile& file, std::span<const Diagnostic* const> selected);

/// Both.
FixedText apply_fixes(const SourceFile& file, std::span<const Diagnostic* const> diagnostics,
                      bool applies_unsafe);

}  // namespace sdlc::lang
