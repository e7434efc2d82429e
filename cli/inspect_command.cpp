#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/command_line.hpp"
#include "cli/dispatcher.hpp"
#include "cli/inspect_film.hpp"
#include "cli/inspect_report.hpp"
#include "cli/kernel_options.hpp"
#include "cli/make_rule.hpp"
#include "cli/outputs.hpp"
#include "cli/override_options.hpp"
#include "cli/scene_figures.hpp"
#include "cli/scene_options.hpp"
#include "cli/usage_error.hpp"
#include "cli/whole_number.hpp"
#include "lang/allowances/allowances.hpp"
#include "lang/compile/compile.hpp"
#include "lang/object/check.hpp"
#include "lang/text/display_width.hpp"
#include "render/math/clock.hpp"
#include "render/scene/instances.hpp"

namespace sdlc::cli {
namespace {

struct InspectOptions {
  SceneOptions scene;
  lang::Overrides overrides;
  render::KernelRequest kernel;
  std::optional<int> frame;
  bool wants_files = false;           // --deps
  std::vector<std::string> targets;   // of --deps
  std::vector<std::uint32_t> traced;  // --where

  bool is_json() const { return scene.diagnostics.format == "json"; }
};

class InspectJob {
 public:
  InspectJob(const InspectOptions& options, Environment& env)
      : options_(options),
        env_(env),
        start_(std::chrono::steady_clock::now()),
        source_(read_scene(options.scene, env)),
        read_seconds_(render::seconds_since(start_)),
        compiler_(*source_, program_options(options.scene, env), sink_) {}

  ExitCode run() {
    if (options_.wants_files) return print_files();
    if (!options_.targets.empty()) throw UsageError("--target requires --deps");
    const std::optional<lang::Animation> animation = compiler_.animation();
    if (options_.frame && !animation && !sink_.has_errors()) {
      throw UsageError("--frame: the scene has no `animation`, so all frames are the same");
    }
    lang::Overrides overrides = options_.overrides;
    overrides.instancing = instancing_for(options_.kernel, overrides);
    lang::LoweredScene lowered = compiler_.lower_partly(overrides, options_.frame);
    render::Kernel kernel = choose_kernel(options_.kernel, options_.overrides, lowered, compiler_);
    print_new_diagnostics();
    if (!sink_.has_errors()) check_goals(overrides, lowered);
    // A scene with errors is reported without its invalid parts, unless nothing is left.
    const bool is_empty = render::count_spheres(lowered.scene) == 0 && !lowered.camera;
    if (sink_.has_errors() && is_empty) return ExitCode::Findings;
    if (!options_.traced.empty()) {
      print_origins(lowered.scene);
    } else {
      const InspectReport report = make_report(std::move(lowered), std::move(kernel), animation);
      env_.out << (options_.is_json() ? to_json(report) : to_text(report));
    }
    return sink_.has_errors() ? ExitCode::Findings : ExitCode::Success;
  }

 private:
  void print_new_diagnostics() {
    print_findings(select_unallowed(sink_), options_.scene.diagnostics, env_.err,
                   env_.err_is_terminal, env_);
  }

  /// The files that were read in addition to the scene.
  std::vector<std::string> dependencies() const {
    std::vector<std::string> names;
    for (const auto& path : compiler_.dependencies()) names.push_back(path.string());
    return names;
  }

  /// The files on disk that the scene reads, the scene first.
  std::vector<std::string> files() const {
    if (options_.scene.pack) return {options_.scene.disk_file()};
    std::vector<std::string> names = dependencies();
    // Standard input counts as a file only if it has a name.
    const std::string scene = options_.scene.given_name();
    if (!scene.empty()) names.insert(names.begin(), scene);
    return names;
  }

  ExitCode print_files() {
    compiler_.read_all_files();
    print_new_diagnostics();
    std::vector<std::string> names = files();
    if (!options_.targets.empty()) {
      // Files that could not be read would be missing.
      if (sink_.has_errors()) return ExitCode::Findings;
      env_.out << make_rule(options_.targets, names);
    } else if (options_.is_json()) {
      env_.out << to_json(names);
    } else {
      for (const std::string& name : names) {
        env_.out << (env_.out_is_terminal ? lang::printable(name) : name) << '\n';
      }
    }
    return sink_.has_errors() ? ExitCode::Findings : ExitCode::Success;
  }

  void print_origins(const render::Scene& scene) {
    std::vector<std::uint32_t> wanted = options_.traced;
    std::ranges::sort(wanted);
    wanted.erase(std::ranges::unique(wanted).begin(), wanted.end());
    if (wanted.back() >= scene.spheres.size()) {
      const std::size_t count = scene.spheres.size();
      throw UsageError(fmt::format(
          "--where: there is no sphere {}; {}{}", wanted.back(),
          count == 0 ? "the scene has none" : fmt::format("they are 0 to {}", count - 1),
          scene.instances.empty() ? "" : "; spheres of instances have no numbers"));
    }
    const std::vector<lang::Origin> origins = compiler_.trace(wanted);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (origins[i].where.file != nullptr) continue;
      throw UsageError(fmt::format(
          "--where: the place of sphere {} is unknown, because it is from an instance; use "
          "--instances never",
          wanted[i]));
    }
    std::vector<TracedSphere> spheres;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const render::Sphere& sphere = scene.spheres[wanted[i]];
      spheres.push_back({.index = wanted[i],
                         .sphere = sphere,
                         .shift = scene.shifts.empty() ? render::Vec3{} : scene.shifts[wanted[i]],
                         .material = scene.materials[sphere.material].type,
                         .origin = origins[i]});
    }
    env_.out << (options_.is_json() ? to_json(spheres) : to_text(spheres));
  }

