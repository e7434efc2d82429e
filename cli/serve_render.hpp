#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
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

/// Renders one scene at a time, and pauses while nobody looks.
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

  ServeRender() = default;
  virtual ~ServeRender() = default;
  ServeRender(const ServeRender&) = delete;
  ServeRender& operator=(const ServeRender&) = delete;

  /// Before the first start().
  void set_handlers(Handlers handlers) { handlers_ = std::move(handlers); }

  // These are for one thread.

  /// Ends the render under way, and begins another.
  virtual void start(Order order, const Environment& env) = 0;
  /// Ends the render under way, within milliseconds.
  virtual void cancel() = 0;
  virtual Progress progress() const = 0;

  // These are for any thread.

  virtual void set_watched(bool is_watched) = 0;
  /// Whether pictures have features and variance before they are finished.
  void set_wants_channels(bool wants) { wants_channels_ = wants; }

 protected:
  /// Shows a smaller picture of one sample per pixel first, unless the picture is small.
  void show_first_look(const Order& order, render::RenderMonitor& monitor);
  /// Shows the picture after a pass, but not more often than pages can show it.
  void show_pass(const Order& order, const render::Film& film,
                 const std::function<render::ErrorSoFar()>& error);
  void show_finished(const Order& order, render::RenderResult result);
  /// Does the work of a render on its thread. Reports a failure, and then returns false.
  bool report(const Order& order, const Environment& env, const std::function<void()>& work);
  /// The progress of a render that has begun so many seconds ago.
  static Progress progress_of(const render::RenderSettings& settings,
                              const render::RenderMonitor& monitor, double seconds);

 private:
  Handlers handlers_;
  render::Clock::time_point next_{};  // when the next pass may be shown
  std::atomic<bool> wants_channels_{false};
};

}  // namespace sdlc::cli
