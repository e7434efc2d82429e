#include "cli/serve_render.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <sstream>
#include <utility>

#include "cli/report_failure.hpp"

namespace sdlc::cli {
namespace {

/// A picture of more pixels than this is first shown with fewer.
constexpr double kFirstLook = 48'000;

/// The settings of a smaller picture of one sample per pixel.
render::RenderSettings first_look_of(render::RenderSettings settings) {
  const double pixels = static_cast<double>(settings.width) * settings.height;
  const double scale = std::sqrt(kFirstLook / pixels);
  settings.width = std::max(1, static_cast<int>(std::lround(settings.width * scale)));
  settings.height = std::max(1, static_cast<int>(std::lround(settings.height * scale)));
  settings.samples = 1;
  settings.error.reset();
  settings.seconds.reset();
  settings.is_adaptive = settings.is_denoised = false;
  settings.keeps_variance = settings.keeps_first_hits = false;
  return settings;
}

}  // namespace

void ServeRender::start(Order order, const Environment& env) {
  cancel();
  monitor_ = std::make_unique<render::RenderMonitor>();
  settings_ = order.settings;
  start_ = render::Clock::now();
  paused_ = 0;
  next_ = {};
  is_running_ = true;
  thread_ = std::thread([this, order = std::move(order), env]() mutable {
    std::ostringstream messages;
    Environment quiet = env.with_err(messages);
    ExitCode code = ExitCode::Usage;
    try {
      code = report_failure(quiet, [&] {
        run(order);
        return ExitCode::Success;
      });
    } catch (const std::exception& error) {  // no thread could be started
      messages << "error: " << error.what() << '\n';
    }
    is_running_ = false;
    if (code != ExitCode::Success) handlers_.failed(order.scene, messages.str());
  });
}

void ServeRender::cancel() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    monitor_->cancel = true;
  }
  watched_.notify_all();
  thread_.join();
}

ServeRender::Progress ServeRender::progress() const {
  Progress progress{.is_running = is_running_.load(), .is_paused = is_paused_.load()};
  if (!progress.is_running) return progress;
  const double total =
      static_cast<double>(settings_.samples) * static_cast<double>(settings_.window().pixels());
  progress.share = settings_.has_goal()
                       ? monitor_->goal_share.load()
                       : std::min(1.0, static_cast<double>(monitor_->samples_done.load()) / total);
  const double seconds = render::seconds_since(start_) - paused_.load();
  progress.seconds_left = progress.is_paused   ? HUGE_VAL
                          : progress.share > 0 ? seconds * (1 - progress.share) / progress.share
                                               : HUGE_VAL;
  return progress;
}

void ServeRender::set_watched(bool is_watched) {
  {
    const std::lock_guard lock(mutex_);
    is_watched_ = is_watched;
  }
  watched_.notify_all();
}

void ServeRender::wait_until_watched() {
  if (is_watched_ || is_cancelled()) return;
  std::unique_lock lock(mutex_);
  const auto start = render::Clock::now();
  is_paused_ = true;
  watched_.wait(lock, [&] { return is_watched_ || is_cancelled(); });
  if (is_paused_.exchange(false)) paused_ = paused_.load() + render::seconds_since(start);
}

std::shared_ptr<ServedPicture> ServeRender::new_picture(const Order& order) const {
  auto picture = std::make_shared<ServedPicture>();
  picture->scene = order.scene;
  picture->settings = order.settings;
  picture->mapping = order.mapping;
  picture->seconds = render::seconds_since(order.start);
  return picture;
}

void ServeRender::show_first_look(const Order& order) {
  auto picture = new_picture(order);
  picture->result = render::render(*order.prepared, first_look_of(order.settings), *monitor_);
  if (is_cancelled()) return;
  monitor_->samples_done = monitor_->rays_done = 0;
  picture->seconds = render::seconds_since(order.start);
  handlers_.shown(std::move(picture));
}

void ServeRender::show_pass(const Order& order, const render::Film& film,
                            const std::function<render::ErrorSoFar()>& error) {
  constexpr std::chrono::milliseconds kPause(80);
  wait_until_watched();
  if (is_cancelled() || render::Clock::now() < next_) return;
  auto picture = new_picture(order);
  render::RenderResult& result = picture->result;
  result.kernel = order.prepared->kernel();
  result.picture = render::Picture(picture->width(), picture->height());
  for (std::size_t i = 0; i < film.size(); ++i) result.picture.pixels[i] = film.mean(i);
  const render::SampleCounts counts = film.sample_counts();
  result.min_samples = counts.min;
  result.max_samples = counts.max;
  if (counts.min != counts.max) {
    for (std::size_t i = 0; i < film.size(); ++i) {
      result.samples_of_pixels.push_back(static_cast<std::uint32_t>(film.samples(i)));
    }
  }
  const bool has_error = counts.min >= render::kMinReplicatedSamples;
  if (has_error) {
    render::ErrorSoFar known = error();
    result.error = known.error;
    result.rare_paths = std::move(known.rare_paths);
    result.scarce_emitters = std::move(known.scarce_emitters);
  }
  if (wants_channels_) {
    const int depth_exponent = order.prepared->tracer().depth_exponent();
    for (std::size_t i = 0; i < film.size(); ++i) {
      result.features.push_back(
          render::features_of(film.first_hits(i), film.samples(i), depth_exponent));
    }
    if (has_error) {
      result.variance = render::Picture(picture->width(), picture->height());
      for (std::size_t i = 0; i < film.size(); ++i) result.variance.pixels[i] = film.variance(i);
    }
  }
  handlers_.shown(std::move(picture));
  next_ = render::Clock::now() + kPause;
}

void ServeRender::run(const Order& order) {
  const render::RenderSettings& settings = order.settings;
  monitor_->keeps_cancelled = false;
  monitor_->before_tile = [this] { wait_until_watched(); };
  wait_until_watched();
  if (static_cast<double>(settings.width) * settings.height > 2 * kFirstLook) {
    show_first_look(order);
  }
  monitor_->shows_passes = true;
  monitor_->on_pass = [&](const render::Film& film,
                          const std::function<render::ErrorSoFar()>& error) {
    show_pass(order, film, error);
  };
  auto picture = new_picture(order);
  picture->result = render::render(*order.prepared, settings, *monitor_);
  if (!picture->result.is_complete) return;
  picture->is_finished = true;
  picture->seconds = render::seconds_since(order.start);
  handlers_.shown(std::move(picture));
}

}  // namespace sdlc::cli
