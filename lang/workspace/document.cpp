#include "lang/workspace/document.hpp"

#include "lang/data/data.hpp"

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

std::shared_ptr<const Table> Document::table(DiagnosticSink& sink) const {
  if (!table_) {
    DiagnosticSink errors(sink.stop_request());
    table_.emplace(read_table(*this, errors));
    syntax_errors_.add(errors);
  }
  sink.add(syntax_errors_);
  return *table_;
}

}  // namespace sdlc::lang
