#include "wasm/serve_render_steps.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "render/math/clock.hpp"
#include "render/session/render_film.hpp"
#include "wasm/render_step.hpp"

namespace sdlc::wasm {

void ServeRenderSteps::start(Order order, const cli::Environment& env) {
  job_.reset();  // before the next: both may not fit into memory
  render::StoredFilm film = render::new_film(*order.prepared, {}, "sdlc", order.settings);
  job_.emplace(Job{.order = std::move(order), .env = env, .film = std::move(film)});
}

void ServeRenderSteps::cancel() { job_.reset(); }

cli::ServeRender::Progress ServeRenderSteps::progress() const {
  if (!job_) return {};
  render::RenderMonitor monitor;
  monitor.samples_done = job_->samples;
  monitor.goal_share = job_->goal_share;
  Progress progress = progress_of(job_->order.settings, monitor, job_->seconds);
  progress.is_paused = !is_watched_;
  return progress;
}

void ServeRenderSteps::step(double seconds) {
  const auto start = render::Clock::now();
  bool is_finished = false;
  const bool has_worked =
      report(job_->order, job_->env, [&] { is_finished = trace(*job_, seconds); });
  if (is_finished || !has_worked) {
    job_.reset();
  } else {
    job_->seconds += render::seconds_since(start);
  }
}

bool ServeRenderSteps::trace(Job& job, double seconds) {
  const Order& order = job.order;
  if (!std::exchange(job.has_looked, true)) {
    render::RenderMonitor monitor;
    show_first_look(order, monitor);
  }
  render::RenderMonitor monitor;
  monitor.on_pass = [&](const render::Film& film,
                        const std::function<render::ErrorSoFar()>& error) {
    show_pass(order, film, error);
  };
  render::RenderResult result =
      render_step(*order.prepared, order.settings, monitor, job.film, order.start, seconds);
  job.samples = result.camera_samples;
  job.goal_share = std::max(job.goal_share, monitor.goal_share.load());
  if (!result.is_complete) return false;
  show_finished(order, std::move(result));
  return true;
}

}  // namespace sdlc::wasm
