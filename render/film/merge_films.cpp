#include "render/film/merge_films.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>

namespace sdlc::render {
namespace {

using Films = std::vector<const Film*>;

/// The counts of a pixel in each replicate; zeros where the film does not have the pixel.
ReplicateCounts counts_of(const Film& film, std::uint64_t pixel) {
  ReplicateCounts counts{};
  const FilmExtent& extent = film.extent();
  if (pixel < extent.first_pixel || pixel - extent.first_pixel >= extent.pixels) return counts;
  for (std::uint32_t r = 0; r < kReplicates; ++r) {
    counts[r] = film.count(static_cast<std::size_t>(pixel - extent.first_pixel), r);
  }
  return counts;
}

/// Consecutive samples of one pixel, in several films.
struct Chain {
  Films films;
  std::uint32_t first = 0;
  ReplicateCounts counts{};

  bool is_empty() const { return films.empty(); }

  void begin(const Film& film, const ReplicateCounts& added) {
    films.assign(1, &film);
    first = film.extent().first_sample;
    counts = added;
  }

  /// Appends the samples in `film`. Returns false, and changes nothing, if some are missing
  /// before them.
  bool append(const Film& film, const ReplicateCounts& added) {
    const std::uint32_t next = film.extent().first_sample;
    for (std::uint32_t r = 0; r < kReplicates; ++r) {
      if (added[r] > 0 && first + counts[r] != next) return false;
    }
    for (std::uint32_t r = 0; r < kReplicates; ++r) {
      if (added[r] > 0) counts[r] = next + added[r] - first;
    }
    films.push_back(&film);
    return true;
  }
};

/// Calls `visit` with each chain of the pixel, in the order of samples. Throws DoubledSample.
template <typename Visit>
void for_each_chain(const Films& films, std::uint64_t pixel, Visit visit) {
  Chain chain;
  ReplicateCounts ends{};
  for (const Film* film : films) {
    const ReplicateCounts added = counts_of(*film, pixel);
    if (added == ReplicateCounts{}) continue;
    const std::uint32_t first = film->extent().first_sample;
    for (std::uint32_t r = 0; r < kReplicates; ++r) {
      if (added[r] == 0) continue;
      if (ends[r] > first) throw DoubledSample(pixel, first);
      ends[r] = first + added[r];
    }
    if (!chain.is_empty() && chain.append(*film, added)) continue;
    if (!chain.is_empty()) visit(chain);
    chain.begin(*film, added);
  }
  if (!chain.is_empty()) visit(chain);
}

/// The pixels of the chains with one first sample.
struct Plan {
  std::uint64_t begin = std::numeric_limits<std::uint64_t>::max(), end = 0;
  std::vector<ReplicateCounts> counts;  // by pixel, from the first of all pixels

  void add(std::uint64_t pixel, std::uint64_t offset, const ReplicateCounts& of_pixel) {
    begin = std::min(begin, pixel);
    end = std::max(end, pixel + 1);
    if (counts.size() <= offset) counts.resize(offset + 1);
    counts[offset] = of_pixel;
  }
};

void sort_by_sample(Films& films) {
  std::ranges::sort(films, {}, [](const Film* film) { return film->extent().first_sample; });
}

struct PixelRange {
  std::uint64_t begin = std::numeric_limits<std::uint64_t>::max(), end = 0;
};
/// From the first to the last pixel of the films.
PixelRange pixels_of(const Films& films) {
  PixelRange range;
  for (const Film* film : films) {
    range.begin = std::min(range.begin, film->extent().first_pixel);
    range.end = std::max(range.end, film->extent().first_pixel + film->extent().pixels);
  }
  return range;
}

/// Writes the sums of a chain to the pixel of a film that has room for them.
void join(const Chain& chain, std::uint64_t pixel, Film& film) {
  const auto pixel_in = [&](const Film& of) {
    return static_cast<std::size_t>(pixel - of.extent().first_pixel);
  };
  std::array<LinearRgb, 2 * std::numeric_limits<std::uint32_t>::digits + 1> values;
  for (std::uint32_t r = 0; r < film.extent().replicates; ++r) {
    if (chain.counts[r] == 0) continue;
    SampleSum sum(values, chain.first, chain.first);
    for (const Film* part : chain.films) {
      const std::size_t at = pixel_in(*part);
      if (part->count(at, r) > 0) sum.append(part->sum(at, r));
    }
    film.set(pixel_in(film), r, sum);
  }
  if (film.channels() == Channels::Color) return;
  for (const Film* part : chain.films) {
    film.first_hits(pixel_in(film)) += part->first_hits(pixel_in(*part));
  }
}

}  // namespace

DoubledSample::DoubledSample(std::uint64_t pixel, std::uint32_t sample)
    : std::runtime_error("sample " + std::to_string(sample) + " of pixel " + std::to_string(pixel) +
                         " is present twice"),
      pixel_(pixel),
      sample_(sample) {}

void check_no_sample_is_doubled(Films films) {
  if (films.size() < 2) return;
  sort_by_sample(films);
  const PixelRange pixels = pixels_of(films);
  for (std::uint64_t pixel = pixels.begin; pixel < pixels.end; ++pixel) {
    for_each_chain(films, pixel, [](const Chain&) {});
  }
}

std::vector<Film> merge_films(Films films) {
  if (films.empty()) return {};
  sort_by_sample(films);
  const auto [begin, end] = pixels_of(films);
  std::map<std::uint32_t, Plan> plans;  // by first sample
  for (std::uint64_t pixel = begin; pixel < end; ++pixel) {
    for_each_chain(films, pixel, [&, begin = begin](const Chain& chain) {
      plans[chain.first].add(pixel, pixel - begin, chain.counts);
    });
  }

  std::vector<Film> merged;
  std::map<std::uint32_t, std::size_t> places;
  for (const auto& [first, plan] : plans) {
    places[first] = merged.size();
    merged.emplace_back(FilmExtent{.first_pixel = plan.begin,
                                   .pixels = static_cast<std::size_t>(plan.end - plan.begin),
                                   .first_sample = first,
                                   .replicates = films.front()->extent().replicates},
                        films.front()->channels());
    merged.back().reserve(plan.counts);
  }
  for (std::uint64_t pixel = begin; pixel < end; ++pixel) {
    for_each_chain(films, pixel,
                   [&](const Chain& chain) { join(chain, pixel, merged[places[chain.first]]); });
  }
  return merged;
}

}  // namespace sdlc::render
