#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The comments `// sdlc: allow(W402, W4) reason` of scene files. One that stands alone on its line
/// speaks of the statement behind it, one behind other text of the statements that begin on its
/// line; where none does, of the one around it. In those, with all they contain, warnings with
/// these codes, or with codes that begin so, are silenced. Errors cannot be allowed; JSON has no
/// comments.
///
/// A file is looked at when something is reported about it.
class Allowances {
 public:
  /// Whether a comment allows the warning at this place; that comment is then of use.
  bool allow(const DiagnosticInfo& info, Location where);

  /// Reports what the file allows without need, and what is no allowance though it looks like one.
  /// It is known once everything else has been reported.
  void diagnose_unused(const SourceFile& file, DiagnosticSink& sink);

 private:
  /// One code of a comment.
  struct Allowance {
    Span code;                 ///< in the text
    Span comment;              ///< in the text
    std::uint32_t index = 0;   ///< of the code in its comment
    std::uint32_t count = 1;   ///< codes of the comment
    std::vector<Span> places;  ///< statements; empty: there is none
    bool is_used = false;
  };
  struct FileAllowances {
    std::vector<Allowance> list;
    std::vector<Span> unreadable;  ///< comments
  };

  FileAllowances& of(const SourceFile& file);
  static FileAllowances read(const SourceFile& file);
  static void diagnose_unused(const SourceFile& file, const Allowance& allowance,
                              DiagnosticSink& sink);

  std::unordered_map<const SourceFile*, FileAllowances> files_;
};

}  // namespace sdlc::lang
