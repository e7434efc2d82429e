#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/amounts.hpp"
#include "cli/command_line.hpp"
#include "cli/dispatcher.hpp"
#include "cli/exit_code.hpp"
#include "cli/interrupt.hpp"
#include "cli/kernel_options.hpp"
#include "cli/machine.hpp"
#include "cli/measure/details.hpp"
#include "cli/measure/measurement_data.hpp"
#include "cli/measure/notes.hpp"
#include "cli/measure/work_folder.hpp"
#include "cli/outputs.hpp"
#include "cli/override_options.hpp"
#include "cli/report/report.hpp"
#include "cli/report_failure.hpp"
#include "cli/scene_options.hpp"
#include "cli/shell_quote.hpp"
#include "cli/usage_error.hpp"
#include "cli/version.hpp"
#include "cli/whole_number.hpp"
#include "lang/allowances/allowances.hpp"
#include "lang/compile/compile.hpp"
#include "lang/object/check.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/nearest_name.hpp"
#include "render/image/atomic_file.hpp"
#include "render/image/image.hpp"
#include "render/image/io_error.hpp"
#include "render/math/clock.hpp"
#include "render/measure/study.hpp"
#include "render/scene/digest.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kMeasurementFormats{"human", "json", "csv"};

struct MeasureOptions {
  SceneOptions scene;
  std::vector<std::string> outputs;
  lang::Overrides overrides;
  render::KernelRequest kernel;
  double budget_seconds = 60;
  std::optional<int> frame;
  std::string format = "human";
  std::string against;
  std::string work;
  bool sweeps_threads = false;
  bool quiet = false;
  render::GivenFlags given;
};

/// The flags of this command line that a render of the same picture needs too.
render::GivenFlags given_flags(const Command& command) {
  // Flags about measuring, and those that a recommendation contains itself.
  static constexpr std::array<std::string_view, 12> kOwn{
      "--help", "--format", "--color",   "--output", "--budget",         "--against",
      "--work", "--quiet",  "--samples", "--error",  "--stdin-filename", "--threads-sweep"};
  const std::vector<GivenFlag> flags = command.given_flags();
  std::vector<std::string> configuration_flags;
  render::GivenFlags given;
  render::for_each_configuration_setting([&](const auto& setting) {
    const std::string flag = render::flag_of(setting.name);
    configuration_flags.push_back(flag);
    if (std::ranges::count(flags, flag, &GivenFlag::name) > 0) {
      given.of_configuration.emplace_back(setting.name);
    }
  });
  for (const GivenFlag& flag : flags) {
    const std::string& name = flag.name;
    if (std::ranges::count(kOwn, name) || std::ranges::count(configuration_flags, name)) continue;
    for (const std::string& value : flag.values) {
      if (!given.others.empty()) given.others += ' ';
      given.others += name == "--frame" ? "--frames" : name;
      if (flag.takes_value) given.others += ' ' + shell_quoted(value);
    }
  }
  return given;
}

/// "html", "json" or "csv".
std::string format_of(const fs::path& report) {
  const std::string extension = report.extension().string();
  return extension.empty() ? extension : extension.substr(1);
}

/// Rejects reports that would replace `input`.
void check_kept(const std::vector<std::string>& reports, const fs::path& input,
                std::string_view what) {
  const InputSet inputs({input.string()});
  for (const fs::path report : reports) {
    // Any measurement may be interrupted, and then writes a partial report.
    for (const fs::path& name : {report, partial_name(report)}) {
      // The file may not exist yet.
      const bool is_same = render::written_path(name) == render::written_path(input);
      if (!is_same && !inputs.contains(name.string())) continue;
      throw UsageError(fmt::format("-o: `{}` is {}, and would be overwritten{}",
                                   lang::printable(name.string()), what,
                                   name == report ? "" : " by a partial report"));
    }
  }
}

