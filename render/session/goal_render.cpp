#include "render/session/goal_render.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "render/parallel/parallel_for.hpp"
#include "render/session/adaptive_samples.hpp"

namespace sdlc::render {

bool has_unseen_error(const RenderResult& result, const EmitterTally& emitters) {
  if (!result.error || !emitters.is_counting()) return false;
  const double unseen = unseen_error(emitters.rare(), result.error->mean,
                                     result.picture.pixels.size(), result.min_samples);
  return unseen > result.error->interval.to / 2;
}

ErrorSoFar known_error(const RenderResult& result, const EmitterTally& emitters) {
  // Where no path found light and some were cut off, nothing is known of the error, which is
  // relative to the light.
  const bool is_cut_to_black =
      result.error && result.error->mean == 0 && result.truncated_paths > 0;
  if (is_cut_to_black || has_unseen_error(result, emitters)) {
    return {.error = {}, .rare_paths = emitters.rare(), .scarce_emitters = emitters.scarce()};
  }
  return {.error = result.error, .rare_paths = {}, .scarce_emitters = emitters.scarce()};
}

bool may_see_more(const ErrorGoal& goal, const EmitterTally& emitters, std::uint64_t samples) {
  // Limited, because a kind of path that was never found may be occluded everywhere.
  constexpr std::uint64_t kMaxBlindSamples = 1024;
  return goal.is_blind() && (samples < kMaxBlindSamples ||
                             std::ranges::none_of(emitters.rare(), [](const RarePath& path) {
                               return path.paths < EmitterTally::kWitnesses;
                             }));
}

GoalRender::GoalRender(PictureTracer& tracer, const RenderSettings& settings,
                       const EmitterTally& emitters, Clock::time_point start,
                       RenderMonitor& monitor, Film& film, RenderResult& result)
    : tracer_(tracer),
      settings_(settings),
      emitters_(emitters),
      monitor_(monitor),
      result_(result),
      start_(start),
      film_(film) {
  if (settings.error && !settings.is_adaptive) {
    goal_.emplace(*settings.error, static_cast<std::uint64_t>(settings.samples));
  }
  if (!settings.seconds) return;
  deadline_ = start + std::chrono::duration_cast<Clock::duration>(
                          std::chrono::duration<double>(std::min(*settings.seconds, 1e9)));
}

void GoalRender::resume(std::vector<std::uint32_t> targets, std::vector<GoalPass> passes) {
  targets_ = std::move(targets);
  if (goal_) goal_->restore(std::move(passes));
}

bool GoalRender::is_late() const {
  // The first pass is always finished: a picture must not have holes.
  return deadline_ && !is_first_pass_ && Clock::now() >= *deadline_;
}

bool GoalRender::pass(std::span<const std::uint32_t> samples) {
  std::vector<ReplicateCounts> counts;
  counts.reserve(samples.size());
  for (const std::uint32_t of_pixel : samples) counts.push_back(split_in_replicates(of_pixel));
  film_.reserve(counts);
  const bool is_whole = tracer_.trace_pass(
      film_, [&](std::size_t pixel) { return counts[counts.size() == 1 ? 0 : pixel]; },
      [this] { return is_late(); });
  is_first_pass_ = false;
  if (deadline_) reserve_time_to_finish();
  if (monitor_.on_pass) monitor_.on_pass(film_, [this] { return error_so_far(); });
  if (deadline_) {
    report_progress(std::chrono::duration<double>(Clock::now() - start_).count() /
                    *settings_.seconds);
  }
  return is_whole && !is_late();
}

std::vector<std::uint32_t> GoalRender::samples_of_film() const {
  std::vector<std::uint32_t> samples(film_.size());
  for (std::size_t i = 0; i < film_.size(); ++i) {
    samples[i] = static_cast<std::uint32_t>(film_.samples(i));
  }
  return samples;
}

void GoalRender::report_progress(double share) {
  monitor_.goal_share = std::max(monitor_.goal_share.load(), std::min(share, 1.0));
}

void GoalRender::reserve_time_to_finish() {
  // Late enough for the caller's modules to be loaded, and early enough: a pass with at most four
  // times as many samples ends before the limit. Only an adaptive one may be longer.
  constexpr double kShare = 0.125;
  const auto begin = Clock::now();
  const bool is_soon = seconds_since(start_) < kShare * *settings_.seconds;
  if (is_time_reserved_ || (is_soon && !settings_.is_adaptive)) return;
  if (denoiser_ != nullptr && film_.sample_counts().min < kMinReplicatedSamples) return;
  is_time_reserved_ = true;
  estimate();
  double seconds = seconds_since(begin);
  if (monitor_.seconds_to_finish) seconds += monitor_.seconds_to_finish(result_.picture);
  *deadline_ -= std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

void GoalRender::estimate() {
  estimate_plain();
  if (denoiser_ != nullptr && result_.error) denoiser_->denoise(film_, spreads_, result_);
  unsettled_ = result_.error;
  if (goal_ && result_.error) {
    result_.error = goal_->settled(result_.min_samples, *result_.error);
  }
}

void GoalRender::estimate_plain() {
  spreads_.resize(film_.size());
  const SampleCounts counts = film_.sample_counts();
  result_.min_samples = counts.min;
  result_.max_samples = counts.max;
  const bool is_known = result_.min_samples >= kMinReplicatedSamples;
  constexpr std::size_t kPixelsPerTask = 1024;
  const auto put = [&](std::size_t i) {
    result_.picture.pixels[i] = film_.mean(i);
    if (is_known) spreads_[i] = film_.spread(i);
  };
  parallel_for(film_.size(), put, kPixelsPerTask);
  result_.error.reset();
  result_.plain_error.reset();
  if (is_known) result_.error = estimate_error(result_.picture, spreads_);
}

ErrorSoFar GoalRender::error_so_far() {
  estimate_plain();
  // A look after each pass is what settling is for.
  if (goal_ && result_.error) {
    result_.error = goal_->settled(result_.min_samples, *result_.error);
  }
  put_counts(tracer_.counts(), result_);
  return known_error(result_, emitters_);
}

void GoalRender::run() {
  if (settings_.error && settings_.is_adaptive) {
    run_adaptive();
  } else {
    run_uniform();
  }
  if (monitor_.is_dropped()) return;
  estimate();
  result_.has_reached_error = settings_.error && result_.error &&
                              result_.error->interval.to <= *settings_.error &&
                              !(goal_ && may_see_more(*goal_, emitters_, result_.min_samples));
  if (result_.min_samples != result_.max_samples) {
    result_.samples_of_pixels = samples_of_film();
  }
  if (settings_.keeps_variance && result_.error) {
    result_.variance = Picture(settings_.window().width, settings_.window().height);
    for (std::size_t i = 0; i < film_.size(); ++i) {
      result_.variance.pixels[i] = film_.variance(i);
    }
    result_.spreads = std::move(spreads_);
  }
}

void GoalRender::run_uniform() {
  const auto max_samples = static_cast<std::uint64_t>(settings_.samples);
  // Without an error goal the first pass is as short as possible, and is finished.
  std::optional<std::uint64_t> samples =
      goal_ && !monitor_.shows_passes ? goal_->first_samples() : 1;
  // A pass that was cancelled is finished before it is judged.
  samples = std::max(*samples, film_.sample_counts().max);
  while (samples) {
    const auto of_pixel = static_cast<std::uint32_t>(*samples);
    if (!pass(std::span(&of_pixel, 1))) return;
    if (goal_ && *samples >= goal_->first_samples()) {
      estimate();
      if (!result_.error) return;
      const double to_go = *settings_.error / result_.error->interval.to;
      report_progress(to_go * to_go);
      goal_->record(*samples, *unsettled_, has_unseen_error(result_, emitters_));
      const bool is_done =
          goal_->is_reached(*result_.error) && !may_see_more(*goal_, emitters_, *samples);
      if (is_done || *samples >= max_samples) return;
      samples = goal_->samples_after(*samples);
    } else if (*samples >= max_samples) {
      return;
    } else {
      const std::uint64_t next =
          *samples < kMinReplicatedSamples
              ? (*samples < kReplicates ? kReplicates : kMinReplicatedSamples)
              : *samples +
                    std::max<std::uint64_t>(kReplicates, *samples / 4 / kReplicates * kReplicates);
      samples = std::min(next, goal_ ? goal_->first_samples() : max_samples);
    }
  }
}

void GoalRender::run_adaptive() {
  // First what a cancelled pass lacks: the next passes then are those of a render at once.
  if (!targets_.empty()) return run_adaptive(std::move(targets_));
  const auto max_samples = static_cast<std::uint64_t>(settings_.samples);
  const auto pilot =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(kPilotSamples, max_samples));
  if (!pass(std::span(&pilot, 1))) return;
  estimate();
  if (!result_.error || result_.error->interval.to <= *settings_.error) return;
  if (result_.max_samples > pilot) return run_adaptive(samples_of_film());
  // The confidence interval has a width at the end, so the estimate itself has to be lower than the
  // goal.
  const double width = result_.error->relative_error / result_.error->interval.to;
  std::vector<std::uint32_t> samples =
      adaptive_samples(spreads_, *result_.error, settings_.window().width, *settings_.error * width,
                       settings_.sampler, pilot, max_samples);
  run_adaptive(std::move(samples));
}

void GoalRender::run_adaptive(std::vector<std::uint32_t> samples) {
  const auto max_samples = static_cast<std::uint64_t>(settings_.samples);
  targets_ = std::move(samples);
  while (pass(targets_)) {
    estimate();
    if (!result_.error) return;
    const double left = result_.error->interval.to / *settings_.error;
    report_progress(1 / (left * left));
    if (left <= 1 || result_.min_samples >= max_samples) return;
    // Scale all by the same factor: the error falls at least with the square root of the samples.
    const double factor = std::clamp(left * left, 1.02, 1.25);
    for (std::uint32_t& n : targets_) {
      const double wanted = std::ceil(n * factor / kReplicates) * kReplicates;
      n = static_cast<std::uint32_t>(std::min(wanted, static_cast<double>(max_samples)));
    }
  }
}

}  // namespace sdlc::render
