#include "render/tiles/render.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/diagnostics_output.hpp"
#include "cli/dispatcher.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/statistics.hpp"
#include "cli/usage_error.hpp"
#include "cli/version.hpp"
#include "cli/words.hpp"
#include "lang/compile/compile.hpp"
#include "lang/lower/scene_builder.hpp"
#include "lang/schema/schema.hpp"
#include "render/image/atomic_file.hpp"
#include "render/image/image.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kProgressWords{"auto", "plain", "json", "none"};

struct RenderOptions {
  std::string file;
  std::string stdin_filename;
  std::vector<std::string> outputs;
  lang::Overrides overrides;
  DiagnosticsOptions diagnostics;
  std::string progress = "auto";
  std::string stats;
  bool ppm_text = false;
  bool keeps_existing = false;  // --no-clobber
  bool quiet = false;
};

/// A picture file to be written.
struct Output {
  std::string path;  ///< "-": the standard output, as PNG
  render::ImageFormat format;
};

lang::SourceFile read_source(const RenderOptions& options, const Environment& env) {
  const bool is_stdin = options.file == "-";
  const std::string name = !is_stdin                        ? options.file
                           : options.stdin_filename.empty() ? "<stdin>"
                                                            : options.stdin_filename;
  std::error_code error;
  std::optional<std::string> text = env.files.read(options.file, error);
  if (!text) throw render::IoError("read", name, error.message());
  return lang::SourceFile(name, std::move(*text));
}

/// The pictures to write: those of the command line, else the scene's, else FILE's stem.
std::vector<Output> choose_outputs(const RenderOptions& options, const std::string& of_scene) {
  std::vector<std::string> paths = options.outputs;
  if (paths.empty() && !of_scene.empty()) {
    render::make_parent_folders(of_scene);
    paths.push_back(of_scene);
  }
  if (paths.empty()) {
    const std::string& name = options.file == "-" ? options.stdin_filename : options.file;
    if (name.empty()) throw UsageError("a scene from `-` needs -o OUT or --stdin-filename NAME");
    paths.push_back(fs::path(name).stem().string() + ".png");
  }

  std::vector<Output> outputs;
  for (const std::string& path : paths) {
    if (path == "-") {
      outputs.push_back({.path = path, .format = render::ImageFormat::Png});
      continue;
    }
    const auto format = render::image_format_of(path);
    if (!format) {
      const std::string extension = fs::path(path).extension().string();
      const auto known = render::image_extensions();
      const auto written = std::string_view(extension).substr(extension.empty() ? 0 : 1);
      throw render::IoError(
          "write", path,
          fmt::format("{}; known are {}{}",
                      extension.empty() ? std::string("the name has no extension")
                                        : fmt::format("unknown extension `{}`", extension),
                      fmt::join(known, " "), did_you_mean(written, known)));
    }
    if (options.keeps_existing && fs::exists(path)) {
      throw render::IoError("write", path, "the file exists and --no-clobber was given");
    }
    render::check_writable(path);
    outputs.push_back({.path = path, .format = *format});
  }
  return outputs;
}

/// Refuses a picture that the machine cannot hold before any of it is allocated.
void check_memory(const render::RenderSettings& settings) {
  const auto pixels =
      static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
  // The picture, its 32-bit copy and the encoded file.
  const std::size_t bytes = pixels * (sizeof(render::LinearRgb) + 2 * 3 * sizeof(float));
  if (bytes > physical_memory_bytes()) throw std::bad_alloc();
}

fs::path partial_name(const fs::path& path) {
  return path.parent_path() /
         fs::path(path.stem().string() + ".partial" + path.extension().string());
}

