#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/report/findings.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// A text and its findings.
class CheckedText {
 public:
  virtual ~CheckedText() = default;
  virtual const SourceFile& file() const = 0;
  /// All errors, including those that are not shown.
  virtual std::size_t error_count() const = 0;
  /// The findings whose fixes may be applied.
  virtual const Findings& findings() const = 0;
};

/// Checks a text; called for every text that results from fixes.
using CheckText = std::function<std::unique_ptr<CheckedText>(std::string)>;

/// An unsafe fix that was applied.
struct Guess {
  Position where;  ///< in the text before the fix
  const DiagnosticInfo* info = nullptr;
  std::string change;  ///< "`radus` to `radius`"
};

struct FixResult {
  std::unique_ptr<CheckedText> checked;  ///< the text after the fixes
  std::size_t applied = 0;               ///< findings that were fixed
  std::size_t refused = 0;               ///< fixes that were rejected because of their effect
  std::vector<Guess> guesses;            ///< among the applied ones
};

/// Applies fixes until none is left. Each is tried: a safe fix is refused if it would add errors,
/// or if the FixGuard rejects it; an unsafe one is applied only if it leaves fewer errors. The
/// result has no fix left that would be applied, so a second call changes nothing.
FixResult fix_text(std::unique_ptr<CheckedText> checked, bool applies_unsafe,
                   const CheckText& check);

}  // namespace sdlc::lang
