#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "render/film/film.hpp"

namespace sdlc::test {

using render::Channels;
using render::Film;
using render::FilmExtent;
using render::kReplicates;
using render::LinearRgb;
using render::OpenPixels;
using render::PixelRun;
using render::ReplicateCounts;

/// The radiance of a sample, different in each pixel, replicate and channel.
inline LinearRgb sample(std::uint64_t pixel, std::uint32_t replicate, std::uint32_t index) {
  const auto phase = static_cast<double>(pixel);
  const double v = std::exp(3 * std::sin(11 * phase + 7.0 * replicate + index));
  return {v, 2 * v, std::sqrt(v)};
}

/// Brings the pixels of a film to these counts, by pixel of the film, as a kernel does.
inline void trace_samples(Film& film, std::span<const ReplicateCounts> counts,
                          std::uint32_t max_blocks = 3) {
  film.reserve(counts);
  OpenPixels open(film, 0, film.size(), [&](std::size_t pixel) { return counts[pixel]; });
  while (true) {
    std::vector<PixelRun> runs;
    open.plan(max_blocks, runs);
    if (runs.empty()) break;
    for (PixelRun& run : runs) {
      for (std::uint32_t r = 0; r < kReplicates; ++r) {
        PixelRun::Part& part = run.parts[r];
        for (std::uint32_t i = 0; i < part.count; ++i) {
          part.sum += sample(run.pixel, r, part.first + i);
        }
      }
      if (run.first_hits != nullptr) {
        for (std::uint64_t i = 0; i < run.samples(); ++i) {
          const double v = static_cast<double>(run.pixel + 1) / 10;
          run.first_hits->add({.normal = {v, -v, 0.1}, .depth = v * 0x1p80, .albedo = {v, 1, 0}});
        }
      }
      open.add(run);
    }
  }
  open.close();
}

/// The samples of a part of a picture, of which each pixel has `totals` samples.
inline Film traced_film(const FilmExtent& extent, std::span<const std::uint32_t> totals,
                        std::uint32_t end_sample = 0xFFFFFFC0,
                        Channels channels = Channels::ColorAndFirstHits) {
  Film film(extent, channels);
  std::vector<ReplicateCounts> counts;
  for (std::size_t i = 0; i < extent.pixels; ++i) {
    ReplicateCounts of_pixel = render::split_in_replicates(totals[extent.first_pixel + i]);
    for (std::uint32_t& count : of_pixel) {
      const std::uint32_t end = std::min(count, end_sample);
      count = end - std::min(extent.first_sample, end);
    }
    counts.push_back(of_pixel);
  }
  trace_samples(film, counts);
  return film;
}

/// The counts and the values of all sums.
inline std::vector<double> content_of(const Film& film) {
  std::vector<double> content{static_cast<double>(film.extent().first_pixel),
                              static_cast<double>(film.extent().first_sample)};
  for (std::size_t pixel = 0; pixel < film.size(); ++pixel) {
    if (film.channels() != Channels::Color && film.samples(pixel) > 0) {
      const render::FirstHitSums& hits = film.first_hits(pixel);
      content.insert(content.end(), {static_cast<double>(hits.hits()), hits.mean_depth(),
                                     hits.mean_normal(1).y, hits.mean_albedo(1).r});
    }
    for (std::uint32_t r = 0; r < film.extent().replicates; ++r) {
      content.push_back(film.count(pixel, r));
      for (const LinearRgb& value : film.sum(pixel, r).values()) {
        content.insert(content.end(), {value.r, value.g, value.b});
      }
    }
  }
  return content;
}

}  // namespace sdlc::test
