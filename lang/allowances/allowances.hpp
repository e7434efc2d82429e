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

/// The comments `// sdlc: allow(W402, W4) reason` of scene files. They silence warnings with these
/// codes or prefixes in one statement and everything inside it. The statement of a comment alone on
/// its line is the next one. The statement of a comment after other text is the last one that ends
/// before it on the same line, not one nested in that; if there is none, the one around the
/// comment. `sdlc fmt` preserves the statement of each comment. Errors cannot be allowed; JSON has
/// no comments.
///
/// Only a Document can have allowances. Its tree is read on demand.
class Allowances {
 public:
  /// `stop` may be null.
  explicit Allowances(const StopRequest* stop) noexcept : stop_(stop) {}

  /// Whether a comment allows the warning at this place. Marks that comment as used.
  bool allow(const DiagnosticInfo& info, Location where);

  /// Reports unused and malformed allowances of the file. Call it after all other reports.
  void diagnose_unused(const SourceFile& file, DiagnosticSink& sink);

 private:
  /// One code of a comment.
  struct Allowance {
    Span code;                       ///< in the text
    Span comment;                    ///< in the text
    std::uint32_t index = 0;         ///< of the code in its comment
    std::uint32_t count = 1;         ///< codes of the comment
    std::uint32_t place = kNowhere;  ///< in FileAllowances; kNowhere without a statement
  };
  /// A statement with allowances: their codes, and whether they were used.
  struct Place {
    Span statement;
    std::uint32_t around = kNowhere;  ///< the enclosing place
    std::map<std::string, bool> is_used = {};
  };
  struct FileAllowances {
    std::vector<Allowance> list;
    std::vector<Place> places;    ///< by beginning, outer ones first
    std::vector<Span> malformed;  ///< comments
  };
  static constexpr std::uint32_t kNowhere = 0xFFFFFFFF;

  FileAllowances& of(const SourceFile& file);
  FileAllowances read(const SourceFile& file) const;
  static void find_places(const std::vector<std::optional<Span>>& statements,
                          FileAllowances& allowances);
  static void diagnose_unused(const SourceFile& file, const FileAllowances& allowances,
                              const Allowance& allowance, DiagnosticSink& sink);

  const StopRequest* stop_;
  std::unordered_map<const SourceFile*, FileAllowances> files_;
};

/// The findings of the sink without the warnings that comments of their files allow.
Findings select_unallowed(const DiagnosticSink& sink, FindingsFilter filter = {});

}  // namespace sdlc::lang
