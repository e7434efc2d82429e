#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/command_line.hpp"
#include "cli/dispatcher.hpp"
#include "cli/exit_code.hpp"
#include "cli/make_pack.hpp"
#include "cli/outputs.hpp"
#include "cli/scene_options.hpp"
#include "cli/scene_pack.hpp"
#include "cli/usage_error.hpp"
#include "lang/compile/compile.hpp"
#include "lang/text/display_width.hpp"
#include "render/image/atomic_file.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

struct PackOptions {
  SceneOptions scene;
  std::string output;
  bool keeps_existing = false;
  bool quiet = false;
};

class PackJob {
 public:
  PackJob(const PackOptions& options, Environment& env) : options_(options), env_(env) {}

  ExitCode run() {
    const std::string output = output_file();
    const auto scene = read_scene(options_.scene, env_);
    lang::DiagnosticSink sink;
    lang::Compiler compiler(*scene, program_options(options_.scene, env_), sink);
    compiler.check();
    const std::optional<MadePack> made = make_pack(options_.scene, *scene, compiler, sink, env_);
    if (!made) return ExitCode::Findings;
    check_output(output, made->files);
    render::write_file_atomically(output, std::as_bytes(std::span(made->archive)));
    conclude(output, made->files.size() + 1, made->archive.size());
    return ExitCode::Success;
  }

 private:
  std::string output_file() const {
    const fs::path scene = options_.scene.given_name();
    if (scene.empty()) throw UsageError("a scene from `-` requires --stdin-filename NAME");
    if (options_.output.empty()) return scene.stem().string() + kPackExtension;
    // Not `sdlc pack a.scene -o b.scene`.
    if (options_.output.ends_with(".zip")) return options_.output;
    throw UsageError(fmt::format("-o: `{}` is not the name of a pack; packs end in {}",
                                 lang::printable(options_.output), kPackExtension));
  }

  void check_output(const std::string& output, const std::vector<fs::path>& files) const {
    InputSet inputs({options_.scene.file});
    for (const fs::path& file : files) inputs.add(file.string());
    inputs.check_not_in(output);
    if (options_.keeps_existing) check_absent(output);
  }

  void conclude(const std::string& output, std::size_t files, std::size_t bytes) const {
    if (options_.quiet) return;
    env_.err << fmt::format("{}: {} {}, {} bytes\n", lang::printable(output), files,
                            files == 1 ? "file" : "files", bytes);
  }

  const PackOptions& options_;
  Environment& env_;
};

}  // namespace

void add_pack_command(Command& program, Dispatcher& dispatcher) {
  auto options = std::make_shared<PackOptions>();
  Command command =
      program.add_command("pack", "Put a scene and all files that it reads into one file");
  command.add_text("FILE", options->scene.file, "The scene; `-` reads standard input").required();
  add_reading_options(command, options->scene.reading);
  add_diagnostics_options(command, options->scene.diagnostics);
  command.add_text("-o,--output", options->output,
                   "The pack to write; default: FILE's stem with .sdlc.zip");
  command.add_flag("--no-clobber,!--overwrite", options->keeps_existing, "Refuse to replace files");
  command.add_flag("--quiet", options->quiet, "Only diagnostics on standard error");
  command.footer(
      "Examples:\n"
      "  sdlc pack ball.scene\n"
      "  sdlc pack rooms/ball.scene -o farm/ball.sdlc.zip\n"
      "  sdlc render ball.sdlc.zip\n"
      "\n"
      "render, inspect, lint, measure and convert read a pack in the place of its scene, and no "
      "other "
      "file. A scene\nwith errors, or with an import by an absolute path, is not packed, with exit "
      "status 1. docs/pack.md describes\nthe format.");
  dispatcher.on(command, [options](Environment& env) { return PackJob(*options, env).run(); });
}

}  // namespace sdlc::cli
