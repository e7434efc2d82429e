#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/film/film.hpp"
#include "render/film/film_origin.hpp"
#include "render/film/goal_pass.hpp"
#include "render/film/picture_record.hpp"
#include "render/film/trace_counts.hpp"
#include "render/shading/emitter_tally.hpp"

/// Films on disk. docs/decisions/0021 describes the format.
namespace sdlc::render {

/// Films of one picture with all that a render needs to go on.
struct StoredFilm {
  FilmOrigin origin;
  PictureRecord record;
  /// Those that are finished, from 1 to PictureRecord::shards, ascending.
  std::vector<std::uint32_t> shards;
  TraceCounts statistics;
  std::vector<std::uint32_t> lights;         ///< Kernel::lights
  std::vector<std::uint32_t> casters;        ///< Kernel::casters
  std::vector<std::uint32_t> exact_spheres;  ///< Kernel::exact_spheres
  EmitterClasses emitter_classes;            ///< without the classes of spheres
  std::vector<EmitterCount> emitters;        ///< EmitterTally::counts()
  std::vector<std::uint32_t> targets;        ///< samples of each pixel, if adaptive; else empty
  std::vector<GoalPass> passes;              ///< ErrorGoal::passes()
  std::vector<Film> films;
};

/// The first difference in what samples depend on, as a clause; empty if there is none.
std::string difference(const StoredFilm& film, const StoredFilm& expected);

/// The shards that the film lacks or has in part.
std::vector<std::uint32_t> missing_shards(const StoredFilm& film);

/// A film file that cannot be used. The message begins with the path.
class FilmError : public std::runtime_error {
 public:
  enum class Reason : std::uint8_t {
    NotAFilm,
    OtherVersion,  ///< of the format
    Damaged,
    Foreign,  ///< of another picture
    Doubled,  ///< has samples of another film
  };

  FilmError(Reason reason, const std::filesystem::path& path, const std::string& cause);

  Reason reason() const noexcept { return reason_; }
  /// The message without the path.
  const std::string& cause() const noexcept { return cause_; }

 private:
  Reason reason_;
  std::string cause_;
};

/// Replaces the file, or throws IoError and leaves it as it was.
void write_film_file(const std::filesystem::path& path, const StoredFilm& film);

/// Throws IoError or FilmError.
StoredFilm read_film_file(const std::filesystem::path& path);
/// What the beginning of a film file says.
struct FilmHead {
  PictureRecord record;
  std::vector<std::uint32_t> shards;  ///< StoredFilm::shards
};
FilmHead read_film_head(const std::filesystem::path& path);

/// Adds the samples of a film file to those of `into`. Throws FilmError, and leaves `into` as it
/// was, if the film is of another picture or has samples that `into` has.
void add_film(StoredFilm& into, const StoredFilm& film, const std::filesystem::path& path);

}  // namespace sdlc::render
