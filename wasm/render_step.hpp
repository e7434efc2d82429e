#pragma once

#include "render/film/film_file.hpp"
#include "render/math/clock.hpp"
#include "render/scene/scene.hpp"
#include "render/session/prepared_scene.hpp"
#include "render/session/render.hpp"

namespace sdlc::wasm {

/// Goes on with the render of `film`, by render(), for about so many seconds, and at least until
/// some samples are traced. Shows passes. The steps do not change the picture. The monitor must be
/// new; its `on_pass` may be set.
render::RenderResult render_step(const render::PreparedScene& scene,
                                 const render::RenderSettings& settings,
                                 render::RenderMonitor& monitor, render::StoredFilm& film,
                                 render::Clock::time_point start, double seconds);

}  // namespace sdlc::wasm
