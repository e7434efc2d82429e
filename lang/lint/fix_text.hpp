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

/// A text and what was found in it.
class CheckedText {
 public:
  virtual ~CheckedText() = default;
  virtual const SourceFile& file() const = 0;
  /// All errors, including those that are not shown.
  virtual std::size_t error_count() const = 0;
  /// The findings whose fixes may be applied.
  virtual const Findings& findings() const = 0;
};

/// Checks a text; called again for every text that fixes make.
using CheckText = std::function<std::unique_ptr<CheckedText>(std::string)>;

/// A fix that was a guess, and that was applied.
struct Guess {
  Position where;  ///< in the text at that time
  const DiagnosticInfo* info = nullptr;
  std::string change;  ///< "`radus` to `radius`"
};

struct FixResult {
  std::unique_ptr<CheckedText> checked;  ///< the text after the fixes
  std::size_t applied = 0;               ///< findings that were fixed
  std::size_t refused = 0;               ///< fixes that remain because of what they would do
  std::vector<Guess> guesses;            ///< among the applied ones
};

/// Applies fixes until none is left. Each is tried out: a safe fix that would leave more errors
/// than there were is refused, and so is one that would change the inside of a string or comment.
/// An unsafe one is applied only if it leaves fewer errors. The result has no fix left that would
/// be applied to it, so a second call changes nothing.
FixResult fix_text(std::unique_ptr<CheckedText> checked, bool applies_unsafe,
                   const CheckText& check);

/// Whether the fix leaves all strings and comments of the text as they are: it is outside of them,
/// or replaces one as a whole by something that contains it.
bool keeps_strings_and_comments(std::string_view text, const Fix& fix);

}  // namespace sdlc::lang
