#include "tests/lang/workspace/checked_program.hpp"

#include <system_error>

#include <fmt/format.h>

#include "lang/compile/compile.hpp"
#include "lang/lint/lint.hpp"
#include "lang/program/program.hpp"
#include "lang/report/report.hpp"
#include "lang/resolve/symbol_index.hpp"

namespace sdlc::test {
namespace {

using namespace lang;

std::string text_of(Span span) { return fmt::format("{}-{}", span.begin, span.end); }

std::string symbols_of(const SymbolTable& table) {
  std::string text = table.tree().file().name() + "\n";
  for (const Symbol& symbol : table.symbols()) {
    text += fmt::format("{} {} at {} in {} hides {} duplicate {}\n", describe(symbol.kind),
                        symbol.name, text_of(symbol.where), text_of(symbol.scope), symbol.hides,
                        symbol.is_duplicate);
  }
  for (const Occurrence& occurrence : table.occurrences()) {
    text += fmt::format("{}: {} {}\n", text_of(occurrence.where), occurrence.symbol.file,
                        occurrence.symbol.index);
  }
  for (const UnknownName& unknown : table.unknown()) {
    text +=
        fmt::format("{}: unknown {}\n", text_of(unknown.where), static_cast<int>(unknown.space));
  }
  return text;
}

}  // namespace

CheckedProgram check_program(Workspace& workspace, const std::filesystem::path& root,
                             const Limits& limits, const StopRequest* stop) {
  std::error_code error;
  const auto document = workspace.load(root, limits.any_file(), error);
  if (!document) return {.diagnostics = error.message(), .symbols = {}};
  const ProgramOptions options{.workspace = &workspace, .limits = limits};
  DiagnosticSink sink(stop), ignored(stop);
  Compiler compiler(*document, options, sink);
  lint(compiler, *document, sink);
  CheckedProgram checked{.diagnostics = render_diagnostics(sink, {}), .symbols = {}};
  if (document->format() != SourceFormat::Scene) return checked;
  Program program(*document, options, ignored);
  const SymbolIndex index(program, ignored);
  for (std::uint32_t i = 0; i < index.file_count(); ++i) {
    checked.symbols += symbols_of(index.table(i));
  }
  return checked;
}

}  // namespace sdlc::test
