#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/amounts.hpp"
#include "cli/aov_option.hpp"
#include "cli/command_line.hpp"
#include "cli/dispatcher.hpp"
#include "cli/exit_code.hpp"
#include "cli/farm_folder.hpp"
#include "cli/farm_plan.hpp"
#include "cli/frames_option.hpp"
#include "cli/kernel_options.hpp"
#include "cli/make_pack.hpp"
#include "cli/override_options.hpp"
#include "cli/render_options.hpp"
#include "cli/scene_options.hpp"
#include "cli/usage_error.hpp"
#include "cli/whole_number.hpp"
#include "lang/allowances/allowances.hpp"
#include "lang/compile/compile.hpp"
#include "lang/pack/pack.hpp"
#include "lang/text/display_width.hpp"
#include "render/image/image.hpp"
#include "render/image/io_error.hpp"
#include "render/math/clock.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

struct FarmOptions {
  RenderOptions render;
  std::vector<GivenFlag> given;
  std::string engine;
  std::string folder;
  std::string extension;
  std::string image = "sdlc";
  double task_seconds = 300;
  std::optional<std::size_t> tasks;
};

constexpr std::array<std::string_view, 2> kStatusFormats{"human", "json"};

struct FarmStatusOptions {
  std::string folder;
  std::string format = "human";
};

/// The flags of a render of the same pictures, or of a merge.
std::vector<std::string> repeated_flags(const std::vector<GivenFlag>& given, bool is_merge) {
  static constexpr std::array<std::string_view, 11> kOwn{
      "--help",  "--engine", "--output", "--task-time", "--tasks",    "--image",
      "--quiet", "--frames", "--format", "--color",     "--extension"};
  std::vector<std::string> flags;
  for (const GivenFlag& flag : given) {
    if (is_merge ? flag.name != "--aov" : std::ranges::count(kOwn, flag.name) > 0) continue;
    for (const std::string& value : flag.values) {
      flags.push_back(flag.name);
      if (flag.takes_value) flags.push_back(value);
    }
  }
  return flags;
}

/// The stem of the scene's name without what is special in names of outputs and in lists.
std::string picture_stem(const std::string& scene) {
  std::string stem = fs::path(scene).stem().string();
  for (char& c : stem) {
    const bool is_control = static_cast<unsigned char>(c) < ' ' || c == '\x7f';
    if (is_control || c == '#' || c == '{' || c == '}') c = '_';
  }
  return stem;
}

class FarmPlanner {
 public:
  FarmPlanner(const FarmOptions& options, Environment& env) : options_(options), env_(env) {}

  ExitCode run() {
    check_names();
    compile();
    choose_frames();
    if (!make_pack()) return ExitCode::Findings;
    auto lowered = lower();
    if (!lowered) return ExitCode::Findings;
    describe_job(*lowered);
    if (const std::optional<FarmJob> earlier = earlier_job()) {
      keep_division(*earlier);
    } else {
      divide(*lowered);
    }
    check_task_count(job_);
    write();
    return ExitCode::Success;
  }

 private:
  void check_names() {
    if (options_.render.scene.file.empty()) throw UsageError("FILE is required");
    if (options_.render.scene.file == kStandardStream) {
      throw UsageError("a farm renders a scene from a file, not from `-`");
    }
    job_.name = picture_stem(options_.render.scene.file);
    job_.scene = job_.name + kPackExtension;
    job_.folder = absolute_path(options_.folder);
    job_.engine = static_cast<FarmEngine>(std::ranges::find(kFarmEngineWords, options_.engine) -
                                          kFarmEngineWords.begin());
    const std::string folder = job_.folder.string();
    if (job_.engine == FarmEngine::OpenJd && (has_frame_mark(folder) || has_name_mark(folder))) {
      throw UsageError(fmt::format("-o: {} and {} in `{}` would be replaced; name another folder",
                                   kFrameMark, kNameMark, lang::printable(folder)));
    }
  }

  void compile() {
    const auto start = render::Clock::now();
    source_ = read_scene(options_.render.scene, env_);
    compiler_.emplace(*source_, program_options(options_.render.scene, env_), sink_);
    animation_ = compiler_->animation();
    compile_seconds_ = render::seconds_since(start);
  }

  void choose_frames() {
    if (sink_.has_errors()) return;
    if (!animation_) {
      if (!options_.render.frames) return;
      throw UsageError("--frames: the scene has no `animation`, so all frames are the same");
    }
    const FrameRange all{
        .first = animation_->first, .last = animation_->last, .step = animation_->step};
    job_.frames = frames_of(options_.render.frames.value_or(std::vector{all}));
  }

