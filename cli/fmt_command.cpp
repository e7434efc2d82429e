#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "cli/command_line.hpp"
#include "cli/diagnostics_output.hpp"
#include "cli/dispatcher.hpp"
#include "cli/outputs.hpp"
#include "cli/scene_files.hpp"
#include "cli/scene_options.hpp"
#include "cli/unified_diff.hpp"
#include "cli/usage_error.hpp"
#include "cli/whole_number.hpp"
#include "lang/format/format.hpp"
#include "lang/program/program.hpp"
#include "lang/text/display_width.hpp"
#include "render/image/atomic_file.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {
namespace {

struct FmtOptions {
  std::vector<std::string> arguments;
  std::string stdin_filename;
  lang::Limits limits;
  DiagnosticsOptions diagnostics;
  std::optional<lang::LineRange> lines;
  bool checks = false;      // --check
  bool shows_diff = false;  // --diff
  bool quiet = false;
};

/// `A:B`, two lines counted from 1.
lang::LineRange parse_lines(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) {
    throw ArgumentError("--range",
                        fmt::format("takes FIRST:LAST, not `{}`", lang::printable(text)));
  }
  const auto line = [](const std::string& number) {
    return static_cast<std::uint32_t>(
        parse_whole_number("--range", number, {.lowest = 1, .highest = UINT32_MAX}));
  };
  const lang::LineRange lines{line(text.substr(0, colon)), line(text.substr(colon + 1))};
  if (lines.first > lines.last) {
    throw ArgumentError("--range", "the first line must not be after the last");
  }
  return lines;
}

class FmtJob {
 public:
  FmtJob(const FmtOptions& options, Environment& env)
      : options_(options),
        env_(env),
        names_(find_scene_files(options.arguments, env, SceneFiles::Scenes)),
        writer_(make_writer(options.diagnostics, env.err, env.err_is_terminal, env)) {}

  ExitCode run() {
    if (options_.lines && names_.size() > 1) {
      throw UsageError("--range: only possible for a single file");
    }
    for (const std::string& name : names_) refuse_json(name, {name, ""});
    for (const std::string& name : names_) visit(name);
    if (counts_.errors > 0) writer_->finish(counts_);
    env_.out.flush();
    if (!options_.quiet) conclude();
    if (unreadable_ > 0) return ExitCode::Usage;
    return counts_.errors > 0 || (changed_ > 0 && only_reports()) ? ExitCode::Findings
                                                                  : ExitCode::Success;
  }

 private:
  bool only_reports() const { return options_.checks || options_.shows_diff; }

  static void refuse_json(const std::string& name, const lang::Document& file) {
    if (name == kStandardStream && file.text().empty()) return;
    if (file.format() == lang::SourceFormat::Scene) return;
    throw UsageError(fmt::format("`{}` is a JSON config, and `fmt` is for .scene files",
                                 lang::printable(file.name())));
  }

  void visit(const std::string& name) {
    try {
      const bool is_stdin = name == kStandardStream;
      const std::string shown =
          !is_stdin ? name
                    : (options_.stdin_filename.empty() ? "<stdin>" : options_.stdin_filename);
      if (!only_reports()) refuse_special(name, env_);
      const auto document = read_document(name, shown, env_, options_.limits.file);
      const lang::Document& file = *document;
      refuse_json(name, file);
      lang::DiagnosticSink sink;
      if (!lang::check_file_size(file, options_.limits, sink)) return leave_alone(shown, sink);
      if (const auto formatted = lang::format_file(file, sink, options_.lines)) {
        settle(name, shown, file.text(), *formatted);
      } else {
        leave_alone(shown, sink);
      }
    } catch (const render::IoError& error) {
      ++unreadable_;
      env_.err << fmt::format("error: {}\n", lang::printable(error.what()));
    }
  }

