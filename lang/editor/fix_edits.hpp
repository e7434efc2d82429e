#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/editor/text_edits.hpp"
#include "lang/lint/fix_guard.hpp"
#include "lang/lint/fix_text.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// Edits of one file, ascending.
struct FileEdits {
  const SourceFile* file = nullptr;
  std::vector<TextEdit> edits;
};

/// All fixes of a diagnostic as one action.
struct QuickFix {
  std::string title;  ///< "Replace `radus` with `radius`"; one line, ends within 200 characters
  std::vector<FileEdits> files;
  bool is_preferred = false;  ///< `lint --fix` would try it
};

/// Makes actions from diagnostics. Reads each text at most once, so several diagnostics of a text
/// share an object. The texts must outlive it.
class QuickFixes {
 public:
  /// nullopt if the diagnostic has no fixes.
  std::optional<QuickFix> of(const Diagnostic& diagnostic);

 private:
  bool is_preferred(const Diagnostic& diagnostic);

  std::map<const SourceFile*, FixGuard> guards_;
};

/// One action for all of the findings with the code and the fix of `diagnostic` in its file:
/// "Replace all `radus` with `radius` in this file (3 places)". nullopt if there is only one, or if
/// the fix is not to replace or remove one text.
std::optional<QuickFix> fix_everywhere(const Diagnostic& diagnostic,
                                       std::span<const Diagnostic* const> findings);

/// The result of fix_all().
struct FixAll {
  std::vector<TextEdit> edits;  ///< of the text
  std::size_t applied = 0;      ///< findings that the edits fix
  std::size_t refused = 0;      ///< fixes that were tried and rejected because of their effect
};

/// Applies the safe fixes of a text until none is left, as `lint --fix` does. `check` checks the
/// texts in between, in the same way as `checked` was checked.
FixAll fix_all(std::unique_ptr<CheckedText> checked, const CheckText& check);

}  // namespace sdlc::lang
