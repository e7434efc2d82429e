#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/code_filter_options.hpp"
#include "cli/command_line.hpp"
#include "cli/diagnostics_output.hpp"
#include "cli/dispatcher.hpp"
#include "cli/outputs.hpp"
#include "cli/scene_files.hpp"
#include "cli/scene_options.hpp"
#include "cli/scene_pack.hpp"
#include "cli/unified_diff.hpp"
#include "cli/usage_error.hpp"
#include "cli/whole_number.hpp"
#include "lang/allowances/allowances.hpp"
#include "lang/compile/compile.hpp"
#include "lang/lint/fix_text.hpp"
#include "lang/lint/linted_text.hpp"
#include "lang/lint_config/code_filter.hpp"
#include "lang/lint_config/lint_config.hpp"
#include "lang/report/findings.hpp"
#include "lang/report/report.hpp"
#include "lang/text/display_width.hpp"
#include "render/image/atomic_file.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {
namespace {

struct LintOptions {
  std::vector<std::string> arguments;
  ReadingOptions reading;
  DiagnosticsOptions diagnostics;
  lang::CodeFilter filter;
  bool fixes = false;         // --fix
  bool fixes_unsafe = false;  // --unsafe-fixes
  bool shows_diff = false;    // --diff
  lang::LintConfigOptions config;
  std::optional<std::uint64_t> max_warnings;  // over all files; otherwise each config has its own
                                              // limit
  bool quiet = false;
};

std::string plural(std::size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}
std::string plural(std::size_t count, std::string_view noun) {
  return plural(count, noun, std::string(noun) + "s");
}

/// The warnings in the files of one config.
struct WarningCount {
  std::size_t found = 0;
  std::uint64_t allowed = 0;
};

class LintJob {
 public:
  LintJob(const LintOptions& options, Environment& env)
      : options_(options),
        env_(env),
        names_(find_scene_files(options.arguments, env, SceneFiles::ScenesAndConfigs,
                                options.reading.is_sandboxed)),
        configs_(options.config, env.workspace),
        // Fixed text of standard input goes where the findings would go.
        out_(writes_text_to_stdout() ? env.err : env.out),
        writer_(make_writer(options.diagnostics, out_,
                            writes_text_to_stdout() ? env.err_is_terminal : env.out_is_terminal,
                            env)) {}

  ExitCode run() {
    for (const std::string& name : names_) configs_.of(shown_name(name), shown_name(name));
    refuse_wrong_configs();
    for (const std::string& name : names_) lint(name);
    if (!options_.shows_diff) writer_->finish(counts_);
    out_.flush();
    if (!options_.quiet) conclude();
    refuse_wrong_configs();  // for configs of imported files
    if (unreadable_ > 0) return ExitCode::Usage;
    if (options_.shows_diff) return fixed_ == 0 ? ExitCode::Success : ExitCode::Findings;
    return is_clean() ? ExitCode::Success : ExitCode::Findings;
  }

 private:
  bool applies_fixes() const {
    return options_.fixes || options_.fixes_unsafe || options_.shows_diff;
  }
  bool writes_text_to_stdout() const {
    return applies_fixes() && !options_.shows_diff &&
           std::ranges::find(names_, kStandardStream) != names_.end();
  }

  std::string shown_name(const std::string& name) const {
    return name == kStandardStream ? stdin_name(options_.reading) : name;
  }

  void refuse_wrong_configs() const {
    if (configs_.errors().empty()) return;
    throw UsageError(fmt::format("{}", fmt::join(configs_.errors(), "\nerror: ")));
  }

  /// Flags take precedence over configs. `scene` is the file that reads `place`.
  bool wants(const lang::DiagnosticInfo& info, const std::string& place, const std::string& scene) {
    if (const auto answer = options_.filter.answer(info.code)) return *answer;
    return configs_.of(place, scene)
        .wants(info.code, std::filesystem::absolute(place).lexically_normal());
  }

  std::unique_ptr<lang::CheckedText> linted(const std::string& name,
                                            std::shared_ptr<const lang::Document> document) {
    lang::ProgramOptions program = program_options(options_.reading, env_);
    if (pack_) pack_->confine(program);
    using Kind = std::pair<const lang::DiagnosticInfo*, const lang::SourceFile*>;
    const auto is_wanted =
        [this, scene = shown_name(name), own = document.get(), decided = std::map<Kind, bool>()](
            const lang::DiagnosticInfo& info, const lang::SourceFile* file) mutable {
          const auto [answer, is_new] = decided.emplace(Kind(&info, file), false);
          const bool is_own = file == nullptr || file == own;
          if (is_new) answer->second = wants(info, is_own ? scene : file->name(), scene);
          return answer->second;
        };
    // report() limits what is shown, without findings that another file has shown.
    const lang::FindingsFilter filter{.is_wanted = is_wanted,
                                      .max_per_severity = std::numeric_limits<std::size_t>::max()};
    return std::make_unique<lang::LintedText>(std::move(document), program, filter);
  }