  /// All tasks read the same pack, whatever becomes of the scene. Returns false if there are
  /// errors.
  bool make_pack() {
    const SceneOptions& scene = options_.render.scene;
    if (scene.pack) {
      std::error_code error;
      const auto bytes =
          env_.workspace.read(scene.disk_file(), scene.reading.limits.any_file(), error);
      if (!bytes) throw render::IoError("read", scene.disk_file(), error);
      pack_ = *bytes;
      return true;
    }
    std::optional<MadePack> made = cli::make_pack(scene, *source_, *compiler_, sink_, env_);
    if (made) pack_ = std::move(made->archive);
    return made.has_value();
  }

  /// The middle frame.
  std::optional<lang::LoweredScene> lower() {
    const auto start = render::Clock::now();
    std::optional<int> frame;
    if (!job_.frames.empty()) frame = job_.frames[job_.frames.size() / 2];
    lang::Overrides overrides = options_.render.overrides;
    overrides.instancing = instancing_for(options_.render.kernel, overrides);
    overrides.names_output = true;
    auto lowered = compiler_->lower(overrides, frame);
    if (lowered) {
      kernel_ = choose_kernel(options_.render.kernel, overrides, *lowered, *compiler_);
    }
    print_findings(select_unallowed(sink_), options_.render.scene.diagnostics, env_.err,
                   env_.err_is_terminal, env_);
    if (!lowered) return lowered;
    check_goals(overrides, *lowered);
    check_not_refused(kernel_);
    compile_seconds_ += render::seconds_since(start);
    return lowered;
  }

  std::string choose_extension(const lang::LoweredScene& lowered) const {
    if (!options_.extension.empty()) return options_.extension;
    if (options_.render.aovs.any()) return "exr";
    const std::string extension = fs::path(lowered.output.output).extension().string();
    const bool is_picture = render::image_format_of(lowered.output.output).has_value();
    return is_picture ? extension.substr(1) : "png";
  }

  void describe_job(const lang::LoweredScene& lowered) {
    const render::RenderSettings& settings = lowered.settings;
    job_.extension = choose_extension(lowered);
    job_.flags = repeated_flags(options_.given, false);
    job_.merge_flags = repeated_flags(options_.given, true);
    job_.width = settings.width;
    job_.height = settings.height;
    job_.task_seconds = options_.tasks ? 0 : options_.task_seconds;
    job_.image = options_.image;
    const fs::path picture = job_.folder / picture_pattern(job_);
    // Containers have a program of their own.
    const render::ImageFormat format = job_.engine == FarmEngine::Kubernetes
                                           ? picture_format(picture, "write")
                                           : output_format(picture);
    render::check_picture_size(settings.width, settings.height, format, picture);
    check_aovs(options_.render.aovs, {{.path = picture, .format = format}}, settings);
    max_shards_ = max_farm_shards(settings);
    const std::string folder = job_.folder.string();
    if (job_.engine == FarmEngine::Kubernetes && folder.find(':') != std::string::npos) {
      throw UsageError(fmt::format("no volume can be mounted as `{}`, which has a colon; rename it",
                                   lang::printable(folder)));
    }
  }

  /// The job that is in the folder already.
  std::optional<FarmJob> earlier_job() const {
    std::error_code error;
    if (!fs::exists(job_.folder / kFarmFileName, error)) {
      if (!fs::exists(job_.folder, error) || fs::is_empty(job_.folder)) return std::nullopt;
      throw render::IoError("use", job_.folder,
                            "it holds other files; name a new or an empty folder");
    }
    FarmJob earlier = read_farm_job(job_.folder);
    std::string other = difference(earlier, job_);
    if (other.empty() && !has_same_pack()) other = "the scene has changed";
    if (other.empty()) return earlier;
    throw render::IoError("use", job_.folder,
                          fmt::format("it has the job of other pictures: {}; name another folder, "
                                      "or remove this one to start again",
                                      other));
  }

  /// Compares the files in the packs: another zlib may compress them otherwise.
  bool has_same_pack() const {
    const lang::Limits& limits = options_.render.scene.reading.limits;
    try {
      const lang::Pack earlier = lang::read_pack(read_farm_file(job_, job_.scene), limits);
      const lang::Pack now = lang::read_pack(pack_, limits);
      return earlier.scene == now.scene && earlier.files == now.files;
    } catch (const lang::ZipError& error) {
      throw render::IoError("use", job_.folder / job_.scene, error.what());
    }
  }

  /// Pictures and parts of the earlier job remain usable.
  void keep_division(const FarmJob& earlier) {
    job_.frames_per_task = earlier.frames_per_task;
    job_.shards = earlier.shards;
    job_.task_seconds = earlier.task_seconds;
    if (options_.tasks) {
      FarmJob wanted = job_;
      wanted.frames_per_task = 1;
      wanted.shards = 0;
      divide_into(wanted, *options_.tasks, max_shards_);
      if (wanted.shards != job_.shards || wanted.frames_per_task != job_.frames_per_task) {
        throw render::IoError("use", job_.folder,
                              fmt::format("its job is divided into {}; name another folder, or "
                                          "remove this one to start again",
                                          describe_division(job_)));
      }
    }
    say(fmt::format("the folder has this job already: {}", describe_division(job_)));
  }

