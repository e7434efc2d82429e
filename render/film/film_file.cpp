#include "render/film/film_file.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "render/film/merge_films.hpp"

namespace sdlc::render {

namespace fs = std::filesystem;
using Reason = FilmError::Reason;

FilmError::FilmError(Reason reason, const fs::path& path, const std::string& cause)
    : std::runtime_error("`" + path.string() + "`: " + cause), reason_(reason), cause_(cause) {}

std::string difference(const StoredFilm& film, const StoredFilm& expected) {
  std::string of_origin = difference(film.origin, expected.origin);
  if (!of_origin.empty()) return of_origin;
  if (film.lights != expected.lights || film.casters != expected.casters) {
    return "other lights are sampled";
  }
  if (film.exact_spheres != expected.exact_spheres) return "other spheres are computed in double";
  if (!std::ranges::equal(film.emitters, expected.emitters, {}, &EmitterCount::enough,
                          &EmitterCount::enough)) {
    return "it has other emitters";
  }
  return {};
}

std::vector<std::uint32_t> missing_shards(const StoredFilm& film) {
  std::vector<std::uint32_t> missing;
  for (std::uint32_t shard = 1; shard <= film.record.shards; ++shard) {
    if (!std::ranges::binary_search(film.shards, shard)) missing.push_back(shard);
  }
  return missing;
}

void add_film(StoredFilm& into, const StoredFilm& film, const fs::path& path) {
  const auto foreign = [&](const std::string& cause) {
    throw FilmError(Reason::Foreign, path, "the film is of another picture: " + cause);
  };
  const std::string other = difference(film, into);
  if (!other.empty()) foreign(other);
  const std::string other_record = difference(film.record, into.record);
  if (!other_record.empty()) foreign(other_record);
  if (film.targets != into.targets) foreign("its pixels have other numbers of samples");
  std::vector<std::uint32_t> shards;
  std::ranges::set_intersection(film.shards, into.shards, std::back_inserter(shards));
  if (!shards.empty()) {
    throw FilmError(Reason::Doubled, path,
                    "another film has shard " + std::to_string(shards.front()) + ", too");
  }
  std::vector<const Film*> all;
  for (const Film& each : into.films) all.push_back(&each);
  for (const Film& each : film.films) all.push_back(&each);
  try {
    into.films = merge_films(std::move(all));
  } catch (const DoubledSample& doubled) {
    const PixelWindow& crop = into.origin.crop;
    const auto row = static_cast<std::uint64_t>(crop.width);
    const std::uint64_t x = static_cast<std::uint64_t>(crop.x) + doubled.pixel() % row;
    const std::uint64_t y = static_cast<std::uint64_t>(crop.y) + doubled.pixel() / row;
    throw FilmError(Reason::Doubled, path,
                    "the film has samples that another one has: sample " +
                        std::to_string(doubled.sample()) + " of the pixel at (" +
                        std::to_string(x) + ", " + std::to_string(y) + ")");
  }
  std::ranges::set_union(film.shards, into.shards, std::back_inserter(shards));
  into.shards = std::move(shards);
  into.statistics += film.statistics;
  for (std::size_t i = 0; i < into.emitters.size(); ++i) {
    EmitterCount& count = into.emitters[i];
    const int paths = int{count.paths} + int{film.emitters[i].paths};
    count.paths = static_cast<std::uint8_t>(std::min(int{count.enough}, paths));
  }
}

}  // namespace sdlc::render
