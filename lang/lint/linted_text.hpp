#pragma once

#include <cstddef>
#include <memory>

#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lint/fix_text.hpp"
#include "lang/program/program.hpp"
#include "lang/report/findings.hpp"
#include "lang/source/source.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::lang {

/// A document with the findings of lint().
class LintedText final : public CheckedText {
 public:
  /// Throws StopRequested if `stop`, which may be null, is made.
  LintedText(std::shared_ptr<const Document> document, const ProgramOptions& options,
             const StopRequest* stop = nullptr);

  /// Selects the findings, without the warnings that comments allow. Until then there are none.
  void select(FindingsFilter filter);

  const SourceFile& file() const override { return *document_; }
  std::size_t error_count() const override { return sink_.error_count(); }
  const Findings& findings() const override { return findings_; }

 private:
  std::shared_ptr<const Document> document_;
  DiagnosticSink sink_;
  Compiler compiler_;  // holds texts that the sink refers to
  Findings findings_;
};

}  // namespace sdlc::lang