  void divide(lang::LoweredScene& lowered) {
    if (options_.tasks) {
      divide_into(job_, *options_.tasks, max_shards_);
      say(describe_division(job_));
      return;
    }
    const FarmProbe measured =
        probe(std::move(kernel_), lowered, compile_seconds_, !job_.frames.empty());
    cli::divide(job_, measured, max_shards_);
    say(fmt::format("{}\n{}", measured.description, describe_division(job_)));
  }

  void write() {
    const FarmRun run{.tasks = all_tasks(job_)};
    std::vector<FarmFile> files{{.name = job_.scene, .content = std::move(pack_)},
                                {.name = kFarmFileName, .content = farm_text(job_)}};
    for (FarmFile& file : farm_files(job_, run)) files.push_back(std::move(file));
    make_farm_folders(job_);
    write_farm_files(job_, files);
    say(fmt::format("start: {}", lang::printable(start_command(job_, run))));
  }

  void say(const std::string& text) {
    if (!options_.render.quiet) env_.err << text << "\n";
  }

  const FarmOptions& options_;
  Environment& env_;
  FarmJob job_;
  lang::DiagnosticSink sink_;
  std::shared_ptr<const lang::Document> source_;
  std::optional<lang::Compiler> compiler_;
  std::optional<lang::Animation> animation_;
  render::Kernel kernel_;
  std::string pack_;
  double compile_seconds_ = 0;
  std::uint32_t max_shards_ = 0;
};

void add_farm_status_command(Command& farm, Dispatcher& dispatcher) {
  auto options = std::make_shared<FarmStatusOptions>();
  Command command = farm.add_command(
      "status", "Report what of a job is there, and write job files for what is missing");
  command.add_text("FOLDER", options->folder, "The folder of the job").required();
  command.add_text("--format", options->format, "Format of the report on standard output")
      .one_of(kStatusFormats);
  command.footer(
      "A damaged file is renamed to NAME.damaged, so that its task renders it again.\n"
      "Exit status: 0 all pictures are there, 75 some are not.");
  dispatcher.on(command, [options](Environment& env) {
    return report_farm_status(options->folder, options->format == "json", env);
  });
}

}  // namespace

void add_farm_command(Command& program, Dispatcher& dispatcher) {
  auto options = std::make_shared<FarmOptions>();
  RenderOptions& render = options->render;
  Command command = program.add_command(
      "farm", "Write job files that render a scene on many machines, for an existing engine");
  command.add_text("FILE", render.scene.file, "The scene");
  command.add_text("--engine", options->engine, "What runs the job").one_of(kFarmEngineWords);
  command.add_text("-o,--output", options->folder,
                   "The folder for job files, parts and pictures; all machines need it under the "
                   "same path");
  add_set_option(command, render.scene.sets);
  add_reading_options(command, render.scene.reading);
  command.remove_option("--stdin-filename");
  add_diagnostics_options(command, render.scene.diagnostics);
  add_override_options(command, render.overrides);
  add_kernel_options(command, render.kernel);
  add_aov_option(command, render.aovs);
  add_frames_option(command, render.frames);
  command.add_text("--extension", options->extension,
                   "The format of the pictures. Default: exr with --aov, that of the scene's "
                   "output, otherwise png");
  const Option task_time = command
                               .add_text(
                                   "--task-time",
                                   [options](const std::string& text) {
                                     options->task_seconds = parse_duration("--task-time", text);
                                   },
                                   "How long a task shall take, by a measurement of two seconds "
                                   "on this machine (5min)")
                               .type_name("T");
  add_whole_number(
      command, "--tasks", {.lowest = 1, .highest = kMaxFarmTasks},
      [options](std::uint64_t count) { options->tasks = count; },
      "The number of tasks, about, without a measurement")
      .excludes(task_time);
  command.add_text("--image", options->image, "The container image for kubernetes (sdlc)");
  command.add_flag("--quiet", render.quiet, "Only diagnostics on standard error");
  command.footer(
      "Examples:\n"
      "  sdlc farm ball.scene --engine slurm -o job --samples 65536\n"
      "  sdlc farm film.scene --engine shell -o job --task-time 2min\n"
      "  sdlc farm film.scene --engine openjd -o job --frames 1-240\n"
      "  sdlc farm ball.scene --engine kubernetes -o job --tasks 64 --image registry/sdlc:1\n"
      "  sdlc farm status job\n"
      "\n"
      "Tasks are some frames each if a frame takes less than --task-time, otherwise shards of each "
      "picture,\nwhich a last step merges.");
  dispatcher.on(command, [options, command](Environment& env) {
    if (options->engine.empty()) throw UsageError("--engine is required");
    if (options->folder.empty()) throw UsageError("--output is required");
    options->given = command.given_flags();
    enter_pack(options->render.scene, env);
    return FarmPlanner(*options, env).run();
  });
  add_farm_status_command(command, dispatcher);
}

}  // namespace sdlc::cli
