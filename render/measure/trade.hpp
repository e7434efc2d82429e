#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/measure/measurement.hpp"
#include "render/measure/noise_of_time.hpp"

/// Conclusions from points: slopes, the Pareto front, and recommendations.
namespace sdlc::render {

/// Sets the dominance of each point. Dominated: another point is clearly faster (their time
/// intervals do not overlap) and clearly more accurate, or equally accurate to the bit. Not
/// distinguishable: another point is faster and more accurate, but not clearly so in both, or
/// clearly faster with an overlapping error.
void mark_dominance(std::span<Point> points);

/// Groups the points by configuration, in order of first appearance, with the slope of a
/// least-squares line through the logarithms. Its confidence interval comes from the points'
/// scatter about the line, which is not only noise, because Sobol' points converge in steps; for
/// two points it is a typical value.
std::vector<Series> group_by_configuration(std::span<const Point> points);

/// The number of samples with which a series reaches an error.
struct SamplesForError {
  int samples = 0;
  bool is_measured = false;  ///< `point` has this number of samples
  std::size_t point = 0;     ///< otherwise the nearest measured point
  Measured error;
  double seconds = 0;  ///< building and tracing
};

/// Finds the fewest samples for which the upper end of the error's interval is at most `goal`.
/// Candidates are the measured numbers and whole quarters of powers of two. Interpolates between
/// adjacent points; beyond the last point it extrapolates with the slope of the series, up to 64
/// times its samples. nullopt if that is not enough.
std::optional<SamplesForError> samples_for(double goal, const Series& series,
                                           std::span<const Point> points);

/// Round errors, from 20 % to .1 %, that the points reach or nearly reach, plus `wanted`.
std::vector<double> worthwhile_goals(std::span<const Point> points, std::optional<double> wanted);

/// The fastest configuration for an error, among the series with the scene's own depth. Prefers the
/// scene's own configuration, the first series, unless another one is faster by more than the noise
/// of times. The seconds are those predicted for the next build and trace.
std::optional<Recommendation> recommend(double goal, std::span<const Series> series,
                                        std::span<const Point> points, const NoiseOfTime& noise);

}  // namespace sdlc::render
