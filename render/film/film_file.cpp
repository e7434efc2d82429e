#include "render/film/film_file.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "render/film/merge_films.hpp"

namespace sdlc::render {

namespace fs = std::filesystem;
using Reason = FilmError::Reason;

FilmError::FilmError(Reason reason, const fs::path& path, const std::string& cause)
    : std::runtime_error("`" + path.string() + "`: " + cause), reason_(reason) {}

void add_film(StoredFilm& into, const StoredFilm& film, const fs::path& path) {
  const auto foreign = [&](const std::string& cause) {
    throw FilmError(Reason::Foreign, path, "the film is of another picture: " + cause);
  };
  const std::string other = difference(film.origin, into.origin);
  if (!other.empty()) foreign(other);
  if (film.lights != into.lights) foreign("other lights are sampled");
  if (film.exact_spheres != into.exact_spheres) foreign("other spheres are computed in double");
  if (film.emitters.size() != into.emitters.size()) foreign("it has other emitters");
  if (film.targets != into.targets) foreign("its pixels have other numbers of samples");
  std::vector<const Film*> all;
  for (const Film& each : into.films) all.push_back(&each);
  for (const Film& each : film.films) all.push_back(&each);
  try {
    into.films = merge_films(std::move(all));
  } catch (const DoubledSample& doubled) {
    const std::uint64_t x = doubled.pixel() % into.origin.width;
    const std::uint64_t y = doubled.pixel() / into.origin.width;
    throw FilmError(Reason::Doubled, path,
                    "the film has samples that another one has: sample " +
                        std::to_string(doubled.sample()) + " of the pixel at (" +
                        std::to_string(x) + ", " + std::to_string(y) + ")");
  }
  into.statistics.rays += film.statistics.rays;
  into.statistics.truncated_paths += film.statistics.truncated_paths;
  into.statistics.nonfinite_samples += film.statistics.nonfinite_samples;
  for (std::size_t i = 0; i < into.emitters.size(); ++i) {
    EmitterCount& count = into.emitters[i];
    const int paths = int{count.paths} + int{film.emitters[i].paths};
    count.paths = static_cast<std::uint8_t>(std::min(int{count.enough}, paths));
  }
}

}  // namespace sdlc::render
