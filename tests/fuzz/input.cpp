#include "tests/fuzz/input.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/format/format.hpp"
#include "lang/program/program.hpp"
#include "lang/report/report.hpp"

namespace sdlc::test {
namespace {

void require(bool condition, const char* claim) {
  if (condition) return;
  std::fprintf(stderr, "not so: %s\n", claim);
  std::abort();
}

void check_place(const lang::Location& where) {
  if (where.file == nullptr) return;
  require(where.span.begin <= where.span.end, "a span begins before it ends");
  require(where.span.end <= where.file->text().size(), "a span lies inside its text");
}

void check_places(const lang::Diagnostic& diagnostic) {
  check_place(diagnostic.where);
  for (const lang::Label& label : diagnostic.labels) check_place(label.where);
  for (const lang::Fix& fix : diagnostic.fixes) check_place(fix.where);
  for (const lang::ChainLink& link : diagnostic.chain) check_place(link.where);
}

constexpr lang::Limits kSmallLimits{.steps = 200'000,
                                    .memory = std::uint64_t{64} << 20,
                                    .objects = 2'000,
                                    .string = 10'000,
                                    .include_depth = 4,
                                    .file = 1 << 20};

/// Formatting preserves the meaning and is idempotent. `format_file` throws otherwise.
void check_formatting(const lang::Document& file) {
  lang::DiagnosticSink sink;
  const auto once = lang::format_file(file, sink);
  require(once.has_value() != sink.has_errors(), "a text without errors is formatted");
  if (!once) return;
  const lang::Document formatted(file.name(), *once);
  require(lang::format_file(formatted, sink) == once, "what is formatted stays as it is");
  const auto line = static_cast<std::uint32_t>(file.text().size() % 7);
  lang::format_file(file, sink, lang::LineRange{line, line + 2});
}

}  // namespace

void run_fuzz_input(std::string_view text, lang::SourceFormat format) {
  static const lang::DiskFileSystem files;
  const bool is_scene = format == lang::SourceFormat::Scene;
  const std::string name =
      std::string(SDLC_SOURCE_DIR) + (is_scene ? "/examples/fuzz.scene" : "/examples/fuzz.json");
  const lang::Document file(name, std::string(text));
  lang::Workspace workspace(files);
  lang::DiagnosticSink sink;
  lang::Compiler compiler(
      file, {.workspace = &workspace, .limits = kSmallLimits, .is_sandboxed = true, .sets = {}},
      sink);
  const std::optional<lang::LoweredScene> lowered = compiler.lower({});
  require(lowered.has_value() != sink.has_errors(), "a scene is made, or an error is reported");
  compiler.read_all_files();
  if (is_scene) check_formatting(file);

  for (const lang::Diagnostic& diagnostic : sink.diagnostics()) check_places(diagnostic);
  for (const auto style :
       {lang::MessageFormat::Human, lang::MessageFormat::Concise, lang::MessageFormat::Json}) {
    const std::string told = lang::render_diagnostics(sink, {.format = style, .color = true});
    require(told.empty() == (sink.diagnostics().empty() && style != lang::MessageFormat::Json),
            "what was reported is told");
  }
}

}  // namespace sdlc::test
