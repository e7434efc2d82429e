#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/measure/measurement.hpp"
#include "render/measure/plan.hpp"
#include "render/measure/reference_error.hpp"
#include "render/scene/scene.hpp"
#include "render/tiles/kernel.hpp"
#include "render/tiles/render.hpp"

namespace sdlc::render {

/// A render of a point, for its time.
struct TimedRender {
  Way way{};
  int samples = 0;
  double seconds = 0;  ///< building and tracing
  std::uint64_t camera_samples = 0, rays = 0;
};

/// One picture held against the reference.
struct Evaluation {
  Way way{};
  int samples = 0;
  Measured error{};
  double error_spread = 0;
  Difference difference{};
  double flip = 0;
  std::uint64_t scarce_emitters = 0;
  double cut_share = 0;
};

/// A picture of one depth and seed.
struct DepthProbe {
  int depth = 0;
  int round = 0;
  double mean = 0;  ///< radiance
  double seconds = 0;
  double cut_share = 0;
};

/// Whether deeper paths carry no light that counts: the last doubling of the depth added none, and
/// hardly any path is cut; or three doublings added none, as in a dark closed room.
bool depths_have_converged(std::span<const DepthProbe> probes);

/// The same paths in both precisions.
struct PrecisionProbe {
  int round = 0;
  double mean = 0, other_mean = 0;  ///< radiance
  double rms_difference = 0;        ///< relative to the mean
  double seconds = 0, other_seconds = 0;
};

/// What a study has done so far: all that is needed to go on with it later.
struct StudyLedger {
  std::optional<StudyPlan> plan{};
  std::optional<Reference> reference{};
  std::vector<TimedRender> renders{};
  std::vector<Evaluation> evaluations{};
  std::vector<DepthProbe> depths{};
  std::vector<PrecisionProbe> precisions{};
  std::string precision_bound{};  ///< in words
  double other_seconds = 0;       ///< of a render, reading and writing
  double spent_seconds = 0;
  std::uint64_t nonfinite_samples = 0;  ///< a defect if not 0
};

/// What others learn while a study goes on.
struct StudyObserver {
  /// Before each thing that is done: what, in words, and the share of the budget that is spent.
  std::function<void(const std::string& what, double share)> on_task;
  /// A reference was rendered.
  std::function<void(const ReferencePicture& reference)> on_reference;
  /// A picture of a point, once.
  std::function<void(const Way& way, int samples, const Picture& picture,
                     const ReferencePicture& reference)>
      on_picture;
  /// The ledger has grown.
  std::function<void(const StudyLedger& ledger)> on_progress;
};

struct StudyOptions {
  double budget_seconds = 60;
  std::optional<double> goal{};  ///< an error that is recommended for, whatever others are
  std::optional<std::array<int, 2>> size{};  ///< StudyRequest::size
};

/// Renders a scene in many ways, each as `render` would, and measures them.
class Study {
 public:
  /// `request`: what of the kernel is asked for. All but the request are borrowed.
  Study(const Scene& scene, const RenderSettings& settings, KernelRequest request,
        StudyOptions options, StudyLedger& ledger, const StudyObserver& observer,
        RenderMonitor& monitor);

  /// Does what is not in the ledger yet, until the time is used up or it is cancelled. `reference`:
  /// the picture of the reference in the ledger. Throws std::invalid_argument where the scene's own
  /// way is refused.
  void run(std::optional<ReferencePicture> reference);

  /// What the ledger says.
  Measurement measurement() const;

 private:
  RenderSettings settings_of(const Way& way, int samples, std::uint64_t seed) const;
  KernelRequest request_of(const Way& way) const;
  std::vector<Way> ways() const;
  WayCost try_way(const Way& way);
  /// By the trial of another.
  WayCost guess_way(const Way& way, const WayCost& own) const;
  void make_plan();
  bool is_possible(const Way& way) const;
  std::optional<RenderResult> rendered(const Way& way, int samples, std::uint64_t seed,
                                       bool keeps_variance = false);
  bool is_done(const StudyTask& task) const;
  /// False once cancelled.
  bool run_task(const StudyTask& task);
  bool run_reference(const StudyTask& task);
  bool run_point(const StudyTask& task);
  bool run_depths(const StudyTask& task);
  bool run_precisions(const StudyTask& task);
  /// The same, told before and kept after.
  bool run_and_account(const StudyTask& task);
  /// Renders what is recommended, where it was not and there is time.
  void run_recommended();
  /// Doubles the most samples of the scene's own way as long as there is time.
  void run_longer();
  void tell(const std::string& what) const;
  /// By the trials, and by what they were wrong by so far: where caches are too small, or parts of
  /// the picture unlike the others, they know little.
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
  Way own_{};
  std::optional<ReferencePicture> reference_{};
  double spent_before_ = 0;
  double foretold_ = 0, taken_ = 0;  // of all that was done in this run
  std::chrono::steady_clock::time_point start_{};
};

/// The figures of a ledger of a scene with these settings.
Measurement measurement_of(const StudyLedger& ledger, const RenderSettings& settings,
                           const StudyOptions& options);

}  // namespace sdlc::render
