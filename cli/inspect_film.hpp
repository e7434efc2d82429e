#pragma once

#include <string>

#include "render/film/film_file.hpp"

namespace sdlc::cli {

/// Throws std::bad_alloc if the picture of the film does not fit into memory.
void check_film_memory(const render::StoredFilm& film);

/// What a film file holds, as text for people or as JSON. Throws IoError and FilmError.
std::string inspect_film(const std::string& path, bool is_json);

}  // namespace sdlc::cli
