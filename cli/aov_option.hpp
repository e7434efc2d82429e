#pragma once

#include <cstddef>
#include <ostream>
#include <vector>

#include "cli/command_line.hpp"
#include "cli/outputs.hpp"
#include "render/aov/aov.hpp"
#include "render/scene/scene.hpp"
#include "render/tiles/render.hpp"

/// `sdlc render --aov`: auxiliary channels in EXR files.
namespace sdlc::cli {

void add_aov_option(Command& command, render::Aovs& aovs);

/// Throws UsageError if the requested channels are impossible. Called before anything is rendered.
void check_aovs(const render::Aovs& aovs, const std::vector<Output>& outputs,
                const render::Scene& scene, const render::RenderSettings& settings);

/// Memory of the channels and of their inputs while the picture is encoded.
std::size_t aov_bytes(const render::Aovs& aovs, std::size_t pixels) noexcept;

/// Appends the layers that are computed with the picture to `layers`, which holds those of the
/// first hits. Unavailable layers are left out, with a message on `err`: the variance with fewer
/// than 8 samples per pixel, and, for a render that was interrupted without a goal, all layers that
/// depend on which pixels it reached.
void add_picture_layers(const render::Aovs& aovs, const render::RenderSettings& settings,
                        const render::RenderResult& result, std::vector<render::Layer>& layers,
                        std::ostream& err);

}  // namespace sdlc::cli
