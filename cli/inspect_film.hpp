#pragma once

#include <string>

namespace sdlc::cli {

/// What a film file holds, as text for people or as JSON. Throws IoError and FilmError.
std::string inspect_film(const std::string& path, bool is_json);

}  // namespace sdlc::cli