/// Writes every picture; returns the names as told to the user.
std::vector<std::string> write_pictures(const std::vector<Output>& outputs,
                                        const RenderOptions& options,
                                        const lang::LoweredScene& lowered,
                                        const render::RenderResult& result, Environment& env) {
  const render::RenderSettings& settings = lowered.settings;
  std::vector<std::string> names;
  for (const Output& output : outputs) {
    const render::WriteOptions write{
        .format = output.format,
        .tone = lowered.output.tone,
        .ppm_text = options.ppm_text,
        .metadata = {.software = fmt::format("sdlc {}", kVersion),
                     .entries = {{"sdlc:samples", fmt::to_string(settings.samples)},
                                 {"sdlc:depth", fmt::to_string(settings.depth)},
                                 {"sdlc:seed", fmt::to_string(settings.seed)}}}};
    if (output.path == "-") {
      const auto bytes = render::encode_picture(result.picture, write, "standard output");
      env.out.write(reinterpret_cast<const char*>(bytes.data()),
                    static_cast<std::streamsize>(bytes.size()));
      if (!env.out.flush()) throw render::IoError("write", "standard output", "the write failed");
      names.emplace_back("standard output");
      continue;
    }
    const fs::path path = result.is_complete ? fs::path(output.path) : partial_name(output.path);
    render::write_picture(path, result.picture, write);
    names.push_back(path.string());
  }
  return names;
}

ProgressStyle progress_style(const RenderOptions& options, const Environment& env) {
  if (options.quiet || options.progress == "none") return ProgressStyle::None;
  if (options.progress == "json") return ProgressStyle::Json;
  if (options.progress == "plain" || !env.err_is_terminal) return ProgressStyle::Plain;
  return ProgressStyle::Line;
}

void write_stats(const std::string& path, const std::string& json, Environment& env) {
  const std::string line = json + "\n";
  if (path == "-") {
    env.out << line << std::flush;
  } else {
    render::write_file_atomically(path, std::as_bytes(std::span(line)));
  }
}

ExitCode run_render(const RenderOptions& options, Environment& env) {
  lang::DiagnosticSink sink;
  RenderStatistics statistics;
  const auto read_start = std::chrono::steady_clock::now();
  const auto seconds_since = [](auto start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  // The text is given back before the picture needs memory; diagnostics have quoted what they need
  // of it.
  auto source = std::make_optional<lang::SourceFile>(read_source(options, env));
  const double read_seconds = seconds_since(read_start);
  auto lowered = lang::compile(*source, options.overrides, sink, statistics.compile);
  statistics.compile.parse_seconds += read_seconds;
  statistics.scene = source->name();
  print_diagnostics(sink, options.diagnostics, env.err, env.err_is_terminal, env);
  source.reset();
  if (!lowered) return ExitCode::Findings;

  const std::vector<Output> outputs = choose_outputs(options, lowered->output.output);
  if (!options.stats.empty() && options.stats != "-") render::check_writable(options.stats);
  check_memory(lowered->settings);
  statistics.settings = lowered->settings;
  statistics.spheres = lowered->scene.spheres.size();
  statistics.features = required_features(lowered->scene);

  render::RenderMonitor monitor;
  monitor.on_tracing = [&] {
    statistics.render_rss_bytes = resident_bytes();  // before the codec adds its own
    render::preload_image_codec();
  };
  const render::RenderSettings& settings = lowered->settings;
  const std::uint64_t total = static_cast<std::uint64_t>(settings.width) *
                              static_cast<std::uint64_t>(settings.height) *
                              static_cast<std::uint64_t>(settings.samples);
  const InterruptGuard interrupt(monitor.cancel);
  const render::RenderResult result = [&] {
    const ProgressReporter progress(progress_style(options, env), monitor, total, env.err);
    return render::render(std::move(lowered->scene), settings, monitor);
  }();

  const auto write_start = std::chrono::steady_clock::now();
  const std::vector<std::string> written = write_pictures(outputs, options, *lowered, result, env);
  statistics.write_seconds = seconds_since(write_start);
  if (!options.stats.empty()) write_stats(options.stats, to_json(statistics, result), env);

  if (result.nonfinite_samples > 0) {
    env.err << fmt::format("error: a defect in sdlc: {} samples are not finite and were left out\n",
                           result.nonfinite_samples);
  }
  const bool is_quiet = options.quiet || options.progress == "none";
  if (!result.is_complete) {
    env.err << fmt::format("interrupted after {} of {} samples; what there is was saved as {}\n",
                           format_count(static_cast<double>(result.camera_samples)),
                           format_count(static_cast<double>(total)), fmt::join(written, ", "));
    return ExitCode::Interrupted;
  }
  if (!is_quiet) {
    env.err << fmt::format(
        "{}: {} x {} pixels, {} sample{}, {} ({} samples/s)\n", fmt::join(written, ", "),
        settings.width, settings.height, settings.samples, settings.samples == 1 ? "" : "s",
        format_seconds(result.render_seconds),
        format_count(static_cast<double>(result.camera_samples) / result.render_seconds));
  }
  return result.nonfinite_samples > 0 ? ExitCode::Defect : ExitCode::Success;
}

/// The property that a flag overrides is where its help and its words come from.
const lang::Property& render_property(std::size_t index) {
  return lang::kind_info(lang::ObjectKind::Render).properties[index];
}

template <typename T>
CLI::Option* add_override(CLI::App& command, std::size_t property_index, std::optional<T>& value) {
  const lang::Property& property = render_property(property_index);
  CLI::Option* option =
      command.add_option(fmt::format("--{}", property.name), value, std::string(property.doc));
  if (property.range == lang::Range::AtLeastOne) option->check(CLI::Range(1, 1000000000));
  const bool is_number = property.type == lang::Type::WholeNumber;
  if (is_number && property.range != lang::Range::AtLeastOne) {
    option->check(CLI::NonNegativeNumber);
  }
  if (!property.words.empty()) option->check(one_of(property.words));
  return option;
}

}  // namespace

