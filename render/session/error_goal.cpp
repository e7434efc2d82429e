#include "render/session/error_goal.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "render/film/film.hpp"

namespace sdlc::render {
namespace {

constexpr std::uint64_t kFirst = 32;

/// The first step after `samples`; steps begin with kFirst.
std::uint64_t step_after(std::uint64_t samples) noexcept {
  std::uint64_t step = kFirst;
  while (step <= samples) {
    step += std::max<std::uint64_t>(kReplicates, step / 8 / kReplicates * kReplicates);
  }
  return step;
}

GoalPass pass_of(std::uint64_t samples, const ErrorEstimate& estimate) noexcept {
  const auto square = [](double v) { return v * v; };
  return {.samples = samples,
          .from = square(estimate.interval.from),
          .to = square(estimate.interval.to),
          .estimate = square(estimate.relative_error),
          .is_blind = 0};
}

bool is_step(std::uint64_t samples) noexcept { return step_after(samples - 1) == samples; }

}  // namespace

double min_error(double error, double more_samples) noexcept {
  return error * std::pow(more_samples, -0.75);
}

double usual_growth(double part) noexcept { return std::pow(part, -1 / 0.57); }

std::uint64_t ErrorGoal::first_samples() const noexcept { return std::min(kFirst, max_samples_); }

std::uint64_t ErrorGoal::samples_after(std::uint64_t samples) const noexcept {
  return std::min(step_after(samples), max_samples_);
}

ErrorEstimate ErrorGoal::settled(std::uint64_t samples, const ErrorEstimate& estimate) const {
  constexpr std::uint64_t kSettled = 4;
  constexpr double kHeavy = 2;
  double count = 0, from = 0, to = 0;
  bool is_heavy = false;
  const auto add = [&](const GoalPass& pass) {
    // As with independent samples. With Sobol' points the error falls faster.
    const double fall = static_cast<double>(pass.samples) / static_cast<double>(samples);
    count += 1;
    from += pass.from * fall;
    to += pass.to * fall;
    is_heavy = is_heavy || pass.to > kHeavy * pass.estimate;
  };
  for (const GoalPass& pass : passes_) {
    const bool is_earlier = pass.samples < samples && is_step(pass.samples);
    if (is_earlier && pass.samples * kSettled >= samples) add(pass);
  }
  add(pass_of(samples, estimate));
  if (!is_heavy) return estimate;
  ErrorEstimate settled = estimate;
  settled.interval = {std::min(estimate.interval.from, std::sqrt(from / count)),
                      std::max(estimate.interval.to, std::sqrt(to / count))};
  return settled;
}

void ErrorGoal::record(std::uint64_t samples, const ErrorEstimate& estimate, bool is_blind) {
  // A pass that the maximum or the time cut short is none of a render that goes on.
  std::erase_if(passes_, [&](const GoalPass& pass) {
    return pass.samples >= samples || !is_step(pass.samples);
  });
  passes_.push_back(pass_of(samples, estimate));
  passes_.back().is_blind = is_blind ? 1 : 0;
}

bool ErrorGoal::is_blind() const noexcept {
  if (passes_.empty()) return false;
  const std::uint64_t octave = std::bit_floor(passes_.back().samples);
  return std::ranges::any_of(
      passes_, [&](const GoalPass& pass) { return pass.samples >= octave && pass.is_blind != 0; });
}

}  // namespace sdlc::render
