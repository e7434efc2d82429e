#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::lang {

/// A text after fixes.
struct FixedText {
  std::string text;
  std::size_t applied = 0;  ///< how many diagnostics were mended
};

/// The text of `file` with the fixes of the diagnostics in it applied, those of one diagnostic all
/// or none. Of fixes that touch each other the first in the text is taken: what is reported of the
/// result tells whether the other is still wanted. Unsafe ones are applied only if asked for.
FixedText apply_fixes(const SourceFile& file, std::span<const Diagnostic* const> diagnostics,
                      bool applies_unsafe);

}  // namespace sdlc::lang
