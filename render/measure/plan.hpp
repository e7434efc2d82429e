#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/measure/measurement.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// What a render of a way takes, by a short trial.
struct WayCost {
  Way way{};
  double build_seconds = 0;
  double seconds_a_sample = 0;  ///< of one pixel
  std::string refusal{};        ///< why there is none; then nothing of it is planned
};

/// One thing to be rendered, each by itself.
struct StudyTask {
  enum class Kind : std::uint8_t {
    Reference,
    Point,      ///< a picture held against the reference, and timed
    Repeat,     ///< of a point, for its time alone
    Depths,     ///< all depths with one seed
    Precisions  ///< both precisions with one seed
  };
  Kind kind = Kind::Point;
  Way way{};
  int samples = 0;
  int round = 0;  ///< Repeat: from 1 on; Depths, Precisions: which seed

  friend bool operator==(const StudyTask&, const StudyTask&) = default;
};

/// "64 samples, sobol, light sampling auto, float, depth 16", "depths, 1 of 4".
std::string describe(const StudyTask& task);

/// What is rendered, and in which order.
struct StudyPlan {
  int width = 0, height = 0;
  std::vector<WayCost> costs{};  ///< the scene's own way first
  Way reference_way{};
  int reference_samples = 0;
  std::vector<int> depths{};  ///< ascending, with the scene's own; the first probes may add some
  int probe_samples = 0;      ///< of the pictures of Depths and Precisions
  std::vector<StudyTask> tasks{};

  const WayCost& cost_of(const Way& way) const;
  /// The scene's own way but for its precision; null where that was not tried.
  const WayCost* other_precision() const;
  double seconds_of(const StudyTask& task) const;
};

/// Pictures of so many seeds are behind what is said of depths and precisions.
inline constexpr int kProbeSeeds = 4;

/// What a plan is made of.
struct StudyRequest {
  RenderSettings settings{};     ///< the scene's own; `depth` and so on are that of the first way
  std::vector<WayCost> costs{};  ///< the scene's own way first
  Way reference_way{};
  double budget_seconds = 0;
  /// The size to measure at, where it has to be that of another measurement.
  std::optional<std::array<int, 2>> size{};
};

/// The most samples for which everything fits into the budget: a ladder of doublings of the scene's
/// own way, steps of four of the others, and a reference of four times the most samples or more. If
/// not even 64 samples would fit at full size, the picture is made smaller.
StudyPlan plan_study(const StudyRequest& request);

}  // namespace sdlc::render
