#include "cli/progress.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "cli/numbers/format_numbers.hpp"
#include "render/math/clock.hpp"

namespace sdlc::cli {

std::uint64_t total_samples(const render::RenderSettings& settings) {
  return settings.window().pixels() * static_cast<std::uint64_t>(settings.samples);
}

ProgressReporter::ProgressReporter(ProgressStyle style, const render::RenderMonitor& monitor,
                                   const render::RenderSettings& settings, std::ostream& out,
                                   ProgressPart part)
    : style_(style),
      monitor_(monitor),
      has_goal_(settings.has_goal()),
      total_(static_cast<double>(part.samples.value_or(total_samples(settings)))),
      out_(out),
      part_(std::move(part)) {
  if (style_ == ProgressStyle::None) return;
  try {
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error&) {
    // Continue without progress.
  }
}

ProgressReporter::~ProgressReporter() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_done_ = true;
  }
  wake_.notify_one();
  thread_.join();
  if (part_.share < 1) report();
}

void ProgressReporter::run() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, std::chrono::milliseconds(100), [&] { return is_done_; })) report();
}

void ProgressReporter::report() {
  constexpr double kPlainSeconds = 10, kLineSeconds = 0.1;
  ProgressSchedule& schedule = *part_.schedule;
  const double seconds = render::seconds_since(schedule.start);
  const auto samples = static_cast<double>(monitor_.samples_done.load());
  const double of_part = has_goal_ ? monitor_.goal_share.load() : samples / total_;
  const double rays_per_second =
      static_cast<double>(monitor_.rays_done.load()) / render::seconds_since(start_);
  const double fraction = part_.before + part_.share * of_part;
  const double left = fraction > 0 ? seconds * (1 - fraction) / fraction : HUGE_VAL;

  if (style_ == ProgressStyle::Json) {
    if (seconds < schedule.next_seconds) return;
    schedule.next_seconds = seconds + 1;
    out_ << fmt::format(R"({{"fraction": {:.4f}, "part": "{}", "samples": {:.0f}, )"
                        R"("rays_per_second": {:.0f}, "seconds": {:.1f}, "eta_seconds": {}}})",
                        fraction, part_.label, samples, rays_per_second, seconds,
                        std::isfinite(left) ? fmt::format("{:.1f}", left) : "null")
         << std::endl;
    return;
  }
  if (style_ == ProgressStyle::OpenJd) {
    if (seconds < schedule.next_seconds) return;
    schedule.next_seconds = seconds + 5;
    std::string status = part_.label;
    if (samples > 0) {
      status += fmt::format("{}{} samples/s", status.empty() ? "" : ", ",
                            format_count(samples / render::seconds_since(start_)));
    }
    out_ << fmt::format("openjd_progress: {:.1f}\nopenjd_status: {}", 100 * fraction, status)
         << std::endl;
    return;
  }
  std::string text = fmt::format("{:5.1f} %", 100 * fraction);
  if (!part_.label.empty()) text += "  " + part_.label;
  if (samples > 0) {
    text += fmt::format("  {} samples  {} rays/s", format_count(samples),
                        format_count(rays_per_second));
  }
  if (std::isfinite(left)) text += fmt::format("  {} left", format_seconds(left));
  if (style_ == ProgressStyle::Line) {
    if (seconds < schedule.next_line) return;
    schedule.line->show(text);
    schedule.next_line = seconds + kLineSeconds;
  } else if (fraction >= schedule.next_fraction &&
             seconds >= std::max(schedule.next_seconds, kPlainSeconds)) {
    out_ << text << std::endl;
    schedule.next_fraction = fraction + 0.05;
    schedule.next_seconds = seconds + kPlainSeconds;
  }
}

}  // namespace sdlc::cli
