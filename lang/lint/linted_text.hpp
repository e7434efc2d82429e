#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "lang/allowances/allowances.hpp"
#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lint/fix_text.hpp"
#include "lang/lint/lint.hpp"
#include "lang/report/findings.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::lang {

/// A document with the findings of lint() that no comment allows and `filter` accepts.
class LintedText final : public CheckedText {
 public:
  explicit LintedText(std::shared_ptr<const Document> document, const ProgramOptions& options = {},
                      FindingsFilter filter = {})
      : document_(std::move(document)), compiler_(*document_, options, sink_) {
    lint(compiler_, *document_, sink_);
    findings_ = select_unallowed(sink_, std::move(filter));
  }

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
