#pragma once

#include <optional>
#include <string>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// What stands in a mended text for a thing that has been reported; see grammar/json.hpp.
inline constexpr char kMendedValue = '\x1A';
inline constexpr char kMendedMember = '\x1C';
inline constexpr char kMendedName = '\x1D';
constexpr bool is_mark(char c) noexcept {
  return c == kMendedValue || c == kMendedMember || c == kMendedName;
}

/// The file's text with what no reader of JSON gets past replaced by these characters and blanks:
/// expressions, strings that are never closed, characters that have no place. Every other byte
/// stays where it was. What is wrong is reported. Nothing where there is none of it, and of texts
/// too long to be written by hand.
std::optional<std::string> mend_syntax(const SourceFile& file, DiagnosticSink& sink);

}  // namespace sdlc::lang
