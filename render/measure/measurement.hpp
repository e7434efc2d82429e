#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/compare/difference.hpp"
#include "render/math/interval.hpp"
#include "render/measure/way.hpp"
#include "render/scene/precision.hpp"

/// What a second buys: a scene rendered in many ways, each held against one long reference. All
/// intervals are of 95 %. Errors are relative errors as ErrorEstimate has them, from 0; times are
/// in seconds.
namespace sdlc::render {

struct Measured {
  double value = 0;
  Interval interval;
};

/// How a point stands among all others, in time and error together.
enum class Standing : std::uint8_t {
  Front,             ///< nearer than all that is as quick
  NotDistinguished,  ///< some other may be better: their intervals overlap
  Dominated,         ///< some other is, beyond the intervals
};

/// "front", "not distinguished", "dominated".
std::string_view name_of(Standing standing) noexcept;

/// One render that was timed and held against the reference.
struct Point {
  Way way{};
  int samples = 0;
  std::vector<double> timings{};  ///< of building and tracing, once each time it was rendered
  Measured seconds{};             ///< their median
  double samples_per_second = 0, rays_per_second = 0;
  Measured error{};  ///< of this very picture, what its depth and precision lack included
  /// The standard deviation of the error from seed to seed, which pictures have by their pixels.
  double error_spread = 0;
  Difference difference{};  ///< plain, with what noise the reference has
  double flip = 0;
  std::uint64_t scarce_emitters = 0;  ///< RenderResult::scarce_emitters
  double cut_share = 0;               ///< of its paths, by the depth
  Standing standing = Standing::Front;
};

/// The points of one way, with more and more samples.
struct Series {
  Way way{};
  std::vector<std::size_t> points{};  ///< by index, ascending in samples
  /// The error falls as samples to the power of this, by the line through all points; -1/2 for
  /// independent samples. Nothing of fewer than two points.
  std::optional<Measured> slope{};
};

/// The light that a depth cuts off: the same paths with that depth and with the greatest here. A
/// lower bound where Measurement::depths_have_converged is false.
struct DepthLoss {
  int depth = 0;
  Measured loss{};       ///< share of the mean radiance
  double seconds = 0;    ///< of a render, relative to that of the scene's own depth
  double cut_share = 0;  ///< of all paths
};

/// The same paths in two precisions.
struct PrecisionDifference {
  Precision taken = Precision::Float;  ///< by itself
  Precision other = Precision::Double;
  std::string refusal{};       ///< why the other cannot be had; then the figures are 0
  Measured mean_difference{};  ///< of the mean radiance, taken less other, as a share of it
  double rms_difference = 0;   ///< of the pictures, relative like an error: mostly paths that part
  double seconds = 0;          ///< of the other, relative to the one that is taken
  std::string bound{};         ///< what decided, in words
};

/// What everything is held against.
struct Reference {
  Way way{};
  int samples = 0;
  std::uint64_t seed = 0;
  double seconds = 0;
  Measured error{};  ///< infinite where RenderResult::error is unknown
  double mean_radiance = 0;
  std::uint64_t scarce_emitters = 0;
};

/// What to render with to come down to an error.
struct Recommendation {
  double goal = 0;  ///< relative error
  Way way{};
  int samples = 0;
  bool is_measured = false;  ///< these very samples were rendered; else by the line of the series
  Measured error{};          ///< to be expected, or measured
  Measured seconds{};        ///< of the next `sdlc render` on this machine, reading and writing too
};

struct LeftOut {
  Way way{};
  int samples = 0;  ///< 0: of any number
  std::string reason{};
};

/// The flags of the command line that the picture depends on, and that a recommendation repeats.
struct GivenFlags {
  std::vector<std::string> of_way{};  ///< names in kWaySettings
  std::string others{};               ///< as they are typed: "--width 320 --seed 7"
};

struct Measurement {
  // The scene's own settings.
  Way own{};
  int width = 0, height = 0;  ///< that were measured
  int full_width = 0, full_height = 0;
  int own_samples = 0;
  std::uint64_t seed = 0;
  int threads = 0;
  double budget_seconds = 0;
  double spent_seconds = 0;
  double other_seconds = 0;  ///< of a render beside building and tracing: reading and writing

  std::optional<Reference> reference{};
  std::vector<Point> points{};
  std::vector<Series> series{};
  std::vector<DepthLoss> depths{};     ///< ascending
  bool depths_have_converged = false;  ///< deeper paths than the last of them carry no light
  std::optional<PrecisionDifference> precision{};
  std::optional<double> goal{};  ///< an error that was asked for
  /// The scene as it is, `goal` being 0, if its samples were measured.
  std::optional<Recommendation> as_it_is{};
  std::vector<Recommendation> recommendations{};  ///< from the largest error to the least
  std::size_t main_recommendation = 0;
  std::vector<LeftOut> left_out{};
  std::uint64_t nonfinite_samples = 0;  ///< of all renders; a defect if not 0
  GivenFlags given{};
  bool is_complete = false;  ///< nothing of the plan is missing but what time left out
};

}  // namespace sdlc::render
