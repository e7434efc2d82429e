#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/compare/difference.hpp"
#include "render/math/interval.hpp"
#include "render/measure/configuration.hpp"
#include "render/scene/scene.hpp"

/// How error depends on render time: a scene is rendered with many configurations, each compared
/// with one long reference render. All intervals are 95 % confidence intervals. Errors are relative
/// errors as in ErrorEstimate, where 1 is 100 %; times are in seconds.
namespace sdlc::render {

struct Measured {
  double value = 0;
  Interval interval{};
};

/// A point's status compared with all others in time and error.
enum class Dominance : std::uint8_t {
  Front,             ///< no other point is better: on the Pareto front
  NotDistinguished,  ///< another point may be better: their intervals overlap
  Dominated,         ///< another point is better beyond the intervals
};

template <>
inline constexpr auto kWords<Dominance> =
    std::to_array<std::string_view>({"front", "not distinguished", "dominated"});

/// A render that was timed and compared with the reference.
struct Point {
  Configuration configuration{};
  int samples = 0;
  std::vector<double> timings{};  ///< building and tracing, per repetition
  std::uint64_t rays = 0;
  Measured error{};  ///< of this very picture, including the bias of its depth and precision
  /// The standard deviation of the error over seeds, estimated from the pixels.
  double error_spread = 0;
  Difference difference{};  ///< includes the noise of the reference
  double flip = 0;
  std::uint64_t scarce_emitters = 0;  ///< RenderResult::scarce_emitters
  double cut_paths = 0;               ///< share of its paths that the depth limit cut off
  // Concluded from all points together.
  Measured seconds{};  ///< median of the timings
  double samples_per_second = 0, rays_per_second = 0;
  Dominance dominance = Dominance::Front;
};

/// The point of a configuration with a number of samples; null if there is none.
template <typename Points>
auto* find_point(Points& points, const Configuration& configuration, int samples) {
  const auto found = std::ranges::find_if(points, [&](const Point& point) {
    return point.configuration == configuration && point.samples == samples;
  });
  return found == points.end() ? nullptr : &*found;
}

/// The points of one configuration, with increasing numbers of samples.
struct Series {
  Configuration configuration{};
  std::vector<std::size_t> points{};  ///< indices, ascending in samples
  /// The exponent with which the error falls with the samples, from a line fit; -1/2 for
  /// independent samples. nullopt for fewer than two points.
  std::optional<Measured> slope{};
};

/// The light that a depth limit loses: the same paths with that depth and with the greatest depth
/// measured. A lower bound if Measurement::depths_have_converged is false.
struct DepthLoss {
  int depth = 0;
  Measured loss{};              ///< share of the mean radiance
  double relative_seconds = 0;  ///< of a render; the scene's own depth has 1
  double cut_paths = 0;         ///< share of all paths
};

/// The same paths in two precisions.
struct PrecisionDifference {
  Precision taken = Precision::Float;  ///< the automatic choice
  Precision other = Precision::Double;
  /// Why the other precision is impossible; the figures are then 0.
  std::optional<std::string> refusal{};
  Measured mean_difference{};   ///< (taken − other) mean radiance, relative
  double rms_difference = 0;    ///< of the pictures, relative like an error; mostly from paths that
                                ///< diverge
  double relative_seconds = 0;  ///< of the other precision, relative to the one taken
  std::string bound{};          ///< the deciding criterion, in words
};

/// The time of the same render with a number of threads.
struct ThreadScaling {
  int threads = 0;
  Measured seconds{};   ///< building and tracing, the median
  Measured speed_up{};  ///< over one thread
};

/// The reference that all pictures are compared with.
struct Reference {
  Configuration configuration{};
  int samples = 0;
  std::uint64_t seed = 0;
  double seconds = 0;
  Measured error{};  ///< infinite if RenderResult::error is unknown
  double mean_radiance = 0;
  std::uint64_t scarce_emitters = 0;
};

/// The settings recommended for reaching an error.
struct Recommendation {
  std::optional<double> goal{};  ///< relative error; nullopt: the picture has no noise
  Configuration configuration{};
  int samples = 0;
  bool is_measured = false;   ///< this number of samples was rendered; otherwise extrapolated along
                              ///< the series
  Measured relative_error{};  ///< expected or measured
  Measured seconds{};  ///< of the next `sdlc render` on this machine, including reading and writing
  std::string flags{};   ///< of `sdlc render`; filled in by the command line
  bool is_main = false;  ///< shown first
};

struct LeftOut {
  Configuration configuration{};
  std::optional<int> samples{};  ///< nullopt: any number
  std::string reason{};
};

/// The flags of the command line that the picture depends on, and that a recommendation repeats.
struct GivenFlags {
  std::vector<std::string> of_configuration{};  ///< names in kConfigurationSettings
  std::string others{};                         ///< as they are typed: "--width 320 --seed 7"
};

struct Measurement {
  // The scene's own settings.
  Configuration own{};
  int width = 0, height = 0;  ///< the measured size
  int full_width = 0, full_height = 0;
  int samples = 0;
  std::uint64_t seed = 0;
  int threads = 0;
  double budget_seconds = 0;
  double spent_seconds = 0;
  double other_seconds = 0;  ///< of a render apart from building and tracing: reading and writing

  std::optional<Reference> reference{};
  std::vector<Point> points{};
  std::vector<Series> series{};
  std::vector<DepthLoss> depths{};     ///< ascending
  bool depths_have_converged = false;  ///< paths deeper than the last entry carry no light
  std::optional<PrecisionDifference> precision{};
  std::vector<ThreadScaling> thread_scaling{};  ///< ascending; empty if it was not requested
  int thread_scaling_samples = 0;               ///< of its renders
  bool thread_pictures_are_same = true;         ///< byte for byte; false is a defect
  std::string light_choice{};    ///< what light sampling "auto" chose; empty without a choice
  std::optional<double> goal{};  ///< requested error
  /// The scene with its own settings, if they were measured; without a goal.
  std::optional<Recommendation> as_it_is{};
  std::vector<Recommendation> recommendations{};  ///< from the largest error to the smallest
  std::vector<LeftOut> left_out{};
  std::uint64_t nonfinite_samples = 0;  ///< of all renders; not 0 indicates a defect
  GivenFlags given{};
  bool is_complete = false;  ///< the plan is finished, except for what time ruled out
};

}  // namespace sdlc::render
