#include "lang/format/format.hpp"

#include <stdexcept>

#include "lang/format/composer.hpp"

namespace sdlc::lang {

std::string format(const SyntaxTree& tree) { return Composer(tree, 0).file(); }

std::optional<std::string> format_file(const Document& file, DiagnosticSink& sink,
                                       std::optional<LineRange> lines) {
  const std::size_t errors = sink.error_count();
  const SyntaxTree& tree = file.tree(sink);
  if (sink.error_count() > errors) return std::nullopt;
  std::string text = lines ? format_lines(tree, *lines) : format(tree);
  if (text == file.text()) return text;

  const Document formatted(file.name(), std::move(text));
  DiagnosticSink faults;
  const SyntaxTree& outcome = formatted.tree(faults);
  if (faults.has_errors() || !is_same_program(tree, outcome)) {
    throw std::logic_error(file.name() + ": formatting would change the program");
  }
  return std::string(formatted.text());
}

}  // namespace sdlc::lang
