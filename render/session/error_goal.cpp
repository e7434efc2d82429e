#include "render/session/error_goal.hpp"

#include <algorithm>
#include <cmath>

#include "render/film/film.hpp"

namespace sdlc::render {
namespace {

std::uint64_t whole_replicates(std::uint64_t samples) {
  return (samples + kReplicates - 1) / kReplicates * kReplicates;
}

}  // namespace

double min_error(double error, double more_samples) noexcept {
  return error * std::pow(more_samples, -0.75);
}

double usual_growth(double part) noexcept { return std::pow(part, -1 / 0.57); }

std::uint64_t ErrorGoal::first_samples() const noexcept {
  constexpr std::uint64_t kFirst = 32;
  return std::min(kFirst, max_samples_);
}

ErrorEstimate ErrorGoal::settled(std::uint64_t samples, const ErrorEstimate& estimate) {
  constexpr std::uint64_t kSettled = 4;
  constexpr double kHeavy = 2;
  const auto square = [](double v) { return v * v; };
  if (!passes_.empty() && passes_.back().samples == samples) passes_.pop_back();
  passes_.push_back({.samples = samples,
                     .from = square(estimate.interval.from),
                     .to = square(estimate.interval.to),
                     .estimate = square(estimate.relative_error)});
  double count = 0, from = 0, to = 0;
  bool is_heavy = false;
  for (const Pass& pass : passes_) {
    if (pass.samples * kSettled < samples) continue;
    // As with independent samples. With Sobol' points the error falls faster.
    const double fall = static_cast<double>(pass.samples) / static_cast<double>(samples);
    count += 1;
    from += pass.from * fall;
    to += pass.to * fall;
    is_heavy = is_heavy || pass.to > kHeavy * pass.estimate;
  }
  if (!is_heavy) return estimate;
  ErrorEstimate settled = estimate;
  settled.interval = {std::min(estimate.interval.from, std::sqrt(from / count)),
                      std::max(estimate.interval.to, std::sqrt(to / count))};
  return settled;
}

std::optional<std::uint64_t> ErrorGoal::next_samples(std::uint64_t samples,
                                                     const ErrorEstimate& estimate) {
  is_reached_ = samples >= kMinReplicatedSamples && estimate.interval.to <= error_;
  if (is_reached_ || samples >= max_samples_) return std::nullopt;

  const auto now = static_cast<double>(samples);
  if (samples >= 2 * earlier_samples_) {  // over a shorter distance the slope is mostly noise
    const double slope = std::log(estimate.relative_error / earlier_error_) /
                         std::log(now / static_cast<double>(earlier_samples_));
    if (earlier_samples_ > 0 && std::isfinite(slope)) {
      constexpr double kSteepest = -1.5, kFlattest = -0.4;
      slope_ = std::clamp(slope, kSteepest, kFlattest);
    }
    earlier_samples_ = samples;
    earlier_error_ = estimate.relative_error;
  }
  const double wanted = now * std::pow(error_ / estimate.interval.to, 1 / slope_);
  const std::uint64_t limit =
      std::min(samples + std::max<std::uint64_t>(samples / 4, kReplicates), max_samples_);
  if (!(wanted < static_cast<double>(limit)))
    return std::min(whole_replicates(limit), max_samples_);
  return std::min(whole_replicates(std::max(static_cast<std::uint64_t>(wanted), samples + 1)),
                  max_samples_);
}

}  // namespace sdlc::render
