#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "cli/environment.hpp"
#include "render/film/film.hpp"
#include "render/image/tone.hpp"
#include "render/math/clock.hpp"
#include "render/scene/scene.hpp"
#include "render/session/prepared_scene.hpp"
#include "render/session/render.hpp"

namespace sdlc::cli {

/// A picture at one state of its render. Immutable.
struct ServedPicture {
  std::uint64_t scene = 0;  ///< the number of the scene that it shows
  render::RenderSettings settings;
  render::ToneMapping mapping;
  /// Its picture is smaller than that of the settings for a first look. It has features and
  /// variance only if they are wanted, or if it is finished.
  render::RenderResult result;
  bool is_finished = false;
  double seconds = 0;  ///< since the scene changed

  int width() const noexcept { return settings.window().width; }
  int height() const noexcept { return settings.window().height; }
  bool is_first_look() const noexcept {
    return result.picture.width != width() || result.picture.height != height();
  }
};

/// Renders one scene at a time on a thread of its own, and pauses while nobody looks.
class ServeRender {
 public:
  struct Order {
    std::uint64_t scene = 0;
    std::shared_ptr<const render::PreparedScene> prepared;
    render::RenderSettings settings;
    render::ToneMapping mapping;
    render::Clock::time_point start;  ///< when the scene changed
  };
  struct Progress {
    bool is_running = false;
    bool is_paused = false;
    double share = 0;  ///< from 0 to 1
    double seconds_left = 0;
  };
  /// Called on the thread of the render. A `failure` ends the render.
  struct Handlers {
    std::function<void(std::shared_ptr<const ServedPicture> picture)> shown;
    std::function<void(std::uint64_t scene, std::string failure)> failed;
  };

  explicit ServeRender(Handlers handlers) : handlers_(std::move(handlers)) {}
  ~ServeRender() { cancel(); }
  ServeRender(const ServeRender&) = delete;
  ServeRender& operator=(const ServeRender&) = delete;

  // These are for one thread.

  /// Ends the render under way, and begins another.
  void start(Order order, const Environment& env);
  /// Ends the render under way, within milliseconds.
  void cancel();
  Progress progress() const;

  // These are for any thread.

  void set_watched(bool is_watched);
  /// Whether pictures have features and variance before they are finished.
  void set_wants_channels(bool wants) { wants_channels_ = wants; }

 private:
  void run(const Order& order);
  void show_first_look(const Order& order);
  void show_pass(const Order& order, const render::Film& film,
                 const std::function<render::ErrorSoFar()>& error);
  void wait_until_watched();
  std::shared_ptr<ServedPicture> new_picture(const Order& order) const;
  bool is_cancelled() const noexcept { return monitor_->cancel.load(); }

  Handlers handlers_;
  std::unique_ptr<render::RenderMonitor> monitor_;  // of the render under way
  std::thread thread_;
  render::RenderSettings settings_;
  render::Clock::time_point start_{}, next_{};
  std::atomic<double> paused_{0};  // seconds
  std::atomic<bool> is_running_{false}, is_paused_{false}, wants_channels_{false};
  std::mutex mutex_;
  std::condition_variable watched_;
  std::atomic<bool> is_watched_{false};
};

}  // namespace sdlc::cli
