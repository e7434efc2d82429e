#include "cli/serve_render_thread.hpp"

#include <cmath>
#include <functional>
#include <utility>

#include "render/film/film.hpp"

namespace sdlc::cli {

void ServeRenderThread::start(Order order, const Environment& env) {
  stop();
  monitor_ = std::make_unique<render::RenderMonitor>();
  settings_ = order.settings;
  start_ = render::Clock::now();
  paused_ = 0;
  is_running_ = true;
  thread_ = std::thread([this, order = std::move(order), env] {
    report(order, env, [&] { run(order); });
    is_running_ = false;
  });
}

void ServeRenderThread::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    monitor_->cancel = true;
  }
  watched_.notify_all();
  thread_.join();
}

ServeRender::Progress ServeRenderThread::progress() const {
  if (!is_running_) return {};
  Progress progress =
      progress_of(settings_, *monitor_, render::seconds_since(start_) - paused_.load());
  progress.is_paused = is_paused_;
  if (progress.is_paused) progress.seconds_left = HUGE_VAL;
  return progress;
}

void ServeRenderThread::set_watched(bool is_watched) {
  {
    const std::lock_guard lock(mutex_);
    is_watched_ = is_watched;
  }
  watched_.notify_all();
}

void ServeRenderThread::wait_until_watched() {
  if (is_watched_ || is_cancelled()) return;
  std::unique_lock lock(mutex_);
  const auto start = render::Clock::now();
  is_paused_ = true;
  watched_.wait(lock, [&] { return is_watched_ || is_cancelled(); });
  if (is_paused_.exchange(false)) paused_ = paused_.load() + render::seconds_since(start);
}

void ServeRenderThread::run(const Order& order) {
  monitor_->keeps_cancelled = false;
  monitor_->before_tile = [this] { wait_until_watched(); };
  wait_until_watched();
  show_first_look(order, *monitor_);
  monitor_->shows_passes = true;
  monitor_->on_pass = [&](const render::Film& film,
                          const std::function<render::ErrorSoFar()>& error) {
    wait_until_watched();
    if (!is_cancelled()) show_pass(order, film, error);
  };
  render::RenderResult result = render::render(*order.prepared, order.settings, *monitor_);
  if (result.is_complete) show_finished(order, std::move(result));
}

}  // namespace sdlc::cli
