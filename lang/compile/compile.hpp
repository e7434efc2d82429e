#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/eval/eval.hpp"
#include "lang/lower/precision_fault.hpp"
#include "lang/lower/scene_builder.hpp"
#include "lang/program/program.hpp"
#include "lang/source/source.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::lang {

/// Durations of the phases of a compilation.
struct CompileTimes {
  double parse_seconds = 0;  ///< text to checked objects
  double lower_seconds = 0;  ///< objects to the renderer's scene
};

/// The origin of a lowered sphere in the text.
struct Origin {
  Location where;                ///< of the sphere
  Location material;             ///< its own or inherited from a group
  std::string name;              ///< empty if it has none
  std::vector<ChainLink> chain;  ///< instances, loops and files around it, the innermost first
};

/// A text of either format with the files it needs: loaded once, lowered once per frame.
/// Diagnostics go to the sink and refer to `file` and to documents that the compiler shares with
/// the workspace: they are valid as long as both exist.
class Compiler {
 public:
  /// `file` must outlive the compiler.
  Compiler(const Document& file, const ProgramOptions& options, DiagnosticSink& sink);
  ~Compiler();

  /// The frames of the scene; nullopt without an `animation`.
  std::optional<Animation> animation();

  /// The scene at one frame (default: the first, or the only one); nullopt if errors have been
  /// reported.
  std::optional<LoweredScene> lower(const Overrides& overrides, std::optional<int> frame = {});

  /// The same for callers that can use an incomplete scene: it has all objects without errors,
  /// whether or not errors have been reported.
  LoweredScene lower_partly(const Overrides& overrides, std::optional<int> frame = {});

  /// Reports the errors and warnings of the text for all cameras: evaluates the first and the last
  /// frame. A file without a camera is accepted, since others may include it. Calls `look` with the
  /// scene of each frame as long as there are no errors; it may trace spheres of the scene. At the
  /// end the workspace learns what the text imports and includes.
  void check(const std::function<void(const LoweredScene&)>& look = {});

  /// The scene of one frame with the shutter of one camera (default: the first, the camera of the
  /// file), as check() passes it to `look`. Complete unless errors have been reported.
  LoweredScene check_view(std::optional<int> frame, std::optional<std::string> camera);

  /// Warns if `taken`, the precision of rendering, does not resolve the scene lowered last. In an
  /// animation each bound is reported once per deciding sphere, since numbers change from frame to
  /// frame.
  void warn_of_precision(const LoweredScene& lowered, render::Precision taken,
                         const render::PrecisionBounds& bounds);

  /// The origins of spheres of the scene lowered last. `spheres`: their indices, ascending. Spheres
  /// of expanded instances have an origin without a file. Found by evaluating once more, so that no
  /// sphere has to store its origin.
  std::vector<Origin> trace(std::span<const std::uint32_t> spheres);
  /// The same for a person who asks now and then: each call has the whole limit on steps.
  std::vector<Origin> trace_again(std::span<const std::uint32_t> spheres) {
    trace_steps_ = 0;
    return trace(spheres);
  }

  /// The loaded program; null for a config.
  Program* program() const noexcept { return program_.get(); }
  /// The symbols of the text. Precondition: it is no config.
  const SymbolTable& names() { return program_->names_of(Program::kRoot, sink_.stop_request()); }
  const StopRequest* stop_request() const noexcept { return sink_.stop_request(); }
  const ProgramOptions& options() const noexcept { return options_; }

  /// Loads all files that any evaluation could include, without evaluating anything, and tells the
  /// workspace.
  void read_all_files();

  /// The files that the root imports and includes, as far as they have been loaded, in the order
  /// of loading.
  std::vector<std::filesystem::path> dependencies() const;
  const CompileTimes& times() const noexcept { return times_; }

 private:
  /// Evaluates the text into `objects` with at most `steps` steps (default: the limit); returns the
  /// number of steps taken.
  std::uint64_t read(ObjectSink& objects, DiagnosticSink& sink,
                     std::optional<std::uint64_t> steps = {});
  LoweredScene build(const Overrides& overrides, std::optional<int> frame, Purpose purpose);
  /// Origins of spheres numbered in the order of addition, those of instances not counted.
  std::vector<Origin> trace_added(std::span<const std::uint32_t> spheres);
  /// Reports an output file outside the sandbox.
  void check_output(const LoweredScene& lowered, Purpose purpose);
  void report_dropped();
  /// Reports a scene whose extent double does not resolve.
  void report_scale(const LoweredScene& lowered, Purpose purpose);
  /// Passes all files that the text can import and include to the workspace.
  void publish_dependencies();
  /// `setting`: the place of the setting that causes it; without a file: none, report the sphere.
  /// E241, for the cameras that report_scale() judges.
  void report_lens(const LoweredScene& lowered, Purpose purpose);
  void report_fault(const PrecisionFault& fault, Location setting);

  using ToldPrecision =
      std::tuple<render::Precision, render::PrecisionClause, std::optional<std::uint32_t>>;

  const Document& file_;
  ProgramOptions options_;
  DiagnosticSink& sink_;
  std::unique_ptr<Program> program_;  ///< null for a config
  TimeFreeValues time_free_;
  std::optional<Animation> animation_;
  bool knows_animation_ = false;
  std::set<ToldPrecision> told_precision_;  ///< warnings of earlier frames
  Overrides overrides_;
  std::optional<int> frame_;
  std::vector<DroppedSphere> dropped_;
  std::vector<GroupRepeats::Run> instance_runs_;
  std::uint64_t trace_steps_ = 0;
  CompileTimes times_;
};

/// Compiles a text without an animation and without other files.
std::optional<LoweredScene> compile(const Document& file, const Overrides& overrides,
                                    DiagnosticSink& sink);

}  // namespace sdlc::lang
