#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/command_line.hpp"
#include "cli/diagnostics_output.hpp"
#include "cli/dispatcher.hpp"
#include "cli/outputs.hpp"
#include "cli/scene_files.hpp"
#include "cli/scene_options.hpp"
#include "cli/scene_pack.hpp"
#include "cli/usage_error.hpp"
#include "cli/whole_number.hpp"
#include "lang/allowances/allowances.hpp"
#include "lang/convert/convert.hpp"
#include "lang/object/check.hpp"
#include "lang/report/report.hpp"
#include "lang/source/sandbox.hpp"
#include "lang/text/display_width.hpp"
#include "render/image/atomic_file.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 2> kSourceFormats{"scene", "json"};

std::string_view name_of(lang::SourceFormat format) {
  return kSourceFormats[format == lang::SourceFormat::Scene ? 0 : 1];
}

struct ConvertCommandOptions {
  std::vector<std::string> inputs;
  std::string output;
  std::string to;
  bool is_strict = false;
  bool overwrites = false;
  bool quiet = false;
  lang::ConvertOptions conversion;
  std::vector<lang::SetOption> sets;
  ReadingOptions reading;
  DiagnosticsOptions diagnostics;
};

/// A file to convert.
struct Input {
  std::string name;                ///< `-` for standard input
  std::optional<fs::path> folder;  ///< the folder in which it was found, if only the folder was
                                   ///< named
};

std::vector<Input> find_inputs(const std::vector<std::string>& arguments, const Environment& env,
                               bool is_sandboxed) {
  std::vector<Input> inputs;
  std::set<std::string> names;
  for (const std::string& argument : arguments) {
    std::error_code ignored;
    const bool is_folder = fs::is_directory(argument, ignored);
    for (const std::string& name :
         find_scene_files({argument}, env, SceneFiles::ScenesAndConfigs, is_sandboxed)) {
      if (!names.insert(name).second) continue;
      std::optional<fs::path> folder;
      if (is_folder) folder = fs::path(argument).lexically_normal();
      inputs.push_back({name, std::move(folder)});
    }
  }
  return inputs;
}

class ConvertJob {
 public:
  ConvertJob(const ConvertCommandOptions& options, Environment& env)
      : options_(options),
        env_(env),
        inputs_(find_inputs(options.inputs, env, options.reading.is_sandboxed)),
        writer_(make_writer(options.diagnostics, env.err, env.err_is_terminal, env)) {
    std::error_code ignored;
    const bool is_one_file = inputs_.size() == 1 && !inputs_.front().folder;
    writes_folder_ = !options.output.empty() && options.output != kStandardStream &&
                     (!is_one_file || options.output.ends_with('/') ||
                      fs::is_directory(options.output, ignored));
    if (options.output == kStandardStream && inputs_.size() > 1) {
      throw UsageError("-o -: several texts cannot share standard output; name a folder");
    }
    for (const Input& input : inputs_) {
      // Skip files that already have the target format; they may be replaced.
      const bool is_done =
          input.folder && fs::path(input.name).extension() == fmt::format(".{}", options.to);
      if (!is_done) read_.add(input.name);
    }
  }

  ExitCode run() {
    for (const Input& input : inputs_) {
      try {
        convert(input);
      } catch (const render::IoError& error) {
        fail(error.what());
      }
    }
    writer_->finish(counts_);
    if (inputs_.size() > 1 && reports_progress()) {
      env_.err << fmt::format("{} of {} converted\n", converted_,
                              converted_ + refused_ + unusable_);
    }
    return unusable_ > 0 ? ExitCode::Usage : refused_ > 0 ? ExitCode::Findings : ExitCode::Success;
  }

 private:
  bool reports_progress() const {
    return !options_.quiet && options_.diagnostics.format == "human";
  }

  /// Reports a failure to read or write a file.
  void fail(std::string_view reason) {
    ++unusable_;
    env_.err << fmt::format("error: {}\n", lang::printable(reason));
  }

  void convert(const Input& input) {
    pack_ = open_pack(input.name, options_.reading.limits, env_.workspace);
    const std::string shown = input.name == kStandardStream ? stdin_name(options_.reading)
                              : pack_                       ? pack_->scene()
                                                            : input.name;
    const auto document =
        pack_ ? pack_->read_scene()
              : read_document(input.name, shown, env_, options_.reading.limits.any_file());
    const lang::Document& file = *document;
    if (name_of(file.format()) == options_.to) {
      if (!input.folder)
        fail(fmt::format("`{}` already has the format of --to {}", shown, options_.to));
      return;
    }

    const std::optional<fs::path> target = target_of(input, file.format());
    if (target && !may_write(*target, file.format())) return;
    const std::optional<std::string> text = convert(file);
    if (!text) {
      ++refused_;
    } else if (read_.contains(target ? target->string() : kStandardStream)) {
      fail(fmt::format("`{}` is an input file and would be overwritten",
                       target ? target->string() : "standard output"));
    } else if (target) {
      const render::ParentFolders folders(*target);
      render::write_file_atomically(*target, std::as_bytes(std::span(*text)));
      ++converted_;
      if (reports_progress()) {
        env_.err << fmt::format("{} -> {}\n", lang::printable(shown),
                                lang::printable(target->string()));
      }
    } else {
      env_.out << *text;
      ++converted_;
    }
  }