  void settle(const std::string& name, const std::string& shown, std::string_view text,
              const std::string& formatted) {
    const bool is_changed = text != formatted;
    if (options_.shows_diff) {
      show_diff(shown, text, formatted);
    } else if (options_.checks) {
      if (is_changed) env_.out << (env_.out_is_terminal ? lang::printable(shown) : shown) << '\n';
    } else if (name == kStandardStream) {
      env_.out << formatted;
    } else if (is_changed) {
      render::write_file_atomically(name, std::as_bytes(std::span(formatted)));
      if (!options_.quiet) env_.err << fmt::format("formatted {}\n", lang::printable(shown));
    }
    if (is_changed) ++changed_;
  }

  void show_diff(const std::string& shown, std::string_view text, const std::string& formatted) {
    const std::string diff = unified_diff(shown, text, formatted);
    if (!wants_color(options_.diagnostics, env_.out_is_terminal, env_)) {
      env_.out << diff;
      return;
    }
    std::string_view rest = diff;
    while (!rest.empty()) {
      const std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(line.size() + 1);
      const std::string_view color = line.starts_with("@@") ? "\x1b[36m"
                                     : line.starts_with("---") || line.starts_with("+++")
                                         ? "\x1b[1m"
                                     : line.starts_with('-') ? "\x1b[31m"
                                     : line.starts_with('+') ? "\x1b[32m"
                                                             : "";
      env_.out << color << line << (color.empty() ? "\n" : "\x1b[0m\n");
    }
  }

  void leave_alone(const std::string& shown, const lang::DiagnosticSink& sink) {
    const auto is_error = [](const lang::DiagnosticInfo& info, const lang::SourceFile*) {
      return info.severity == lang::Severity::Error;
    };
    const lang::Findings findings = select_findings(sink, {.is_wanted = is_error});
    for (const lang::Diagnostic* diagnostic : findings.shown) writer_->write(*diagnostic);
    counts_ += findings.counts;
    left_alone_.push_back(shown);
  }

  void conclude() {
    for (const std::string& name : left_alone_) {
      env_.err << fmt::format("unchanged because of errors: {}\n", lang::printable(name));
    }
    if (only_reports() && changed_ > 0) {
      env_.err << fmt::format("{} file{} would be formatted\n", changed_, changed_ == 1 ? "" : "s");
    }
  }

  const FmtOptions& options_;
  Environment& env_;
  std::vector<std::string> names_;
  std::unique_ptr<lang::DiagnosticWriter> writer_;
  lang::DiagnosticCounts counts_;
  std::vector<std::string> left_alone_;
  std::size_t changed_ = 0;
  std::size_t unreadable_ = 0;
};

}  // namespace

void add_fmt_command(Command& program, Dispatcher& dispatcher) {
  auto options = std::make_shared<FmtOptions>();
  Command command = program.add_command("fmt", "Format scenes in the canonical layout");
  command
      .add_texts("FILE", options->arguments,
                 "Scenes and folders of them; `-` formats standard input to standard output")
      .required();
  command.add_flag("--check", options->checks, "Only list the files that would change");
  command.add_flag("--diff", options->shows_diff,
                   "Only show the changes, as a patch; replaces the list of --check");
  command
      .add_text(
          "--range", [options](const std::string& text) { options->lines = parse_lines(text); },
          "Only format the statements that touch these lines, counted from 1")
      .type_name("FIRST:LAST");
  command.add_text("--stdin-filename", options->stdin_filename,
                   "Name of a scene from standard input in messages");
  add_limit_option(command, options->limits);
  add_diagnostics_options(command, options->diagnostics);
  command.add_flag("--quiet", options->quiet, "Only errors on standard error");
  command.footer(
      "Examples:\n"
      "  sdlc fmt ball.scene\n"
      "  sdlc fmt scenes/ --check\n"
      "  sdlc fmt scenes/ --diff | patch -p0\n"
      "  sdlc fmt - --range 12:20 --stdin-filename ball.scene <ball.scene\n"
      "\n"
      "Files are written completely or not at all, and only if they change. Files with syntax "
      "errors are\n"
      "left unchanged. docs/format.md describes the layout. Exit status: 0 done, or nothing to "
      "do;\n"
      "1 syntax errors, or with --check and --diff files that would change; 2 a file cannot be "
      "read\n"
      "or written.");
  dispatcher.on(command, [options](Environment& env) { return FmtJob(*options, env).run(); });
}

}  // namespace sdlc::cli