void check_reports(const MeasureOptions& options) {
  static constexpr std::array<std::string_view, 3> kExtensions{"html", "json", "csv"};
  OutputSet distinct;
  for (const std::string& name : options.outputs) {
    if (name == kStandardStream) {
      throw UsageError("-o -: --format selects the report on standard output; name a file");
    }
    const std::string format = format_of(name);
    if (!std::ranges::count(kExtensions, format)) {
      throw UsageError(fmt::format("-o: `{}` is not a report; reports are .html, .json and .csv{}",
                                   lang::printable(name), lang::did_you_mean(format, kExtensions)));
    }
    render::check_writable(name);
    distinct.add(name);
  }
  check_kept(options.outputs, options.scene.disk_file(), "the scene that is measured");
  if (!options.against.empty()) {
    check_kept(options.outputs, options.against, "the report of --against");
  }
  if (!options.work.empty()) {
    check_kept(options.outputs, fs::path(options.work) / WorkFolder::kStudyName, "kept by --work");
  }
}

void check_supported(const MeasureOptions& options) {
  if (options.overrides.seconds) {
    throw UsageError("--time is for `render`; use --budget to limit the time of the measurement");
  }
  if (options.overrides.is_adaptive) {
    throw UsageError("--adaptive cannot be measured: the number of samples differs per pixel");
  }
}

/// Rejects a picture that does not fit into memory, before anything is rendered.
void check_memory(const render::RenderSettings& settings) {
  // Three pictures, the reference's spread, FLIP's colours of two, and the report's maps.
  constexpr std::size_t kBytesPerPixel =
      3 * sizeof(render::LinearRgb) + 2 * sizeof(render::PixelSpread) + 24 * sizeof(float);
  const auto pixels =
      static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
  if (pixels * kBytesPerPixel > physical_memory_bytes()) throw std::bad_alloc();
}

/// Prints the current step on standard error.
class StudyProgress {
 public:
  StudyProgress(bool is_quiet, Environment& env) : is_quiet_(is_quiet), env_(env) {}
  ~StudyProgress() {
    if (has_line_) env_.err << "\r\x1b[K" << std::flush;
  }
  StudyProgress(const StudyProgress&) = delete;
  StudyProgress& operator=(const StudyProgress&) = delete;

  void show(const std::string& step, double share) {
    if (is_quiet_) return;
    const std::string text = fmt::format("{:3.0f} %  {}", 100 * share, step);
    if (env_.err_is_terminal) {
      env_.err << '\r' << text << "\x1b[K" << std::flush;
      has_line_ = true;
    } else {
      env_.err << text << std::endl;
    }
  }

 private:
  bool is_quiet_;
  Environment& env_;
  bool has_line_ = false;
};

class MeasureJob {
 public:
  MeasureJob(const MeasureOptions& options, Environment& env)
      : options_(options), env_(env), machine_(describe_machine()) {}

  ExitCode run() {
    check_supported(options_);
    check_reports(options_);
    read_earlier();
    std::optional<lang::LoweredScene> lowered = lower();
    if (!lowered) return ExitCode::Findings;
    const render::RenderSettings& settings = lowered->settings;
    render::check_picture_size(settings.width, settings.height, render::ImageFormat::Png,
                               options_.scene.name());
    check_memory(settings);
    scene_digest_ = fmt::format("{:016x}", render::digest_of(lowered->scene));
    check_earlier(settings);
    // Until here there is nothing to save, and a signal may end the process.
    std::atomic<bool> interrupted{false};
    const InterruptGuard guard(interrupted);
    const bool is_complete = study(*lowered);
    if (ledger_.nonfinite_samples > 0) {
      env_.err << fmt::format("error: {} samples are not finite and were left out\n",
                              ledger_.nonfinite_samples);
    }
    if (!is_complete) return finish_interrupted(settings);
    ExitCode code = write(settings, true);
    if (interrupted.load()) {
      env_.err << "interrupted; the measurement was finished\n";
      code = graver(ExitCode::Interrupted, code);
    }
    const bool have_same = std::ranges::all_of(ledger_.threads, &render::ThreadProbe::is_same);
    return ledger_.nonfinite_samples > 0 || !have_same ? ExitCode::Defect : code;
  }

