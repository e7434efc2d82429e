#include "cli/measure/notes.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "cli/report/figures.hpp"

namespace sdlc::cli {

std::vector<std::string> notes_of(const render::Measurement& measurement) {
  std::vector<std::string> notes;
  if (measurement.nonfinite_samples > 0) {
    notes.push_back(fmt::format("{} samples were not finite and were left out: a bug in sdlc.",
                                measurement.nonfinite_samples));
  }
  if (!measurement.thread_pictures_are_same) {
    notes.emplace_back("Pictures differ between numbers of threads: a bug in sdlc.");
  }
  if (!measurement.is_complete) {
    notes.emplace_back("interrupted: some planned renders are missing.");
  }
  if (measurement.width != measurement.full_width ||
      measurement.height != measurement.full_height) {
    notes.push_back(fmt::format(
        "measured at {} × {} pixels, while the scene has {} × {}: errors are about the same, times "
        "grow with the number of pixels.",
        measurement.width, measurement.height, measurement.full_width, measurement.full_height));
  }
  if (!measurement.reference) return notes;
  if (measurement.points.empty()) {
    notes.emplace_back("There was only time for the reference. A longer --budget measures points.");
  }
  if (const std::uint64_t scarce = measurement.reference->scarce_emitters; scarce > 0) {
    notes.push_back(fmt::format(
        "{} emissive sphere{} reached by very few paths of the reference: light may be missing in "
        "it, and all errors too small. A longer --budget finds the light, unless it is hidden.",
        scarce, scarce == 1 ? " was" : "s were"));
  }
  const bool has_unclear = std::ranges::any_of(measurement.points, [](const render::Point& point) {
    return point.error.interval.from == 0 && point.error.interval.to > 0;
  });
  if (has_unclear) {
    notes.emplace_back(
        "Some errors cannot be distinguished from 0: the reference is not accurate enough. A "
        "longer --budget makes a better one.");
  }
  if (!measurement.depths.empty() && !measurement.depths_have_converged) {
    notes.push_back(fmt::format(
        "The light lost by depth is a lower bound: paths deeper than {} may carry more, and were "
        "not measured. A longer --budget goes deeper.",
        measurement.depths.back().depth));
  }
  const bool has_goal = std::ranges::any_of(
      measurement.recommendations,
      [&](const render::Recommendation& any) { return any.goal == measurement.goal; });
  if (measurement.goal && !has_goal) {
    notes.push_back(
        fmt::format("No number of samples can be predicted for the requested error of {}: it is "
                    "too far from the measured points. A longer --budget gets nearer.",
                    percent(*measurement.goal)));
  }
  return notes;
}

render::Comparison compare_with_earlier(const render::Measurement& measurement,
                                        const Provenance& provenance,
                                        const EarlierMeasurement& earlier) {
  const render::Measurement& before = earlier.measurement;
  const bool is_same_machine =
      earlier.provenance.machine == provenance.machine && before.threads == measurement.threads;
  render::Comparison comparison =
      compare_measurements(measurement.points, before.points, is_same_machine);
  comparison.version = earlier.provenance.version;
  std::vector<std::string>& notes = comparison.notes;
  if (!is_same_machine) {
    notes.emplace_back(
        "it was made with another machine, kernel or number of threads: times are not compared");
  }
  if (!before.is_complete) notes.emplace_back("it was interrupted, and holds only some points");
  if (before.seed != measurement.seed) notes.emplace_back("it has a different seed");
  if (comparison.points.empty()) {
    notes.emplace_back("the two have no point in common; a larger --budget gives more of them");
  } else if (!comparison.time_ratio && is_same_machine) {
    notes.emplace_back("fewer than three common points: times are not compared");
  }
  return comparison;
}

}  // namespace sdlc::cli
