#include "cli/make_pack.hpp"

#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "cli/diagnostics_output.hpp"
#include "cli/scene_pack.hpp"
#include "lang/allowances/allowances.hpp"
#include "lang/pack/collect_files.hpp"
#include "lang/pack/pack.hpp"
#include "lang/text/display_width.hpp"

namespace sdlc::cli {
namespace {

void report(const SceneOptions& options, const lang::DiagnosticSink& sink, Environment& env) {
  print_findings(select_unallowed(sink), options.diagnostics, env.err, env.err_is_terminal, env);
}

/// Reads the pack as another machine will: what is missing in it is missing here.
bool is_sound(const std::string& archive, const SceneOptions& options, Environment& env) {
  ScenePack pack(options.name() + kPackExtension, lang::read_pack(archive, options.reading.limits));
  const auto scene = pack.read_scene();
  lang::ProgramOptions program = program_options(options, env);
  pack.confine(program);
  lang::DiagnosticSink sink;
  lang::Compiler compiler(*scene, program, sink);
  compiler.read_all_files();
  if (sink.has_errors()) report(options, sink, env);
  return !sink.has_errors();
}

}  // namespace

std::optional<MadePack> make_pack(const SceneOptions& options, const lang::Document& scene,
                                  lang::Compiler& compiler, lang::DiagnosticSink& sink,
                                  Environment& env) {
  compiler.read_all_files();
  report(options, sink, env);
  if (sink.has_errors()) return std::nullopt;
  sink.clear();
  try {
    lang::CollectedFiles collected = lang::collect_files(scene, compiler.program(), env.workspace);
    MadePack made{.archive = lang::write_pack(collected.pack), .files = std::move(collected.files)};
    if (const std::uint64_t max = options.reading.limits.any_file(); made.archive.size() > max) {
      throw lang::ZipError(
          fmt::format("it would have more than {} bytes; `--limit data=N` allows more", max));
    }
    if (!is_sound(made.archive, options, env)) return std::nullopt;
    return made;
  } catch (const lang::ZipError& error) {
    env.err << fmt::format("error: cannot pack `{}`: {}\n", lang::printable(options.name()),
                           lang::printable(error.what()));
    return std::nullopt;
  }
}

}  // namespace sdlc::cli
