#pragma once

#include <cstdint>

#include "render/film/picture_record.hpp"
#include "render/scene/scene.hpp"
#include "render/session/render_film.hpp"

/// Shards: the parts of a picture that different machines render.
namespace sdlc::render {

/// The largest number of shards that all have samples.
std::uint64_t max_shards(const RenderSettings& settings, ShardCut cut) noexcept;

/// The samples of shard `index`, from 1, of `count`, which is at most max_shards(). The settings
/// have no goal.
FilmPart shard(const RenderSettings& settings, ShardCut cut, std::uint32_t index,
               std::uint32_t count) noexcept;

/// The number of samples of a part.
std::uint64_t samples_in(const FilmPart& part, const RenderSettings& settings) noexcept;

}  // namespace sdlc::render