  void lint(const std::string& name) {
    try {
      if (applies_fixes() && !options_.shows_diff) refuse_special(name, env_);
      pack_ = open_pack(name, options_.reading.limits, env_.workspace);
      if (pack_ && applies_fixes()) {
        throw render::IoError("fix", name, "it is a pack; fix its scene, and pack that again");
      }
      auto document =
          pack_ ? pack_->read_scene()
                : read_document(name, shown_name(name), env_, options_.reading.limits.any_file());
      if (!options_.shows_diff) writer_->enter(shown_name(name));
      const std::unique_ptr<lang::CheckedText> result =
          applies_fixes() ? fix(name, std::move(document)) : linted(name, std::move(document));
      if (!options_.shows_diff) report(*result, shown_name(name));
    } catch (const render::IoError& error) {
      ++unreadable_;
      if (!options_.shows_diff) writer_->fail(shown_name(name), error.what());
      env_.err << fmt::format("error: {}\n", lang::printable(error.what()));
    }
  }

  std::unique_ptr<lang::CheckedText> fix(const std::string& name,
                                         std::shared_ptr<const lang::Document> document) {
    const std::string original(document->text());
    const auto check = [&](std::string text) {
      const std::string shown = shown_name(name);
      return linted(name, std::make_shared<const lang::Document>(shown, std::move(text)));
    };
    lang::FixResult result =
        lang::fix_text(linted(name, std::move(document)), options_.fixes_unsafe, check);
    const std::string fixed(result.checked->file().text());
    if (options_.shows_diff) {
      env_.out << unified_diff(shown_name(name), original, fixed);
    } else if (name == kStandardStream) {
      env_.out << fixed << std::flush;
    } else if (fixed != original) {
      render::write_file_atomically(name, std::as_bytes(std::span(fixed)));
    }
    if (!options_.quiet) print_guesses(shown_name(name), result.guesses);
    fixed_ += result.applied;
    refused_ += result.refused;
    if (result.applied > 0) ++fixed_files_;
    return std::move(result.checked);
  }

  void print_guesses(const std::string& place, const std::vector<lang::Guess>& guesses) {
    for (const lang::Guess& guess : guesses) {
      env_.err << fmt::format("guess: {}:{}:{}: {}: {}\n", lang::printable(place), guess.where.line,
                              guess.where.column, guess.info->code, lang::printable(guess.change));
    }
  }

  /// Prints each finding once, even if several of the files read its text.
  void report(const lang::CheckedText& linted, const std::string& place) {
    lang::DiagnosticCounts counts = linted.findings().counts;
    std::size_t other_warnings = counts.warnings;  // those not kept
    lang::DiagnosticCounts shown;
    for (const lang::Diagnostic* diagnostic : linted.findings().shown) {
      const bool is_error = diagnostic->info->severity == lang::Severity::Error;
      if (!is_error) --other_warnings;
      if (!reported_.insert(identity(*diagnostic)).second) {
        --(is_error ? counts.errors : counts.warnings);
        continue;
      }
      if (++(is_error ? shown.errors : shown.warnings) > lang::FindingsFilter::kMaxShown) {
        ++counts.omitted;
      } else {
        writer_->write(*diagnostic);
      }
      count_fixes(*diagnostic);
      const lang::SourceFile* file = diagnostic->where.file;
      const bool is_own = file == nullptr || file == &linted.file();
      if (!is_error) count_warnings(is_own ? place : file->name(), place, 1);
    }
    count_warnings(place, place, other_warnings);
    counts_ += counts;
  }

  void count_warnings(const std::string& place, const std::string& scene, std::size_t count) {
    const lang::LintConfig& config = configs_.of(place, scene);
    WarningCount& warnings = warnings_[&config];
    warnings.found += count;
    warnings.allowed = config.max_warnings.value_or(0);
  }

  bool is_clean() const {
    if (counts_.errors > 0) return false;
    if (options_.max_warnings) return counts_.warnings <= *options_.max_warnings;
    return std::ranges::all_of(
        warnings_, [](const auto& each) { return each.second.found <= each.second.allowed; });
  }

  /// Finds each path once: there may be a hundred thousand findings.
  const std::string& path_of(const std::string& name) {
    const auto [path, is_new] = paths_.try_emplace(name);
    if (is_new) path->second = env_.workspace.identity(name).string();
    return path->second;
  }

  std::string identity(const lang::Diagnostic& diagnostic) {
    const auto& [file, span] = diagnostic.where;
    const std::string path = file == nullptr ? "" : path_of(file->name());
    return fmt::format("{}\n{} {} {} {}", path, span.begin, span.end, diagnostic.info->code,
                       diagnostic.message);
  }

