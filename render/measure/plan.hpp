#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/measure/measurement.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The cost of a configuration, from a short trial.
struct ConfigurationCost {
  Configuration configuration{};
  double build_seconds = 0;
  double seconds_per_sample = 0;  ///< per pixel
  double seconds_per_pixel = 0;   ///< besides, for denoising
  std::string refusal{};          ///< why it cannot be rendered; it is then excluded from the plan
};

/// One unit of work.
struct StudyTask {
  enum class Kind : std::uint8_t {
    Reference,
    Point,       ///< a picture that is compared with the reference and timed
    Repeat,      ///< repetition of a point, for its time only
    Depths,      ///< all depths with one seed
    Precisions,  ///< both precisions with one seed
    Threads      ///< a picture with each number of threads
  };
  Kind kind = Kind::Point;
  Configuration configuration{};
  int samples = 0;
  int round = 0;  ///< Repeat: from 1; Depths, Precisions: index of the seed; Threads: from 0

  friend bool operator==(const StudyTask&, const StudyTask&) = default;
};

template <>
inline constexpr auto kWords<StudyTask::Kind> = std::to_array<std::string_view>(
    {"reference", "point", "repeat", "depths", "precisions", "threads"});

/// "64 samples, sobol, light sampling auto, float, depth 16", "depths, 1 of 4".
std::string describe(const StudyTask& task);

/// The renders to make, in order.
struct StudyPlan {
  int width = 0, height = 0;
  std::vector<ConfigurationCost> costs{};  ///< the scene's own configuration first
  Configuration reference_configuration{};
  int reference_samples = 0;
  std::vector<int> depths{};  ///< ascending, including the scene's own; the first probe may add
                              ///< some
  int probe_samples = 0;      ///< for the pictures of Depths and Precisions
  std::vector<int> thread_counts{};  ///< ascending, from 1 on; empty: not to be measured
  std::vector<StudyTask> tasks{};

  const ConfigurationCost& cost_of(const Configuration& configuration) const;
  /// The scene's own configuration with the other precision; null if that was not tried.
  const ConfigurationCost* other_precision() const;
  double seconds_of(const StudyTask& task) const;
};

/// The number of seeds for Depths and Precisions.
inline constexpr int kProbeSeeds = 4;
/// How often each number of threads is timed.
inline constexpr int kThreadRounds = 5;

/// 1, 2, 3, 4, 6, 8, 12, … and `most`.
std::vector<int> thread_counts_up_to(int most);

/// The input of plan_study().
struct StudyRequest {
  RenderSettings settings{};               ///< the scene's own; `depth` etc. are those of the first
                                           ///< configuration
  std::vector<ConfigurationCost> costs{};  ///< the scene's own configuration first
  Configuration reference_configuration{};
  double budget_seconds = 0;
  std::vector<int> thread_counts{};  ///< StudyPlan::thread_counts
  /// A fixed size, for comparison with another measurement.
  std::optional<std::array<int, 2>> size{};
};

/// Finds the plan with the most samples that fits the budget: a ladder of doublings for the scene's
/// own configuration, steps of four for the others, and a reference with at least four times the
/// max samples. If not even 64 samples fit at full size, the picture is made smaller.
StudyPlan plan_study(const StudyRequest& request);

}  // namespace sdlc::render
