#include "lang/workspace/document.hpp"

#include <utility>

namespace sdlc::lang {

const SyntaxTree& Document::tree(DiagnosticSink& sink) const {
  if (!tree_) {
    DiagnosticSink errors(sink.stop_token());
    tree_.emplace(parse(*this, errors));
    syntax_errors_ = std::move(errors);
  }
  sink.add(syntax_errors_);
  return *tree_;
}

}  // namespace sdlc::lang