 private:
  void read_earlier() {
    if (options_.against.empty()) return;
    const auto document = read_document(options_.against, options_.against, env_);
    try {
      earlier_ = read_measurement(document->text());
    } catch (const std::exception& error) {
      throw render::IoError("use", options_.against, error.what());
    }
  }

  std::optional<lang::LoweredScene> lower() {
    const auto start = std::chrono::steady_clock::now();
    const auto source = read_scene(options_.scene, env_);
    lang::DiagnosticSink sink;
    lang::Compiler compiler(*source, program_options(options_.scene, env_), sink);
    if (options_.frame && !compiler.animation() && !sink.has_errors()) {
      throw UsageError("--frame: the scene has no `animation`, so all frames are the same");
    }
    lang::Overrides overrides = options_.overrides;
    overrides.instancing = instancing_for(options_.kernel, overrides);
    overrides.names_output = true;
    auto lowered = compiler.lower(overrides, options_.frame);
    const double seconds = render::seconds_since(start);
    for (const fs::path& part : compiler.dependencies()) {
      check_kept(options_.outputs, part, "a part of the scene");
    }
    std::optional<render::Kernel> kernel;
    if (lowered) kernel = choose_kernel(options_.kernel, overrides, *lowered, compiler);
    print_findings(select_unallowed(sink), options_.scene.diagnostics, env_.err,
                   env_.err_is_terminal, env_);
    if (!lowered) return lowered;
    check_not_refused(*kernel);
    request_ = options_.kernel;
    request_.precision = lowered->precision;
    request_.may_take_double = !overrides.has(lang::render_property::kPrecision);
    machine_.emplace_back("instruction set", instruction_set(*kernel));
    machine_.emplace_back("kernel", name_of(*kernel));
    read_seconds_ = seconds;
    return lowered;
  }

  void check_earlier(const render::RenderSettings& settings) const {
    if (!earlier_) return;
    const auto fail = [&](const std::string& what) {
      throw UsageError(
          fmt::format("--against: `{}` cannot be compared: it is a report of another {}",
                      lang::printable(options_.against), what));
    };
    if (earlier_->provenance.scene_digest != scene_digest_) fail("scene");
    const render::Measurement& before = earlier_->measurement;
    if (before.full_width != settings.width || before.full_height != settings.height) {
      fail(fmt::format("size ({} × {})", before.full_width, before.full_height));
    }
  }

  /// The values that must be unchanged to resume a measurement.
  Json identity(const lang::LoweredScene& lowered) const {
    const render::RenderSettings& settings = lowered.settings;
    Json json{
        {"version", full_version()},
        {"scene", scene_digest_},
        {"width", settings.width},
        {"height", settings.height},
        {"samples", settings.samples},
        {"threads", settings.threads},
        {"threads_sweep", options_.sweeps_threads},
        {"tone", name_of(lowered.output.mapping.tone)},
        {"exposure", lowered.output.mapping.exposure},
        {"precision", request_.precision ? std::string(name_of(*request_.precision)) : "auto"}};
    render::for_each_setting([&](const auto& setting) {
      json[std::string(setting.name)] = render::shown(settings.*setting.member);
    });
    for (const auto& [name, value] : machine_) json[name] = value;
    return json;
  }

  static std::string full_version() { return fmt::format("{} ({})", kVersion, kCommit); }

