#pragma once

#include <memory>
#include <optional>
#include <string>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/table.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

/// A text with its syntax tree or table, read once however many programs use the text. Used by
/// one thread at a time.
class Document : public SourceFile {
 public:
  /// `version`: the number that an editor gives to the state of an open text; 0 for others.
  Document(std::string name, std::string text, int version = 0)
      : SourceFile(std::move(name), std::move(text)), version_(version) {}
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  int version() const noexcept { return version_; }

  /// The tree of a scene. Reports the syntax errors at every call.
  const SyntaxTree& tree(DiagnosticSink& sink) const;
  /// The table of a data file; null if it has mistakes. Reports these at every call.
  std::shared_ptr<const Table> table(DiagnosticSink& sink) const;

 private:
  int version_;
  mutable DiagnosticSink syntax_errors_;
  mutable std::optional<SyntaxTree> tree_;
  mutable std::optional<std::shared_ptr<const Table>> table_;
};

}  // namespace sdlc::lang
