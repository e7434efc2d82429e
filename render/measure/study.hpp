#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/kernel/kernel.hpp"
#include "render/measure/measurement.hpp"
#include "render/measure/plan.hpp"
#include "render/measure/reference_error.hpp"
#include "render/scene/scene.hpp"
#include "render/session/prepared_scene.hpp"
#include "render/session/render.hpp"

namespace sdlc::render {

/// A picture of one depth and seed.
struct DepthProbe {
  int depth = 0;
  int round = 0;
  double mean = 0;  ///< radiance
  double seconds = 0;
  double cut_paths = 0;
};

/// Whether deeper paths carry no significant light: the last doubling of the depth added none and
/// hardly any path is cut off; or three doublings added none, as in a dark closed room.
bool depths_have_converged(std::span<const DepthProbe> probes);

/// The same paths in both precisions.
struct PrecisionProbe {
  int round = 0;
  double mean = 0, other_mean = 0;  ///< radiance
  double rms_difference = 0;        ///< relative to the mean
  double seconds = 0, other_seconds = 0;
};

/// A render with a number of threads.
struct ThreadProbe {
  int threads = 0;
  int round = 0;
  double seconds = 0;
  bool is_same = false;  ///< its picture is, byte for byte, that of the first probe of the round
};

/// The results of a study so far, sufficient to resume it.
struct StudyLedger {
  std::optional<StudyPlan> plan{};
  std::optional<Reference> reference{};
  std::vector<Point> points{};  ///< as rendered, without the conclusions from all of them
  std::vector<DepthProbe> depths{};
  std::vector<PrecisionProbe> precisions{};
  std::vector<ThreadProbe> threads{};
  std::string precision_bound{};  ///< in words
  std::string light_choice{};     ///< Kernel::light_choice of the scene's own configuration
  double other_seconds = 0;       ///< of a render: reading and writing
  double spent_seconds = 0;
  double finished_budget_seconds = 0;   ///< the largest budget that was used up; 0 if none
  std::uint64_t nonfinite_samples = 0;  ///< not 0 indicates a defect
};

/// Callbacks during a study.
struct StudyObserver {
  /// Before each task: its description, and the spent share of the budget.
  std::function<void(const std::string& what, double share)> on_task;
  /// After a reference was rendered.
  std::function<void(const ReferencePicture& reference)> on_reference;
  /// For each picture of a point, once.
  std::function<void(const Configuration& configuration, int samples, const Picture& picture,
                     const ReferencePicture& reference)>
      on_picture;
  /// After the ledger has grown.
  std::function<void(const StudyLedger& ledger)> on_progress;
};

struct StudyOptions {
  double budget_seconds = 60;
  std::optional<double> goal{};              ///< an error that always gets a recommendation
  std::optional<std::array<int, 2>> size{};  ///< StudyRequest::size
  bool sweeps_threads = false;               ///< whether numbers of threads are compared
};

/// Renders a scene with many configurations, each as `render` would, and measures them.
class Study {
 public:
  /// `request`: the requested kernel. Keeps references to all arguments except `request` and
  /// `options`.
  Study(const Scene& scene, const RenderSettings& settings, KernelRequest request,
        StudyOptions options, StudyLedger& ledger, const StudyObserver& observer,
        RenderMonitor& monitor);

  /// Does the tasks that are not in the ledger yet, until the time is used up or the study is
  /// cancelled. `reference`: the picture of the reference in the ledger. Throws
  /// std::invalid_argument if the scene's own configuration is refused.
  void run(std::optional<ReferencePicture> reference);

  /// Evaluates the ledger.
  Measurement measurement() const;

 private:
  RenderSettings settings_of(const Configuration& configuration, int samples,
                             std::uint64_t seed) const;
  KernelRequest request_of(const Configuration& configuration) const;
  Kernel kernel_of(const Configuration& configuration) const;
  /// The scene prepared for a configuration, which the next renders use again unless it is built
  /// anew for a time of its own.
  std::shared_ptr<const PreparedScene> prepared(const RenderSettings& settings,
                                                const Configuration& configuration);
  std::vector<Configuration> configurations() const;
  ConfigurationCost try_configuration(const Configuration& configuration);
  /// From the trial of the own configuration.
  ConfigurationCost guess_configuration(const Configuration& configuration,
                                        const ConfigurationCost& own) const;
  void make_plan();
  RenderResult render_once(const RenderSettings& settings, const Configuration& configuration);
  /// nullopt if cancelled.
  std::optional<RenderResult> rendered(const Configuration& configuration, int samples,
                                       std::uint64_t seed, bool keeps_variance = false);
  bool is_done(const StudyTask& task) const;
  /// Returns false if cancelled.
  bool run_task(const StudyTask& task);
  bool run_reference(const StudyTask& task);
  bool run_point(const StudyTask& task);
  bool run_depths(const StudyTask& task);
  bool run_precisions(const StudyTask& task);
  bool run_threads(const StudyTask& task);
  /// Runs a task, with notifications before and after.
  bool run_and_account(const StudyTask& task);
  /// Renders recommended settings that were not measured, if there is time.
  void run_recommended();
  /// Doubles the max samples of the scene's own configuration while there is time.
  void run_longer();
  /// Repeats points, those with the fewest timings first, until 90 % of the budget is used.
  void run_again();
  void notify(const std::string& what) const;
  /// Predicted from the trials, corrected by their error so far: they know little about small
  /// caches, or about parts of the picture unlike the others.
  double expected_seconds(const StudyTask& task) const;
  double seconds_left() const;
  void account();

  const Scene& scene_;
  RenderSettings settings_{};
  KernelRequest request_;
  StudyOptions options_;
  StudyLedger& ledger_;
  const StudyObserver& observer_;
  RenderMonitor& monitor_;
  Configuration own_{};
  std::optional<ReferencePicture> reference_{};
  /// The scenes that were used last. Two, so that two configurations can be compared in turn.
  struct Prepared {
    Configuration configuration;
    std::array<int, 2> size;
    std::shared_ptr<const PreparedScene> scene;
  };
  std::vector<Prepared> prepared_;
  double spent_before_ = 0;
  double predicted_ = 0, taken_ = 0;  // totals of this run
  std::chrono::steady_clock::time_point start_{};
};

/// Evaluates a ledger of a scene with these settings.
Measurement measurement_of(const StudyLedger& ledger, const RenderSettings& settings,
                           const StudyOptions& options);

}  // namespace sdlc::render
