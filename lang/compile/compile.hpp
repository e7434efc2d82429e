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

/// Seconds that the phases of a compilation took.
struct CompileTimes {
  double parse_seconds = 0;  ///< reading the text into checked objects
  double lower_seconds = 0;  ///< making the renderer's scene of them
};

/// Where a lowered sphere comes from.
struct Origin {
  Location where;                ///< of the sphere in the text
  Location material;             ///< of its material, or that of the group that gives it one
  std::string name;              ///< its own; empty where it has none
  std::vector<ChainLink> chain;  ///< through instances, loops and files, the innermost first
};

/// A text of either format and the files it needs, read once and lowered as often as it has frames.
/// Errors and warnings are in the sink, whose diagnostics refer to texts that this object holds.
class Compiler {
 public:
  /// `file` must outlive the compiler.
  Compiler(const Document& file, const ProgramOptions& options, DiagnosticSink& sink);
  ~Compiler();

  /// The frames that the scene says it has; nothing where it has no `animation`.
  std::optional<Animation> animation();

  /// The scene at one frame (by default the first, or the only one there is), or nothing when it
  /// has errors.
  std::optional<LoweredScene> lower(const Overrides& overrides, std::optional<int> frame = {});

  /// The same for those who can use a scene from which something is missing: whatever is right is
  /// there, whether or not errors have been reported.
  LoweredScene lower_partly(const Overrides& overrides, std::optional<int> frame = {});

  /// Reports what is wrong with the text, whichever camera and frame will be asked for: a film's
  /// first and last frames are evaluated, and a file without a camera may be a part of others.
  /// `look` is shown the scene of each as long as there are no errors; it may trace spheres of it.
  void check(const std::function<void(const LoweredScene&)>& look = {});

  /// The scene of one frame while the shutter of one camera is open, as check() shows it: all of it
  /// unless errors have been reported. By default the first frame, and the camera of the file.
  LoweredScene check_view(std::optional<int> frame, std::optional<std::string> camera);

  /// Warns where the precision that the scene lowered last is traced in does not resolve it.
  /// Numbers change from frame to frame: of a film each bound is told once for the sphere that
  /// decides.
  void warn_of_precision(const LoweredScene& lowered, render::Precision taken,
                         const render::PrecisionBounds& bounds);

  /// Where spheres of the scene lowered last come from, by their index in it, ascending; places
  /// without a file of those that its instances were given in place of themselves. They are
  /// found by evaluating once more, so that no sphere has to remember.
  std::vector<Origin> trace(std::span<const std::uint32_t> spheres);

  /// The text's statements; null of a config.
  const Program* program() const noexcept { return program_.get(); }
  /// What the names of the text mean. Precondition: it is no config.
  const SymbolTable& names() { return program_->names_of(Program::kRoot, sink_.stop_request()); }
  const StopRequest* stop_request() const noexcept { return sink_.stop_request(); }
  const ProgramOptions& options() const noexcept { return options_; }

  /// Reads the files that could be included whatever the values are, without evaluating anything.
  void read_all_files();

  /// The files that the root imports and includes, as far as they have been read, in the order in
  /// which they were.
  std::vector<std::filesystem::path> dependencies() const;
  /// Reports them to the workspace. The compiler does so whenever it has read files.
  void publish_dependencies();
  const CompileTimes& times() const noexcept { return times_; }

 private:
  /// Everything that the text says, in the order of `objects`, by at most so many steps; returns
  /// how many it took.
  std::uint64_t read(ObjectSink& objects, DiagnosticSink& sink,
                     std::optional<std::uint64_t> steps = {});
  LoweredScene build(const Overrides& overrides, std::optional<int> frame, Purpose purpose);
  /// Origins by the order in which spheres were added, those of instances not counted; ascending.
  std::vector<Origin> trace_added(std::span<const std::uint32_t> spheres);
  /// A sandbox holds for the file that the scene is written to as well.
  void check_output(const LoweredScene& lowered, Purpose purpose);
  void report_dropped();
  /// That the scene reaches beyond double.
  void report_scale(const LoweredScene& lowered, Purpose purpose);
  /// `setting`: the words of the text that are to blame; no file: the sphere that decides.
  void report_fault(const PrecisionFault& fault, Location setting);

  using ToldPrecision =
      std::tuple<render::Precision, render::PrecisionClause, std::optional<std::uint32_t>>;

  const Document& file_;
  ProgramOptions options_;
  DiagnosticSink& sink_;
  std::unique_ptr<Program> program_;  ///< null for a config
  std::optional<Animation> animation_;
  bool knows_animation_ = false;
  std::set<ToldPrecision> told_precision_;  ///< what warnings of earlier frames were about
  Overrides overrides_;
  std::optional<int> frame_;
  std::vector<DroppedSphere> dropped_;
  std::vector<GroupRepeats::Run> instance_runs_;
  std::uint64_t trace_steps_ = 0;
  CompileTimes times_;
};

/// Compiles a text that has no other frames and needs no other files.
std::optional<LoweredScene> compile(const Document& file, const Overrides& overrides,
                                    DiagnosticSink& sink);

}  // namespace sdlc::lang
