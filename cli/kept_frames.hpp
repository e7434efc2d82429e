#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "render/film/film_file.hpp"
#include "render/image/picture.hpp"
#include "render/image/tone.hpp"

namespace sdlc::cli {

/// The finished frames of a video, in a folder beside it: a render that was interrupted goes on
/// from them. Each is a PNG file with the film's origin and record, so that a frame of another
/// scene is not taken.
class KeptFrames {
 public:
  /// `zoom`: how often a pixel of the film is repeated in each direction.
  KeptFrames(const std::filesystem::path& video, int zoom);

  const std::filesystem::path& folder() const noexcept { return folder_; }
  /// The checkpoint of a frame that is being rendered.
  std::filesystem::path film(int frame) const;

  /// The codes of a frame of `film`, as VideoWriter::add() takes them; nullopt if the frame was not
  /// kept. Throws FilmError if the kept one is of another picture, and IoError.
  std::optional<std::vector<std::uint8_t>> find(int frame, const render::StoredFilm& film) const;
  /// Makes the folder. `picture`: enlarged. Throws IoError.
  void keep(int frame, const render::StoredFilm& film, const render::Picture& picture,
            const render::ToneMapping& mapping) const;
  /// Removes these frames, and the folder if it is empty then.
  void remove(const std::vector<int>& frames) const;

 private:
  std::filesystem::path picture(int frame) const;

  std::filesystem::path folder_;
  int zoom_;
};

}  // namespace sdlc::cli
