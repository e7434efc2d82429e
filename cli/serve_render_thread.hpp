#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "cli/environment.hpp"
#include "cli/serve_render.hpp"
#include "render/math/clock.hpp"
#include "render/scene/scene.hpp"
#include "render/session/render.hpp"

namespace sdlc::cli {

/// Renders on a thread of its own.
class ServeRenderThread : public ServeRender {
 public:
  ServeRenderThread() = default;
  ~ServeRenderThread() override { stop(); }
  ServeRenderThread(const ServeRenderThread&) = delete;
  ServeRenderThread& operator=(const ServeRenderThread&) = delete;

  void start(Order order, const Environment& env) override;
  void cancel() override { stop(); }
  Progress progress() const override;
  void set_watched(bool is_watched) override;

 private:
  void stop();
  void run(const Order& order);
  void wait_until_watched();
  bool is_cancelled() const noexcept { return monitor_->cancel.load(); }

  std::unique_ptr<render::RenderMonitor> monitor_;  // of the render under way
  std::thread thread_;
  render::RenderSettings settings_;
  render::Clock::time_point start_{};
  std::atomic<double> paused_{0};  // seconds
  std::atomic<bool> is_running_{false}, is_paused_{false};
  std::mutex mutex_;
  std::condition_variable watched_;
  std::atomic<bool> is_watched_{false};
};

}  // namespace sdlc::cli
