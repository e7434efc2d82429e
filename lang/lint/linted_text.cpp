#include "lang/lint/linted_text.hpp"

#include <utility>

#include "lang/allowances/allowances.hpp"
#include "lang/lint/lint.hpp"

namespace sdlc::lang {

LintedText::LintedText(std::shared_ptr<const Document> document, const ProgramOptions& options,
                       const StopRequest* stop)
    : document_(std::move(document)), sink_(stop), compiler_(*document_, options, sink_) {
  lint(compiler_, *document_, sink_);
}

void LintedText::select(FindingsFilter filter) {
  findings_ = select_unallowed(sink_, std::move(filter));
}

}  // namespace sdlc::lang