void add_render_command(CLI::App& app, Dispatcher& dispatcher) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command =
      app.add_subcommand("render", "Render a .scene or a .json config to a picture");
  command->add_option("FILE", options->file, "The scene; `-` reads standard input")->required();
  command
      ->add_option("-o,--output", options->outputs,
                   "A picture to write, by its extension (may be repeated; `-`: PNG to standard "
                   "output). Default: the scene's own, else FILE's stem with .png")
      ->take_all()
      ->expected(1);
  {
    using namespace lang::render_property;
    lang::Overrides& overrides = options->overrides;
    add_override(*command, kWidth, overrides.width);
    add_override(*command, kHeight, overrides.height);
    add_override(*command, kSamples, overrides.samples);
    add_override(*command, kDepth, overrides.depth);
    add_override(*command, kSeed, overrides.seed);
    add_override(*command, kThreads, overrides.threads);
    add_override(*command, kTone, overrides.tone);
    add_override(*command, kCamera, overrides.camera);
  }
  command->add_flag("--ppm-text", options->ppm_text, "Write PPM as decimal numbers");
  command->add_flag("--no-clobber,!--overwrite", options->keeps_existing,
                    "Refuse to replace files");
  command->add_option("--progress", options->progress, "How progress is told, on standard error")
      ->check(one_of(kProgressWords));
  command->add_option("--stats", options->stats,
                      "Write figures about the render to this file, as JSON; `-`: standard output");
  command->add_option("--stdin-filename", options->stdin_filename,
                      "What a scene from standard input is called in messages");
  command->add_flag("--quiet", options->quiet, "Nothing on standard error but diagnostics");
  add_diagnostics_options(*command, options->diagnostics);
  command->footer(
      "Examples:\n"
      "  sdlc render ball.scene\n"
      "  sdlc render ball.scene -o ball.png -o ball.exr --samples 256\n"
      "  sdlc render config.json --width 320 --samples 16 --progress none --stats stats.json\n"
      "  cat ball.scene | sdlc render - -o - > ball.png\n\n"
      "png jpg tiff webp ppm gif hold 8-bit codes after the scene's tone curve; exr and hdr hold "
      "linear\n"
      "radiance. --width or --height alone keeps the aspect, both together set a new one. Ctrl-C "
      "saves what\n"
      "there is as NAME.partial.EXT; a second one ends at once.");
  dispatcher.on(command, [options](Environment& env) { return run_render(*options, env); });
}

}  // namespace sdlc::cli
