#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/image/tone.hpp"
#include "render/scene/scene.hpp"
#include "render/session/render.hpp"

/// Messages about the accuracy of a picture.
namespace sdlc::cli {

/// "64 samples", or the min and max per pixel.
std::string describe_samples(const render::RenderResult& result);

/// The end of the final line: the relative error with its interval, and the share of paths that the
/// depth limit cut; empty if neither is known.
std::string describe_error(const render::RenderResult& result);

/// ", light sampling on, 12 lights": what "auto" chose; empty without a choice.
std::string describe_light_choice(const render::Kernel& kernel);

/// Reasons why the picture may be less accurate than stated or requested.
std::vector<std::string> accuracy_warnings(const render::RenderSettings& settings,
                                           const render::RenderResult& result);

/// The metadata of picture files; keys have the prefix "sdlc:". `mapping` is nullopt for a file
/// with linear radiance.
std::vector<std::pair<std::string, std::string>> picture_metadata(
    const render::RenderSettings& settings, const render::RenderResult& result,
    const std::optional<render::ToneMapping>& mapping);

}  // namespace sdlc::cli