  std::vector<PrecisionFigures> judge_precisions(const lang::LoweredScene& lowered) {
    using render::Precision;
    const render::Scene& scene = lowered.scene;
    const render::FloatVerdict verdict = judge_float(scene, scene.camera, lowered.settings);
    std::vector<PrecisionFigures> all{{Precision::Float, verdict.in_float, {}, {}}};
    if (!verdict.exact_spheres.empty()) {
      all.push_back({Precision::Mixed, verdict.bounds, verdict.exact_spheres, {}});
    }
    all.push_back({Precision::Double,
                   judge_precision(scene, scene.camera, lowered.settings, Precision::Double),
                   {},
                   {}});
    find_places(all);
    return all;
  }

  /// All in one evaluation of the scene: the steps of all of them together are limited.
  void find_places(std::vector<PrecisionFigures>& all) {
    std::vector<std::uint32_t> wanted;
    for (PrecisionFigures& figures : all) {
      const render::PrecisionBound& bound = figures.bounds[figures.bounds.deciding()];
      if (bound.sphere) figures.deciding.push_back({*bound.sphere});
      if (bound.other && bound.other != bound.sphere) figures.deciding.push_back({*bound.other});
      for (const DecidingSphere& one : figures.deciding) wanted.push_back(one.sphere);
    }
    std::ranges::sort(wanted);
    wanted.erase(std::ranges::unique(wanted).begin(), wanted.end());
    const std::vector<lang::Origin> origins = compiler_.trace(wanted);
    for (PrecisionFigures& figures : all) {
      for (DecidingSphere& one : figures.deciding) {
        const auto found = std::ranges::lower_bound(wanted, one.sphere);
        one.where = origins[static_cast<std::size_t>(found - wanted.begin())].where;
      }
    }
  }

  InspectReport make_report(lang::LoweredScene lowered, render::Kernel kernel,
                            const std::optional<lang::Animation>& animation) {
    check_not_refused(kernel);
    const render::Scene& scene = lowered.scene;
    std::optional<int> frame;
    if (animation) frame = options_.frame.value_or(animation->first);
    InspectReport report{
        .scene = source_->name(),
        .errors = sink_.error_count(),
        .dependencies = dependencies(),
        .animation = animation,
        .frame = frame.value_or(0),
        .lowered = {},
        .output = default_picture(lowered.output.output, options_.scene.given_name(), frame),
        .materials = count_materials(scene),
        .spheres = measure_spheres(scene),
        .memory = estimate_memory(scene, lowered.settings, kernel),
        .features = {},
        .kernel = std::move(kernel),
        .precisions = {},
        .times = compiler_.times()};
    if (lowered.camera && render::count_spheres(scene) > 0)
      report.precisions = judge_precisions(lowered);
    report.features = required_features(scene, report.materials);
    report.times.parse_seconds += read_seconds_;
    report.lowered = std::move(lowered);
    return report;
  }

  const InspectOptions& options_;
  Environment& env_;
  std::chrono::steady_clock::time_point start_;
  std::shared_ptr<const lang::Document> source_;
  double read_seconds_;
  lang::DiagnosticSink sink_;
  lang::Compiler compiler_;
};

}  // namespace

void add_inspect_command(Command& program, Dispatcher& dispatcher) {
  auto options = std::make_shared<InspectOptions>();
  Command command = program.add_command(
      "inspect",
      "Show what a scene contains and requires, or what a film holds, without rendering");
  add_scene_options(command, options->scene);
  command.option("--format").description("Format of diagnostics; json: also of the report");
  add_whole_number(
      command, "--frame", {.highest = static_cast<std::uint64_t>(lang::kMaxWholeNumber)},
      [options](std::uint64_t frame) { options->frame = static_cast<int>(frame); },
      "The frame to inspect; default: the first of the scene's animation");
  const Option deps =
      command.add_flag("--deps", options->wants_files,
                       "Only list the files that the scene reads, one per line, the scene first");
  command
      .add_repeated("--target", options->targets,
                    "With --deps: print a dependency file of Make and Ninja, in which this file "
                    "depends on those that the scene reads (may be repeated)")
      .type_name("FILE");
  command
      .add_repeated(
          "--where",
          [options](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              options->traced.push_back(static_cast<std::uint32_t>(
                  parse_whole_number("--where", text, {.highest = UINT32_MAX})));
            }
          },
          "Only show the origin of sphere N, counted from 0: its place in the text, and the "
          "groups, loops and files that lead to it (may be repeated)")
      .type_name("N")
      .takes_several()
      .excludes(deps);
  add_override_options(command, options->overrides);
  add_kernel_options(command, options->kernel);
  // Accepted because all commands have it; without effect here.
  command.add_flag("--quiet", "Only diagnostics on standard error");
  command.footer(
      "Examples:\n"
      "  sdlc inspect ball.scene\n"
      "  sdlc inspect ring.scene --set count=200 --frame 12\n"
      "  sdlc inspect ring.scene --where 17\n"
      "  sdlc inspect ring.scene --deps\n"
      "  sdlc inspect part1.film\n"
      "  sdlc inspect ring.scene --deps --target ring.png > ring.d\n"
      "  sdlc inspect ring.scene --format json | jq .memory.total_bytes\n\n"
      "A scene with errors is reported without its invalid parts, with exit status 1. Nothing is "
      "rendered or\nwritten. docs/inspect.md explains the figures and the JSON fields.");
  dispatcher.on(command, [options](Environment& env) {
    if (is_film_name(options->scene.file)) {
      env.out << inspect_film(options->scene.file, options->is_json());
      return ExitCode::Success;
    }
    enter_pack(options->scene, env);
    return InspectJob(*options, env).run();
  });
}

}  // namespace sdlc::cli