  void count_fixes(const lang::Diagnostic& diagnostic) {
    if (diagnostic.fixes.empty()) return;
    const bool is_safe = std::ranges::all_of(diagnostic.fixes, &lang::Fix::is_safe);
    ++(is_safe ? safe_fixes_ : unsafe_fixes_);
  }

  void conclude() {
    if (fixed_ > 0) {
      env_.err << fmt::format("{} {} in {}\n", options_.shows_diff ? "would fix" : "fixed",
                              plural(fixed_, "finding"), plural(fixed_files_, "file"));
    }
    if (refused_ > 0) {
      env_.err << fmt::format(
          "{} not applied: there would be more errors, or a string or comment would change\n",
          plural(refused_, "fix", "fixes"));
    }
    if (options_.shows_diff || options_.diagnostics.format != "human") return;
    if (counts_ == lang::DiagnosticCounts{} && unreadable_ == 0) {
      env_.err << fmt::format("{} checked, nothing found\n", plural(names_.size(), "file"));
    }
    if (safe_fixes_ > 0 && !applies_fixes()) {
      env_.err << fmt::format("{} can be fixed with --fix\n", plural(safe_fixes_, "finding"));
    }
    if (unsafe_fixes_ > 0 && !options_.fixes_unsafe) {
      env_.err << fmt::format("{} can be fixed with --unsafe-fixes; check the result\n",
                              plural(unsafe_fixes_, "finding"));
    }
  }

  const LintOptions& options_;
  Environment& env_;
  std::vector<std::string> names_;
  lang::LintConfigs configs_;
  std::ostream& out_;
  std::unique_ptr<lang::DiagnosticWriter> writer_;
  std::shared_ptr<ScenePack> pack_;           // of the file that is being checked
  std::map<std::string, std::string> paths_;  // by name
  std::unordered_set<std::string> reported_;
  lang::DiagnosticCounts counts_;
  std::map<const lang::LintConfig*, WarningCount> warnings_;
  std::size_t unreadable_ = 0;
  std::size_t fixed_ = 0, fixed_files_ = 0;
  std::size_t refused_ = 0;                        // fixes
  std::size_t safe_fixes_ = 0, unsafe_fixes_ = 0;  // of the remaining findings
};

}  // namespace

void add_lint_command(Command& program, Dispatcher& dispatcher) {
  auto options = std::make_shared<LintOptions>();
  Command command = program.add_command("lint", "Report mistakes in scenes without rendering them");
  command
      .add_texts("FILE", options->arguments,
                 "Scenes, JSON configs, or folders of them; `-` reads standard input")
      .required();
  add_reading_options(command, options->reading);
  add_diagnostics_options(command, options->diagnostics);
  add_code_filter(command, options->filter);
  command.add_flag("--fix", options->fixes,
                   "Apply the safe fixes, and report what is left; fixed standard input goes to "
                   "standard output");
  command.add_flag("--unsafe-fixes", options->fixes_unsafe,
                   "Also apply guesses, such as the nearest name");
  command.add_flag("--diff", options->shows_diff,
                   "Write nothing; show the changes of --fix or --unsafe-fixes as a patch");
  add_whole_number(
      command, "--max-warnings", {},
      [options](std::uint64_t count) { options->max_warnings = count; },
      "Succeed with up to this many warnings; default: 0");
  const Option config =
      command
          .add_text("--config", options->config.file,
                    "Settings for all files; default: the nearest .sdlc.toml of each")
          .type_name("FILE");
  command.add_flag("--no-config", options->config.is_unused, "Ignore .sdlc.toml files")
      .excludes(config);
  command.add_flag("--quiet", options->quiet, "Only findings");
  command.footer(
      "Examples:\n"
      "  sdlc lint ball.scene\n"
      "  sdlc lint scenes/ old-config.json --format concise\n"
      "  sdlc lint ball.scene --fix\n"
      "  sdlc lint scenes/ --fix --diff\n"
      "  sdlc lint scenes/ --select E --ignore E213\n"
      "  cat ball.scene | sdlc lint - --stdin-filename ball.scene --format json\n"
      "\n"
      "Findings go to standard output. In folders it checks .scene files and .json files that look "
      "like\n"
      "configs. A file without a camera, background or settings is treated as a part of others. "
      "`sdlc explain CODE`\n"
      "explains a finding. Exit status: 0 nothing found, 1 findings, 2 a file cannot be read or "
      "written.");
  dispatcher.on(command, [options](Environment& env) {
    options->config.is_sandboxed = options->reading.is_sandboxed;
    return LintJob(*options, env).run();
  });
}

}  // namespace sdlc::cli
