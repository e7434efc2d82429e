#pragma once

#include <optional>

#include "cli/environment.hpp"
#include "cli/serve_render.hpp"
#include "render/film/film_file.hpp"
#include "render/session/render.hpp"

namespace sdlc::wasm {

/// Renders in steps on the thread that calls, which reads messages between them.
class ServeRenderSteps : public cli::ServeRender {
 public:
  void start(Order order, const cli::Environment& env) override;
  void cancel() override;
  Progress progress() const override;
  void set_watched(bool is_watched) override { is_watched_ = is_watched; }

  bool has_work() const noexcept { return job_ && is_watched_; }
  /// Goes on for about so many seconds. Precondition: has_work().
  void step(double seconds);

 private:
  struct Job {
    Order order;
    cli::Environment env;
    render::StoredFilm film;
    bool has_looked = false;
    double seconds = 0;         ///< in steps
    std::uint64_t samples = 0;  ///< so far
    double goal_share = 0;
  };

  /// Returns true after the last step.
  bool trace(Job& job, double seconds);

  std::optional<Job> job_;
  bool is_watched_ = false;
};

}  // namespace sdlc::wasm
