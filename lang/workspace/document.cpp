#include "lang/workspace/document.hpp"

namespace sdlc::lang {

const SyntaxTree& Document::tree(DiagnosticSink& sink) const {
  if (!tree_) {
    DiagnosticSink errors(sink.stop_request());
    tree_.emplace(parse(*this, errors));
    syntax_errors_.add(errors);
  }
  sink.add(syntax_errors_);
  return *tree_;
}

}  // namespace sdlc::lang
