#pragma once

#include <string_view>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// Rejects fixes of a text that are risky although they are marked as safe.
class FixGuard {
 public:
  /// `text` must outlive the guard.
  explicit FixGuard(std::string_view text);

  /// Whether the fix keeps strings and comments, does not change only a part of a sign such as
  /// `=>`, does not join words, and is not near quotes of another language.
  bool allows(const Fix& fix) const;
  /// Whether the fix leaves all strings and comments unchanged: it is outside of them, or replaces
  /// one completely by a text that contains its content.
  bool keeps_strings_and_comments(const Fix& fix) const;

 private:
  bool keeps(Span span, const Fix& fix) const;

  std::string_view text_;
  std::vector<Span> opaque_;  // strings and comments, ascending
};

}  // namespace sdlc::lang
