#include "cli/measure/against_earlier.hpp"

#include <algorithm>

namespace sdlc::cli {

render::Comparison compare_with_earlier(
    const render::Measurement& measurement,
    const std::vector<std::pair<std::string, std::string>>& machine,
    const EarlierMeasurement& earlier) {
  const bool is_same_machine = earlier.machine == machine && earlier.threads == measurement.threads;
  render::Comparison comparison =
      compare_measurements(measurement.points, earlier.points, is_same_machine);
  comparison.earlier = earlier.version;
  std::vector<std::string>& notes = comparison.notes;
  if (!is_same_machine) {
    notes.emplace_back(
        "it was made with another machine, kernel or number of threads: times are not compared");
  }
  if (!earlier.is_complete) notes.emplace_back("it was interrupted, and holds only some points");
  if (earlier.seed != measurement.seed) notes.emplace_back("it has a different seed");
  if (comparison.points.empty()) {
    notes.emplace_back("the two have no point in common; a larger --budget gives more of them");
  } else if (!comparison.time_ratio && is_same_machine) {
    notes.emplace_back("fewer than three common points: times are not compared");
  }
  return comparison;
}

bool is_worse(const render::Comparison& comparison) {
  return comparison.time == render::Verdict::Worse ||
         std::ranges::count(comparison.points, render::Verdict::Worse,
                            &render::PointChange::error) > 0;
}

}  // namespace sdlc::cli
