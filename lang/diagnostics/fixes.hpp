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

/// The diagnostics whose fixes can be applied to `file` together, by place; all fixes of a
/// diagnostic or none. If fixes touch each other, the first in the text is selected: checking the
/// result shows whether the other is still needed. Unsafe fixes are selected only if
/// `applies_unsafe`.
std::vector<const Diagnostic*> select_fixes(const SourceFile& file,
                                            std::span<const Diagnostic* const> diagnostics,
                                            bool applies_unsafe);

/// The text of `file` after all fixes of `selected`, a subset of the result of select_fixes().
std::string fixed_text(const SourceFile& file, std::span<const Diagnostic* const> selected);

/// Selects fixes and applies them.
FixedText apply_fixes(const SourceFile& file, std::span<const Diagnostic* const> diagnostics,
                      bool applies_unsafe);

}  // namespace sdlc::lang