  /// Returns false if it was interrupted.
  bool study(const lang::LoweredScene& lowered) {
    details_.emplace(lowered.output.mapping);
    std::optional<render::ReferencePicture> reference;
    if (!options_.work.empty()) {
      work_.emplace(options_.work, identity(lowered));
      work_->load(ledger_, reference, *details_);
    }
    render::RenderMonitor monitor;
    const InterruptGuard interrupt(monitor.cancel);
    StudyProgress progress(options_.quiet, env_);
    const render::StudyObserver observer{
        .on_task = [&](const std::string& step, double share) { progress.show(step, share); },
        .on_reference =
            [&](const render::ReferencePicture& picture) {
              measure_other_seconds(picture.picture, lowered);
              if (work_) work_->save(picture);
            },
        .on_picture =
            [&](const render::Configuration& configuration, int samples,
                const render::Picture& picture, const render::ReferencePicture& compared) {
              details_->add(configuration, samples, picture, compared);
            },
        .on_progress =
            [&](const render::StudyLedger& ledger) {
              if (work_) work_->save(ledger, *details_);
            }};
    render::Study study(lowered.scene, lowered.settings, request_, study_options(lowered.settings),
                        ledger_, observer, monitor);
    study.run(std::move(reference));
    return !monitor.cancel.load();
  }

  render::StudyOptions study_options(const render::RenderSettings& settings) const {
    render::StudyOptions options{.budget_seconds = options_.budget_seconds,
                                 .goal = settings.error,
                                 .sweeps_threads = options_.sweeps_threads};
    // Errors are only comparable at the size of the earlier measurement.
    if (earlier_) options.size = {earlier_->measurement.width, earlier_->measurement.height};
    return options;
  }

  /// Determines the time to read the scene, which was measured, and to encode a picture of full
  /// size. The codec is loaded once, independent of the size.
  void measure_other_seconds(const render::Picture& picture, const lang::LoweredScene& lowered) {
    const auto seconds_to_encode = [&](const render::Picture& any) {
      const auto start = std::chrono::steady_clock::now();
      render::encode_picture(any, {.mapping = lowered.output.mapping});
      return render::seconds_since(start);
    };
    const double loading = seconds_to_encode(render::Picture(1, 1));
    const double area = static_cast<double>(lowered.settings.width) * lowered.settings.height /
                        static_cast<double>(picture.pixels.size());
    ledger_.other_seconds = read_seconds_ + loading + seconds_to_encode(picture) * area;
  }

  Report report_of(const render::Measurement& measurement) const {
    Report report{.measurement = measurement,
                  .provenance = {.scene = lang::printable(options_.scene.name()),
                                 .version = full_version(),
                                 .command = quoted_command(),
                                 .scene_digest = scene_digest_,
                                 .machine = machine_}};
    details_->fill(report);
    report.notes = notes_of(measurement);
    if (earlier_) report.against = compare_with_earlier(measurement, report.provenance, *earlier_);
    return report;
  }

  std::string quoted_command() const {
    std::string command = "sdlc";
    for (const std::string& argument : env_.arguments) command += " " + shell_quoted(argument);
    return command;
  }

  /// Writes the report to standard output and to the files. The result depends on the comparison
  /// with the earlier report.
  ExitCode write(const render::RenderSettings& settings, bool is_complete) {
    ExitCode code = ExitCode::Success;
    render::Measurement measurement = measurement_of(ledger_, settings, study_options(settings));
    measurement.is_complete = is_complete;
    measurement.given = options_.given;
    add_flags(measurement);
    const Report report = report_of(measurement);
    const auto text_of = [&](std::string_view format) {
      if (format == "html") return html_report(report);
      if (format == "json") return to_json(report);
      if (format == "csv") return to_csv(measurement);
      return text_report(report);
    };
    for (const fs::path path : options_.outputs) {
      const fs::path name = is_complete ? path : partial_name(path);
      const std::string text = text_of(format_of(path));
      try {
        render::write_file_atomically(name, std::as_bytes(std::span(text)));
        written_.push_back(lang::printable(name.string()));
      } catch (const render::IoError& error) {  // the other files may be writable
        env_.err << fmt::format("error: {}\n", lang::printable(error.what()));
        code = graver(code, exit_code_of(error));
      }
    }
    if (is_complete || options_.outputs.empty()) env_.out << text_of(options_.format);
    if (!report.against) return code;
    if (report.against->points.empty()) {
      env_.err << fmt::format("error: no comparison with `{}`: {}\n",
                              lang::printable(options_.against),
                              fmt::join(report.against->notes, "; "));
      return ExitCode::Usage;
    }
    const bool is_worse =
        report.against->worse_errors > 0 || report.against->time == render::Verdict::Worse;
    return graver(code, is_worse ? ExitCode::Findings : ExitCode::Success);
  }

