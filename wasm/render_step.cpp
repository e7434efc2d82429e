#include "wasm/render_step.hpp"

#include <chrono>
#include <utility>

namespace sdlc::wasm {

render::RenderResult render_step(const render::PreparedScene& scene,
                                 const render::RenderSettings& settings,
                                 render::RenderMonitor& monitor, render::StoredFilm& film,
                                 render::Clock::time_point start, double seconds) {
  const auto deadline = render::Clock::now() + std::chrono::duration<double>(seconds);
  // Not before there is progress: to begin may take longer than the step.
  const auto stop_when_due = [&] {
    if (render::Clock::now() >= deadline && monitor.samples_done > 0) monitor.cancel = true;
  };
  monitor.shows_passes = true;
  monitor.before_tile = stop_when_due;
  monitor.on_pass = [&, shown = std::move(monitor.on_pass)](const render::Film& passes,
                                                            const auto& error) {
    if (shown) shown(passes, error);
    stop_when_due();
  };
  return render::render(scene, settings, monitor, &film, start);
}

}  // namespace sdlc::wasm
