#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "render/film/film_file.hpp"
#include "render/image/picture.hpp"
#include "render/session/picture_tracer.hpp"
#include "render/session/render.hpp"

/// Pictures in parts: crops, shards and checkpoints.
namespace sdlc::render {

/// Some samples of some pixels.
struct FilmPart {
  FilmExtent extent;
  /// Of each replicate, the samples from FilmExtent::first_sample to here; a multiple of
  /// SampleSum::kBlock if a later part goes on.
  std::uint32_t end_sample = std::numeric_limits<std::uint32_t>::max();
};

/// How many samples a part has in each replicate of a pixel with `samples` samples.
ReplicateCounts counts_in(const FilmPart& part, std::uint64_t samples);

/// A film without samples, for renders with these settings. `digest`: digest_of_parts() of the
/// scene that was prepared. `program`: its name and version. `record`: what settings and kernel do
/// not say.
StoredFilm new_film(const PreparedScene& scene, const SceneDigest& digest, std::string program,
                    const RenderSettings& settings, PictureRecord record = {});

/// Throws std::invalid_argument if the film is not of these settings and this kernel. The scene and
/// the program are the caller's to compare: difference() with a new_film().
void check_origin(const PreparedScene& scene, const RenderSettings& settings,
                  const StoredFilm& stored);
/// The film with the extent of the part. It takes over films of fewer pixels with the same first
/// sample, and is added if there is none. Throws std::invalid_argument if another film has some of
/// its samples.
Film& film_of(const FilmPart& part, StoredFilm& stored);
/// Adds to `stored` the samples of a part that it lacks. Each pixel of the picture has the same
/// number of `samples`, or there is one number per pixel; the goals of `settings` are ignored. A
/// film with the extent of the part, or of some of its pixels, is continued; otherwise one is
/// added. Returns false if `monitor` cancelled it: some samples are then missing, and a second call
/// adds them. Throws std::invalid_argument as check_origin() and film_of() do.
///
/// Parts that are joined by add_film() have the bits of a render of the whole picture.
bool render_part(const PreparedScene& scene, const RenderSettings& settings, RenderMonitor& monitor,
                 const FilmPart& part, std::span<const std::uint32_t> samples, StoredFilm& stored);

/// The result of a render with these samples, as render() would return it. Without all samples it
/// is not complete: pixels have the mean of those that are there, and are black without any.
/// Nothing is denoised.
RenderResult result_of(const StoredFilm& stored);
/// The settings with which result_of() was rendered.
RenderSettings settings_of(const StoredFilm& stored);

}  // namespace sdlc::render
