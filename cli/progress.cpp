#include "cli/progress.hpp"

#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "cli/numbers/format_numbers.hpp"

namespace sdlc::cli {

std::uint64_t total_samples(const render::RenderSettings& settings) {
  return static_cast<std::uint64_t>(settings.width) * static_cast<std::uint64_t>(settings.height) *
         static_cast<std::uint64_t>(settings.samples);
}

ProgressReporter::ProgressReporter(ProgressStyle style, const render::RenderMonitor& monitor,
                                   const render::RenderSettings& settings, std::ostream& err)
    : style_(style),
      monitor_(monitor),
      has_goal_(settings.has_goal()),
      total_(static_cast<double>(total_samples(settings))),
      err_(err),
      next_seconds_(style == ProgressStyle::Json ? 1 : 10) {
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
  if (has_line_) err_ << "\r\x1b[K" << std::flush;
}

void ProgressReporter::run() {
  const auto start = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, std::chrono::milliseconds(100), [&] { return is_done_; })) {
    report(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
}

void ProgressReporter::report(double seconds) {
  const auto samples = static_cast<double>(monitor_.samples_done.load());
  const double fraction = has_goal_ ? monitor_.goal_share.load() : samples / total_;
  const double rays_per_second = static_cast<double>(monitor_.rays_done.load()) / seconds;
  const double left = fraction > 0 ? seconds * (1 - fraction) / fraction : HUGE_VAL;

  if (style_ == ProgressStyle::Json) {
    if (seconds < next_seconds_) return;
    next_seconds_ += 1;
    err_ << fmt::format(R"({{"fraction": {:.4f}, "samples": {:.0f}, "rays_per_second": {:.0f}, )"
                        R"("seconds": {:.1f}, "eta_seconds": {}}})",
                        fraction, samples, rays_per_second, seconds,
                        std::isfinite(left) ? fmt::format("{:.1f}", left) : "null")
         << std::endl;
    return;
  }
  const std::string text =
      fmt::format("{:5.1f} %  {} samples  {} rays/s  {}", 100 * fraction, format_count(samples),
                  format_count(rays_per_second),
                  std::isfinite(left) ? format_seconds(left) + " left" : std::string());
  if (style_ == ProgressStyle::Line) {
    err_ << '\r' << text << "\x1b[K" << std::flush;
    has_line_ = true;
  } else if (fraction >= next_fraction_ && seconds >= next_seconds_) {
    err_ << text << std::endl;
    next_fraction_ = fraction + 0.05;
    next_seconds_ = seconds + 10;
  }
}

}  // namespace sdlc::cli
