#include "render/session/shards.hpp"

#include <algorithm>

namespace sdlc::render {
namespace {

/// Of one replicate.
std::uint64_t blocks_of(const RenderSettings& settings) noexcept {
  const std::uint32_t replicates = extent_of(settings).replicates;
  const auto samples = static_cast<std::uint64_t>(settings.samples);
  const std::uint64_t of_first = (samples + replicates - 1) / replicates;
  return (of_first + SampleSum::kBlock - 1) / SampleSum::kBlock;
}

}  // namespace

std::uint64_t max_shards(const RenderSettings& settings, ShardCut cut) noexcept {
  const std::uint64_t parts =
      cut == ShardCut::Samples ? blocks_of(settings) : extent_of(settings).pixels;
  return std::min<std::uint64_t>(parts, kMaxShards);
}

FilmPart shard(const RenderSettings& settings, ShardCut cut, std::uint32_t index,
               std::uint32_t count) noexcept {
  FilmPart part{.extent = extent_of(settings)};
  const auto cut_at = [&](std::uint64_t whole, std::uint32_t i) { return whole * i / count; };
  if (cut == ShardCut::Tiles) {
    const std::uint64_t pixels = part.extent.pixels;
    part.extent.first_pixel = cut_at(pixels, index - 1);
    part.extent.pixels = static_cast<std::size_t>(cut_at(pixels, index) - part.extent.first_pixel);
    return part;
  }
  const std::uint64_t blocks = blocks_of(settings);
  const auto sample_at = [&](std::uint32_t i) {
    return static_cast<std::uint32_t>(cut_at(blocks, i) * SampleSum::kBlock);
  };
  part.extent.first_sample = sample_at(index - 1);
  if (index < count) part.end_sample = sample_at(index);
  return part;
}

std::uint64_t samples_in(const FilmPart& part, const RenderSettings& settings) noexcept {
  std::uint64_t samples = 0;
  for (const std::uint32_t count : counts_in(part, static_cast<std::uint64_t>(settings.samples))) {
    samples += count;
  }
  return samples * part.extent.pixels;
}

}  // namespace sdlc::render
