#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/report/findings.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The comments `// sdlc: allow(W402, W4) reason` of scene files. One that stands alone on its line
/// speaks of the statement behind it. One behind other text speaks of the statement that ends
/// before it on its line, the last one and not those inside of it; where none does, of the one
/// around it. In that, with all it contains, warnings with these codes, or with codes that begin
/// so, are silenced. `sdlc fmt` keeps what each speaks of. Errors cannot be allowed; JSON has no
/// comments.
///
/// Only a Document can have allowances. It is read when something is reported about it.
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
    Span code;                       ///< in the text
    Span comment;                    ///< in the text
    std::uint32_t index = 0;         ///< of the code in its comment
    std::uint32_t count = 1;         ///< codes of the comment
    std::uint32_t place = kNowhere;  ///< of FileAllowances; kNowhere: there is no statement
  };
  /// A statement that comments speak of, with their codes and whether one of them was of use.
  struct Place {
    Span statement;
    std::uint32_t around = kNowhere;  ///< the place that this one is inside of
    std::map<std::string, bool> is_used = {};
  };
  struct FileAllowances {
    std::vector<Allowance> list;
    std::vector<Place> places;     ///< by where they begin, outer ones first
    std::vector<Span> unreadable;  ///< comments
  };
  static constexpr std::uint32_t kNowhere = 0xFFFFFFFF;

  FileAllowances& of(const SourceFile& file);
  static FileAllowances read(const SourceFile& file);
  static void find_places(const std::vector<std::optional<Span>>& statements,
                          FileAllowances& allowances);
  static void diagnose_unused(const SourceFile& file, const FileAllowances& allowances,
                              const Allowance& allowance, DiagnosticSink& sink);

  std::unordered_map<const SourceFile*, FileAllowances> files_;
};

/// The findings of the sink without the warnings that comments of their files allow.
Findings select_unallowed(const DiagnosticSink& sink, FindingsFilter filter = {});

}  // namespace sdlc::lang
