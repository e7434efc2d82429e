#include "cli/measure/notes.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "cli/report/figures.hpp"

namespace sdlc::cli {

std::vector<std::string> notes_of(const render::Measurement& measurement) {
  std::vector<std::string> notes;
  if (measurement.nonfinite_samples > 0) {
    notes.push_back(fmt::format("{} samples were not finite and were left out: a defect of sdlc.",
                                measurement.nonfinite_samples));
  }
  if (!measurement.reference) return notes;
  if (measurement.points.empty()) {
    notes.emplace_back(
        "There was no time for any point beside the reference. A longer --budget has some.");
  }
  if (const std::uint64_t scarce = measurement.reference->scarce_emitters; scarce > 0) {
    notes.push_back(fmt::format(
        "{} emissive sphere{} hardly reached by the reference's own paths: light may be missing "
        "in it, and every error too small. A longer --budget finds it, if it is not hidden.",
        scarce, scarce == 1 ? " was" : "s were"));
  }
  const bool has_unclear = std::ranges::any_of(measurement.points, [](const render::Point& point) {
    return point.error.interval.from == 0 && point.error.interval.to > 0;
  });
  if (has_unclear) {
    notes.emplace_back(
        "Some errors are not told from none: the reference is too rough for them. A longer "
        "--budget makes a better one.");
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
    notes.push_back(fmt::format(
        "No number of samples is known for the error of {} that was asked for: it is too far "
        "from all that was measured. A longer --budget gets nearer.",
        percent(*measurement.goal)));
  }
  return notes;
}

}  // namespace sdlc::cli
