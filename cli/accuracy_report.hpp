#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/image/tone.hpp"
#include "render/scene/scene.hpp"
#include "render/tiles/render.hpp"

/// What users are told of how accurate a picture is.
namespace sdlc::cli {

/// "64 samples", or how many at least and at most.
std::string describe_samples(const render::RenderResult& result);

/// For the end of the closing line: the relative error with its interval, and what the depth limit
/// cut; empty where neither is known.
std::string describe_error(const render::RenderResult& result);

/// Why the picture may be less accurate than it says, or than was asked for.
std::vector<std::string> accuracy_warnings(const render::RenderSettings& settings,
                                           const render::RenderResult& result);

/// What picture files say of themselves; keys carry the prefix "sdlc:". `tone` is that of the
/// codes; nothing where the file holds linear radiance.
std::vector<std::pair<std::string, std::string>> picture_metadata(
    const render::RenderSettings& settings, const render::RenderResult& result,
    std::optional<render::Tone> tone);

}  // namespace sdlc::cli
