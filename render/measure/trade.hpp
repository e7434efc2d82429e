#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/measure/measurement.hpp"
#include "render/measure/noise_of_time.hpp"

/// What follows from points: slopes, the Pareto front, and what to render with.
namespace sdlc::render {

/// Marks how each point stands. Dominated: some other is clearly quicker, its interval ending where
/// this one's has not begun, and clearly nearer or as near to the bit. Not distinguished: some
/// other is quicker and nearer, but not clearly so in both, or clearly quicker with an error that
/// overlaps.
void mark_standings(std::span<Point> points);

/// The points of each way, in the order in which the ways first appear, with the slope of the line
/// through the logarithms, by least squares. Its interval is that of the points' scatter about the
/// line, which is not noise alone: Sobol' points fall in steps; of two points, what is usual.
std::vector<Series> group_by_way(std::span<const Point> points);

/// With how many samples a series has an error.
struct SamplesForError {
  int samples = 0;
  bool is_measured = false;  ///< `point` has it
  std::size_t point = 0;     ///< else the measured point next to it
  Measured error;
  double seconds = 0;  ///< building and tracing
};

/// The fewest samples, of those that are measured and of whole quarters of a power of two between
/// and beyond them, whose error is at most `goal`, to the upper end of the interval. Between points
/// by the line through the two next to it, beyond the last by the slope of the series, up to 64
/// times its samples. Nothing where that does not do.
std::optional<SamplesForError> samples_for(double goal, const Series& series,
                                           std::span<const Point> points);

/// Round errors, from 20 % to .1 %, that the points reach or nearly reach, and `wanted` if there is
/// one.
std::vector<double> worthwhile_goals(std::span<const Point> points, std::optional<double> wanted);

/// The quickest way to an error among the series of the scene's own depth; the scene's own way, the
/// first series, where no other is quicker beyond the noise of times. Its seconds are of the next
/// time it is built and traced.
std::optional<Recommendation> recommend(double goal, std::span<const Series> series,
                                        std::span<const Point> points, const NoiseOfTime& noise);

}  // namespace sdlc::render
