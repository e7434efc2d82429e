#pragma once

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "render/film/film.hpp"

namespace sdlc::render {

/// Two films have a sample in common.
class DoubledSample : public std::runtime_error {
 public:
  DoubledSample(std::uint64_t pixel, std::uint32_t sample);

  std::uint64_t pixel() const noexcept { return pixel_; }    ///< row by row from the top left
  std::uint32_t sample() const noexcept { return sample_; }  ///< index in its replicate

 private:
  std::uint64_t pixel_;
  std::uint32_t sample_;
};

/// Throws DoubledSample if two films have a sample in common.
void check_no_sample_is_doubled(std::vector<const Film*> films);

/// Joins films of one picture, with the same number of replicates, into as few as possible: one for
/// each first sample. Where all samples of a pixel from the first on are present, the sums have the
/// bits of a film that was traced at once. The result depends neither on the order of the films nor
/// on how they were joined before. Pixels without samples are dropped. Throws DoubledSample.
std::vector<Film> merge_films(std::vector<const Film*> films);

}  // namespace sdlc::render
