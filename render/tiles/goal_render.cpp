#include "render/tiles/goal_render.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/accuracy/adaptive_samples.hpp"
#include "render/accuracy/error_goal.hpp"

namespace sdlc::render {

bool has_unseen_error(const RenderResult& result, const EmitterTally& emitters) {
  if (!result.error || !emitters.is_counting()) return false;
  const double unseen = unseen_error(emitters.rare(), result.error->mean,
                                     result.picture.pixels.size(), result.least_samples);
  return unseen > result.error->interval.to / 2;
}

GoalRender::GoalRender(PictureTracer& tracer, const RenderSettings& settings,
                       const EmitterTally& emitters, Clock::time_point start,
                       RenderMonitor& monitor, RenderResult& result)
    : tracer_(tracer),
      settings_(settings),
      emitters_(emitters),
      monitor_(monitor),
      result_(result),
      start_(start),
      film_(0, result.picture.pixels.size()) {
  if (!settings.seconds) return;
  deadline_ = start + std::chrono::duration_cast<Clock::duration>(
                          std::chrono::duration<double>(std::min(*settings.seconds, 1e9)));
}

bool GoalRender::is_late() const {
  // The first pass is finished whatever it takes: a picture with holes is none.
  return deadline_ && !is_first_pass_ && Clock::now() >= *deadline_;
}

bool GoalRender::pass(std::uint64_t most, const Target& target) {
  const bool is_whole = tracer_.trace_pass(film_, most, target, [this] { return is_late(); });
  is_first_pass_ = false;
  if (deadline_) {
    tell_share(std::chrono::duration<double>(Clock::now() - start_).count() / *settings_.seconds);
  }
  return is_whole && !is_late();
}

void GoalRender::tell_share(double share) {
  monitor_.goal_share = std::max(monitor_.goal_share.load(), std::min(share, 1.0));
}

void GoalRender::estimate() {
  spreads_.resize(film_.size());
  result_.least_samples = result_.most_samples = film_.samples(0);
  for (std::size_t i = 1; i < film_.size(); ++i) {
    const std::uint64_t samples = film_.samples(i);
    result_.least_samples = std::min(result_.least_samples, samples);
    result_.most_samples = std::max(result_.most_samples, samples);
  }
  const bool is_known = result_.least_samples >= kLeastReplicatedSamples;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, film_.size(), 1024),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        result_.picture.pixels[i] = film_.mean(i);
                        if (is_known) spreads_[i] = film_.spread(i);
                      }
                    });
  result_.error.reset();
  if (is_known) result_.error = estimate_error(result_.picture, spreads_);
}

void GoalRender::run() {
  if (settings_.error && settings_.is_adaptive) {
    run_adaptive();
  } else {
    run_uniform();
  }
  estimate();
  result_.has_reached_error =
      settings_.error && result_.error && result_.error->interval.to <= *settings_.error;
  if (result_.least_samples != result_.most_samples) {
    result_.samples_of_pixels.resize(film_.size());
    for (std::size_t i = 0; i < film_.size(); ++i) {
      result_.samples_of_pixels[i] = static_cast<std::uint32_t>(film_.samples(i));
    }
  }
  if (settings_.keeps_variance && result_.error) {
    result_.variance = Picture(settings_.width, settings_.height);
    for (std::size_t i = 0; i < film_.size(); ++i) {
      result_.variance.pixels[i] = film_.variance(i);
    }
    result_.spreads = std::move(spreads_);
  }
}

void GoalRender::run_uniform() {
  const auto most = static_cast<std::uint64_t>(settings_.samples);
  ErrorGoal goal(settings_.error.value_or(0), most);
  // For time alone the first pass is as short as can be, and is whole.
  std::optional<std::uint64_t> samples = settings_.error ? goal.first_samples() : 1;
  while (samples && pass(*samples, [&](std::size_t) { return *samples; })) {
    if (settings_.error) {
      estimate();
      if (!result_.error) return;
      const double to_go = *settings_.error / result_.error->interval.to;
      tell_share(to_go * to_go);
      const std::uint64_t now = *samples;
      samples = goal.next_samples(now, *result_.error);
      if (goal.is_reached() && has_unseen_error(result_, emitters_)) {
        // Not for ever: a kind of path may be one that is hidden everywhere.
        constexpr std::uint64_t kMaxBlindSamples = 1024;
        const std::uint64_t next = std::min({2 * now, std::max(now, kMaxBlindSamples), most});
        if (next <= now) return;
        samples = next;
      }
    } else if (*samples >= most) {
      return;
    } else {
      const std::uint64_t next =
          *samples < kLeastReplicatedSamples
              ? (*samples < kReplicates ? kReplicates : kLeastReplicatedSamples)
              : *samples +
                    std::max<std::uint64_t>(kReplicates, *samples / 4 / kReplicates * kReplicates);
      samples = std::min(next, most);
    }
  }
}

void GoalRender::run_adaptive() {
  const auto most = static_cast<std::uint64_t>(settings_.samples);
  const std::uint64_t pilot = std::min<std::uint64_t>(kPilotSamples, most);
  if (!pass(pilot, [&](std::size_t) { return pilot; })) return;
  estimate();
  if (!result_.error || result_.error->interval.to <= *settings_.error) return;
  // The interval has some width when all is done: the estimate itself has to come down further.
  const double width = result_.error->relative_error / result_.error->interval.to;
  std::vector<std::uint32_t> samples =
      adaptive_samples(spreads_, *result_.error, settings_.width, *settings_.error * width,
                       settings_.sampler, static_cast<std::uint32_t>(pilot), most);
  while (pass(*std::ranges::max_element(samples), [&](std::size_t i) { return samples[i]; })) {
    estimate();
    if (!result_.error) return;
    const double left = result_.error->interval.to / *settings_.error;
    tell_share(1 / (left * left));
    if (left <= 1 || result_.least_samples >= most) return;
    // All of them by the same factor, as the error falls with the root of the samples, or faster.
    const double factor = std::clamp(left * left, 1.02, 1.25);
    for (std::uint32_t& n : samples) {
      const double wanted = std::ceil(n * factor / kReplicates) * kReplicates;
      n = static_cast<std::uint32_t>(std::min(wanted, static_cast<double>(most)));
    }
  }
}

}  // namespace sdlc::render
