#pragma once

#include <cstddef>
#include <ostream>
#include <vector>

#include "cli/command_line.hpp"
#include "cli/outputs.hpp"
#include "render/film/aov.hpp"
#include "render/scene/scene.hpp"
#include "render/session/render.hpp"

/// `sdlc render --aov`: auxiliary channels in EXR files.
namespace sdlc::cli {

void add_aov_option(Command& command, render::Aovs& aovs);

/// Throws UsageError if the requested channels are impossible. Called before anything is rendered.
void check_aovs(const render::Aovs& aovs, const std::vector<Output>& outputs,
                const render::RenderSettings& settings);

/// Memory of the channels and of their inputs while the picture is encoded.
std::size_t aov_bytes(const render::Aovs& aovs, std::size_t pixels) noexcept;

/// The requested layers. Unavailable ones are left out, with a message on `err`: the variance with
/// fewer than 8 samples per pixel or beyond the range of floats, and, for a render that was
/// interrupted without a goal, variance and samples.
std::vector<render::Layer> picture_layers(const render::Aovs& aovs,
                                          const render::RenderSettings& settings,
                                          const render::RenderResult& result, std::ostream& err);

}  // namespace sdlc::cli
