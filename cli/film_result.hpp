#pragma once

#include "render/film/film_file.hpp"
#include "render/session/render.hpp"

namespace sdlc::cli {

/// result_of() a film that was read. Throws std::bad_alloc if its picture does not fit into memory.
render::RenderResult film_result(const render::StoredFilm& film);

}  // namespace sdlc::cli
