#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "lang/allowances/allowances.hpp"
#include "lang/compile/compile.hpp"
#include "lang/lint/fix_text.hpp"
#include "lang/lint/lint.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::test {

/// A document with all findings of lint().
class LintedText final : public lang::CheckedText {
 public:
  explicit LintedText(std::shared_ptr<const lang::Document> document,
                      const lang::ProgramOptions& options = {},
                      const lang::FindingsFilter& filter = {.max_per_severity = 10'000})
      : document_(std::move(document)), compiler_(*document_, options, sink_) {
    lang::lint(compiler_, *document_, sink_);
    findings_ = select_unallowed(sink_, filter);
  }

  const lang::SourceFile& file() const override { return *document_; }
  std::size_t error_count() const override { return sink_.error_count(); }
  const lang::Findings& findings() const override { return findings_; }

 private:
  std::shared_ptr<const lang::Document> document_;
  lang::DiagnosticSink sink_;
  lang::Compiler compiler_;  // holds texts that the sink refers to
  lang::Findings findings_;
};

}  // namespace sdlc::test