  ExitCode finish_interrupted(const render::RenderSettings& settings) {
    ExitCode code = ExitCode::Interrupted;
    if (!ledger_.points.empty()) code = graver(code, write(settings, false));
    env_.err << "interrupted";
    if (ledger_.points.empty()) env_.err << " before the first point was measured";
    for (std::size_t i = 0; i < written_.size(); ++i) {
      env_.err << (i == 0 ? "; the partial report was saved as " : ", ") << written_[i];
    }
    env_.err << (work_ ? fmt::format("; run the same command to resume from {}\n",
                                     lang::printable(options_.work))
                       : "; use --work FOLDER to make a measurement resumable\n");
    return code;
  }

  const MeasureOptions& options_;
  Environment& env_;
  std::vector<std::pair<std::string, std::string>> machine_;
  std::vector<std::string> written_;
  std::optional<EarlierMeasurement> earlier_;
  render::KernelRequest request_;
  std::string scene_digest_;
  double read_seconds_ = 0;
  render::StudyLedger ledger_;
  std::optional<Details> details_;
  std::optional<WorkFolder> work_;
};

}  // namespace

void add_measure_command(Command& program, Dispatcher& dispatcher) {
  auto options = std::make_shared<MeasureOptions>();
  Command command = program.add_command(
      "measure", "Measure the error of a scene's picture against render time on this machine");
  add_scene_options(command, options->scene);
  command.remove_option("--format");
  command.add_text("--format", options->format, "Format of the report on standard output")
      .one_of(kMeasurementFormats);
  command.add_repeated("-o,--output", options->outputs,
                       "A report to write, by its extension: html, json or csv (may be repeated)");
  command
      .add_text(
          "--budget",
          [options](const std::string& text) {
            options->budget_seconds = parse_duration("--budget", text);
          },
          "Time limit of the measurement, such as `5min`; default: 1min")
      .type_name("T");
  command.add_text("--against", options->against,
                   "Compare with this earlier report (.json); exit status 1 if worse");
  command.add_text("--work", options->work,
                   "Save all results in this folder, so that the same command can resume");
  command.add_flag("--threads-sweep", options->sweeps_threads,
                   "Also measure the time with 1, 2, 3, 4, 6 … threads, up to --threads");
  add_whole_number(
      command, "--frame", {.highest = static_cast<std::uint64_t>(lang::kMaxWholeNumber)},
      [options](std::uint64_t frame) { options->frame = static_cast<int>(frame); },
      "The frame to measure; default: the first of the scene's animation");
  add_override_options(command, options->overrides);
  add_kernel_options(command, options->kernel);
  command.add_flag("--quiet", options->quiet, "Only diagnostics on standard error");
  command.footer(
      "Examples:\n"
      "  sdlc measure ball.scene\n"
      "  sdlc measure ball.scene --budget 5min -o ball.html -o ball.json\n"
      "  sdlc measure ball.scene --threads-sweep\n"
      "  sdlc measure ball.scene --error 1% --format json | jq '.recommendations[].flags'\n"
      "  sdlc measure ball.scene --budget 1h --work ball.work -o ball.html   # Ctrl-C, and again\n"
      "  sdlc measure ball.scene -o new.json --against old.json\n\n"
      "Renders the scene in several configurations, and compares each picture with a long "
      "reference.\n"
      "--error is the goal of the recommendation. docs/measure.md explains the report.");
  dispatcher.on(command, [options, command](Environment& env) {
    options->given = given_flags(command);
    enter_pack(options->scene, env);
    return MeasureJob(*options, env).run();
  });
}

}  // namespace sdlc::cli