  std::optional<std::string> convert(const lang::Document& file) {
    lang::DiagnosticSink sink;
    lang::ProgramOptions program = program_options(options_.reading, env_);
    if (pack_) pack_->confine(program);
    program.sets = options_.sets;
    lang::Conversion conversion(file, program, sink);
    std::optional<std::string> text = conversion.run(options_.conversion);
    for (const fs::path& part : conversion.dependencies()) read_.add(part.string());
    const lang::Findings findings = select_unallowed(sink);
    for (const lang::Diagnostic* diagnostic : findings.shown) writer_->write(*diagnostic);
    counts_ += findings.counts;
    const std::size_t avoidable = findings.counts.warnings - conversion.forced_warnings();
    if (!text || !options_.is_strict || avoidable == 0) return text;
    env_.err << fmt::format("error: {} has warnings, which --strict treats as errors\n",
                            lang::printable(file.name()));
    return std::nullopt;
  }

  /// The output file; nullopt for standard output.
  std::optional<fs::path> target_of(const Input& input, lang::SourceFormat format) const {
    const bool is_stdin = input.name == kStandardStream;
    if (options_.output == kStandardStream) return std::nullopt;
    if (is_stdin && options_.output.empty()) return std::nullopt;
    if (!options_.output.empty() && !writes_folder_) return options_.output;

    fs::path path = is_stdin ? fs::path(stdin_name(options_.reading)) : fs::path(input.name);
    // Beside the pack.
    if (pack_) path.replace_filename(fs::path(pack_->scene()).filename());
    fs::path name = path;
    if (writes_folder_) {
      name = fs::path(options_.output) /
             (input.folder ? path.lexically_relative(*input.folder) : path.filename());
    }
    return name.replace_extension(format == lang::SourceFormat::Scene ? ".json" : ".scene");
  }

  bool may_write(const fs::path& target, lang::SourceFormat source) {
    const std::string shown = target.string();
    const bool is_wrong_name = !options_.output.empty() && !writes_folder_ &&
                               target.extension() == fmt::format(".{}", name_of(source));
    if (is_wrong_name) {
      fail(fmt::format("`{}` has the extension of the input format", shown));
      return false;
    }
    // The folder of an untrusted scene may contain untrusted links.
    if (options_.reading.is_sandboxed && options_.output.empty() &&
        !lang::Sandbox(env_.workspace, target).resolve(target)) {
      fail(
          fmt::format("`{}` is outside the scene's folder, which --sandbox refuses; use -o to "
                      "choose another place",
                      shown));
      return false;
    }
    if (!targets_.insert(render::written_path(target).string()).second) {
      fail(fmt::format("`{}` would be written twice", shown));
      return false;
    }
    // A file named by -o may be replaced; other existing files may not.
    if (options_.output.empty() && !options_.overwrites && fs::exists(target)) {
      fail(fmt::format("`{}` exists already; use --overwrite to replace it, or -o for another name",
                       shown));
      return false;
    }
    return true;
  }

  const ConvertCommandOptions& options_;
  Environment& env_;
  std::vector<Input> inputs_;
  bool writes_folder_ = false;
  std::unique_ptr<lang::DiagnosticWriter> writer_;
  lang::DiagnosticCounts counts_;
  std::shared_ptr<ScenePack> pack_;  // of the file that is being converted
  std::set<std::string> targets_;
  InputSet read_;
  std::size_t converted_ = 0;
  std::size_t refused_ = 0;   // texts with errors, or that the other format cannot represent
  std::size_t unusable_ = 0;  // files that could not be read or written
};

void add_choice_options(Command& command, lang::ConvertOptions& options) {
  const auto properties = lang::kind_info(lang::ObjectKind::Render).properties;
  command.add_text("--camera", options.camera, "The camera to convert, if there are several");
  command
      .add_text("--tone", options.tone,
                "Replaces the scene's own; a config supports sqrt and linear")
      .one_of(properties[lang::render_property::kTone].words);
  add_whole_number(
      command, "--frame", {.highest = static_cast<std::uint64_t>(lang::kMaxWholeNumber)},
      [&options](std::uint64_t frame) { options.frame = static_cast<int>(frame); },
      "The frame of a film to convert");
}

}  // namespace

void add_convert_command(Command& program, Dispatcher& dispatcher) {
  auto options = std::make_shared<ConvertCommandOptions>();
  Command command =
      program.add_command("convert", "Convert JSON configs to scenes, and scenes to configs");
  command
      .add_texts("IN", options->inputs,
                 "Scenes, JSON configs, or folders of them; `-` reads standard input")
      .required();
  command.add_text("-o,--output", options->output,
                   "Output file; for several inputs a folder, which mirrors the tree; `-`: "
                   "standard output. Default: next to IN, with the other extension");
  command.add_text("--to", options->to, "The format to convert to; default: the other one")
      .one_of(kSourceFormats);
  command.add_flag(
      "--strict", options->is_strict,
      "Write nothing if there are warnings, except those about keys that configs must have");
  command.add_flag("--overwrite", options->overwrites,
                   "Replace existing files that -o does not name");
  add_choice_options(command, options->conversion);
  add_set_option(command, options->sets);
  add_reading_options(command, options->reading);
  add_diagnostics_options(command, options->diagnostics);
  command.add_flag("--quiet", options->quiet, "Only diagnostics on standard error");
  command.footer(
      "Examples:\n"
      "  sdlc convert old.json                    to old.scene\n"
      "  sdlc convert old.json -o -               to standard output\n"
      "  sdlc convert configs/ -o scenes/         everything in a folder, recursively\n"
      "  sdlc convert ring.scene --tone sqrt      to ring.json, if the format supports it\n"
      "  sdlc convert film.scene --frame 12 -o frame.json\n"
      "\n"
      "Both render to the same picture. docs/convert.md has the details. Exit status: 0 all "
      "converted,\n"
      "1 a file has errors or cannot be represented in the other format, 2 a file cannot be read "
      "or written.");
  dispatcher.on(command, [options](Environment& env) { return ConvertJob(*options, env).run(); });
}

}  // namespace sdlc::cli
