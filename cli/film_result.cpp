#include "cli/film_result.hpp"

#include <cstddef>
#include <new>

#include "cli/environment.hpp"
#include "render/session/render_film.hpp"

namespace sdlc::cli {

render::RenderResult film_result(const render::StoredFilm& film) {
  // The picture, its variance and spread, channels, and the encoded file.
  constexpr std::size_t kBytesPerPixel = 256;
  if (film.origin.crop.pixels() > physical_memory_bytes() / kBytesPerPixel) throw std::bad_alloc();
  return result_of(film);
}

}  // namespace sdlc::cli
